/*
 * draw_contact.c - triangles that touch a box. With m a direction outward from the box and p a point of the box farthest along m,
 * the plane through p across m has the box on one side; a triangle with all its vertices in it or beyond, and one of its points
 * at p, touches and does no more.
 */
#include "draw.h"

#include <stdbool.h>
#include <string.h>

#define EIGHTHS_OF_HALF 4.0 /* the box is [-4, 4]^3 in eighths, in which everything here is drawn */

/* A plane of contact: p, and two directions across m. */
typedef struct contact {
    double m[3], p[3], across[2][3];
} contact;

/* Uniform in [-most, most]: one of the whole numbers, or any. */
static double draw_number(generator *g, bool is_whole, int most)
{
    if (is_whole)
        return (double)random_below(g, 2 * (size_t)most + 1) - most;
    return most * (0x1p-52 * (double)(random_bits(g) >> 11) - 1);
}

/* Every third component of m is 0: two zeros make a contact with a face, one zero with an edge, none with a corner. */
static void draw_plane(generator *g, bool is_whole, contact *c)
{
    do {
        for (int a = 0; a < 3; a++)
            c->m[a] = random_below(g, 3) ? draw_number(g, is_whole, 2) : 0;
    } while (c->m[0] == 0 && c->m[1] == 0 && c->m[2] == 0);
    for (int a = 0; a < 3; a++)
        c->p[a] = c->m[a] > 0 ? EIGHTHS_OF_HALF : c->m[a] < 0 ? -EIGHTHS_OF_HALF : draw_number(g, is_whole, EIGHTHS_OF_HALF);
    for (int k = 0; k < 2; k++) {
        double q[3];
        for (int a = 0; a < 3; a++)
            q[a] = draw_number(g, is_whole, 2);
        for (int a = 0; a < 3; a++)
            c->across[k][a] = c->m[(a + 1) % 3] * q[(a + 2) % 3] - c->m[(a + 2) % 3] * q[(a + 1) % 3];
    }
}

/* Vertex j at p + s across[0] + t across[1] + lift m. */
static void put_vertex(const contact *c, triangle u, int j, double s, double t, double lift)
{
    for (int a = 0; a < 3; a++)
        u[j][a] = (float)((c->p[a] + s * c->across[0][a] + t * c->across[1][a] + lift * c->m[a]) / 8);
}

/*
 * Exact: small whole numbers of eighths. One in three touches with a vertex, one with an edge, one with its inside; about half
 * are then moved off contact, inwards or outwards.
 */
void draw_touching(generator *g, triangle u)
{
    contact c;
    draw_plane(g, true, &c);
    const size_t a = random_below(g, 3);
    c.p[a] += random_below(g, 3) ? draw_number(g, true, 2) : 0;
    const double lift[2] = {(double)random_below(g, 3), (double)random_below(g, 3)};
    switch (random_below(g, 3)) {
    case 0:
        put_vertex(&c, u, 0, 0, 0, 0);
        put_vertex(&c, u, 1, 1, 0, lift[0]);
        put_vertex(&c, u, 2, 0, 1, lift[1]);
        break;
    case 1:
        put_vertex(&c, u, 0, 1, 0, 0);
        put_vertex(&c, u, 1, -1, 0, 0);
        put_vertex(&c, u, 2, 0, 1, lift[0]);
        break;
    default:
        put_vertex(&c, u, 0, 1, 0, 0);
        put_vertex(&c, u, 1, 0, 1, 0);
        put_vertex(&c, u, 2, -1, -1, 0);
        break;
    }
}

/* At most `steps` floats up or down; zero stays, as its neighbours are 40 orders of magnitude away. */
static float nudged(generator *g, float number, unsigned steps)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    if (number != 0)
        bits += (uint32_t)random_below(g, 2 * (size_t)steps + 1) - steps;
    memcpy(&number, &bits, sizeof bits);
    return number;
}

/* Three of the nine numbers moved by an ulp or not: contact, or too close to it for a bound in float and often in double. */
void draw_touching_ulp(generator *g, triangle u)
{
    draw_touching(g, u);
    for (int j = 0; j < 3; j++) {
        const size_t a = random_below(g, 3);
        u[j][a] = nudged(g, u[j][a], 1);
    }
}

/* An edge through a point of contact, as near as floats come; three in four are moved off it, inwards or outwards. */
static void draw_edge(generator *g, triangle u)
{
    contact c;
    draw_plane(g, false, &c);
    const double away = random_below(g, 4) ? draw_number(g, false, 2) : 0;
    for (int a = 0; a < 3; a++)
        c.p[a] += away * c.m[a];
    put_vertex(&c, u, 0, 1, 0, 0);
    put_vertex(&c, u, 1, -1, 0, 0);
}

/* One edge of up to 4 floats. */
void draw_needle(generator *g, triangle u)
{
    draw_edge(g, u);
    for (int a = 0; a < 3; a++)
        u[2][a] = nudged(g, u[0][a], 4);
}

/* A vertex on the opposite edge, but for the rounding. */
void draw_cap(generator *g, triangle u)
{
    draw_edge(g, u);
    const float share = random_between(g, 0, 1);
    for (int a = 0; a < 3; a++)
        u[2][a] = nudged(g, u[0][a] + share * (u[1][a] - u[0][a]), 2);
}
