/* draw.c - triangles about a box. */
#include "draw.h"

#include <math.h>
#include <string.h>

/* Nine numbers, each by itself. */
#define DRAW_EACH(name, number) \
    void name(generator *g, triangle t) \
    { \
        for (int n = 0; n < 9; n++) \
            t[n / 3][n % 3] = number; \
    }

/* The paper, section 3: three independent vertices. */
DRAW_EACH(draw_paper, random_between(g, -2, 2))

DRAW_EACH(draw_inside, random_between(g, -0.5f, 0.5f))

/* Quarters in [-2, 2]: faces, edges and corners of the box are lattice points, so contact is common and bounds cannot decide it. */
DRAW_EACH(draw_lattice, (float)random_below(g, 17) * 0.25f - 2)

/* Tenths, which floats only approximate: a centre and half size formed from such bounds are rounded, and contact may be lost. */
DRAW_EACH(draw_tenths, (float)random_below(g, 26) / 10)

/* The same a million units away, where floats are 1/16 apart. */
void draw_offset(generator *g, triangle t)
{
    draw_paper(g, t);
    for (int n = 0; n < 9; n++)
        t[n / 3][n % 3] += 1e6f;
}

/* Small triangles all over a cube of 16 x 16 x 16 boxes: nearly all miss on a box normal. */
void draw_sparse(generator *g, triangle t)
{
    for (int a = 0; a < 3; a++) {
        const float about = random_between(g, -8, 8);
        for (int j = 0; j < 3; j++)
            t[j][a] = about + random_between(g, -0.1f, 0.1f);
    }
}

/*
 * Half a face of a block or a prism with its corners on grid points, in steps of the grid: the face of a block lies in a plane of
 * the grid, that of a prism is turned about a grid line. The grid points are numbered from 0 to 7 around the cell from 3 to 5.
 */
static void draw_half_face(generator *g, int t[3][3])
{
    const size_t along = random_below(g, 3), across = (along + 1 + random_below(g, 2)) % 3, third = 3 - along - across;
    const bool is_turned = random_below(g, 4) == 0;
    int corner[4][3];
    for (int k = 0; k < 3; k++)
        corner[0][k] = (int)random_below(g, 8);
    const int length = 1 + (int)random_below(g, 6), width = 1 + (int)random_below(g, 6);
    const int rise = is_turned ? 1 + (int)random_below(g, 6) : 0;
    for (int c = 1; c < 4; c++)
        for (int k = 0; k < 3; k++)
            corner[c][k] = corner[0][k];
    corner[1][along] += corner[0][along] < 4 ? length : -length;
    corner[3][across] += corner[0][across] < 4 ? width : -width;
    corner[3][third] += corner[0][third] < 4 ? rise : -rise;
    for (int k = 0; k < 3; k++)
        corner[2][k] = corner[1][k] + corner[3][k] - corner[0][k];
    const size_t first = random_below(g, 4);
    for (size_t j = 0; j < 3; j++)
        for (int k = 0; k < 3; k++)
            t[j][k] = corner[(first + j) % 4][k];
}

/* Steps of 1/4: every number and every product is exact in float. */
void draw_cad(generator *g, triangle t)
{
    int steps[3][3];
    draw_half_face(g, steps);
    for (int n = 0; n < 9; n++)
        t[n / 3][n % 3] = (float)steps[n / 3][n % 3] / 4;
}

/* Steps of 1/10: the same, of rounded numbers. */
void draw_cad_tenths(generator *g, triangle t)
{
    int steps[3][3];
    draw_half_face(g, steps);
    for (int n = 0; n < 9; n++)
        t[n / 3][n % 3] = (float)steps[n / 3][n % 3] / 10;
}

/* ---- touching the box -------------------------------------------------------------------------------------------------------- */

/*
 * With m a direction outward from the box and p a point of the box farthest along m, the plane through p across m has the box on
 * one side; a triangle with all its vertices in it or beyond, and one of its points at p, touches and does no more.
 */

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

/* ---- segments and slivers, whose computed normal is rounding, or nearly ------------------------------------------------------ */

/* Off the edge from t[0] to t[1] by `share` of its length, in a direction across it. */
static void put_off_edge(generator *g, triangle t, float along, double share)
{
    double edge[3], any[3], across[3], edge_length = 0, across_length = 0;
    for (int a = 0; a < 3; a++) {
        edge[a] = (double)t[1][a] - (double)t[0][a];
        any[a] = (double)random_between(g, -1, 1);
        edge_length += edge[a] * edge[a];
    }
    for (int a = 0; a < 3; a++) {
        across[a] = edge[(a + 1) % 3] * any[(a + 2) % 3] - edge[(a + 2) % 3] * any[(a + 1) % 3];
        across_length += across[a] * across[a];
    }
    const double off = across_length > 0 ? share * sqrt(edge_length / across_length) : 0;
    for (int a = 0; a < 3; a++)
        t[2][a] = (float)((double)t[0][a] + (double)along * edge[a] + off * across[a]);
}

/* A quarter go there and back, a quarter have a vertex on an edge; the others are 2^10 to 2^30 times as long as high. */
void draw_thin(generator *g, triangle t)
{
    draw_paper(g, t);
    const size_t kind = random_below(g, 4);
    const float along = random_between(g, 0, 1);
    const int power = 10 + (int)random_below(g, 21);
    if (kind == 0)
        memcpy(t[2], t[0], sizeof t[2]);
    else
        put_off_edge(g, t, along, kind == 1 ? 0 : ldexp(1, -power));
}
