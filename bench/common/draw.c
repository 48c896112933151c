/* draw.c - triangles anywhere about the box, and their order in space. */
#include "draw.h"

#include <stdlib.h>
#include <string.h>

/* The paper, section 3: three independent vertices. */
void draw_paper(generator *g, triangle t)
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t[j][a] = random_between(g, -2, 2);
}

/* The same a million units away, where floats are 1/16 apart. */
void draw_offset(generator *g, triangle t)
{
    draw_paper(g, t);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t[j][a] += 1e6f;
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

void draw_inside(generator *g, triangle t)
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t[j][a] = random_between(g, -0.5f, 0.5f);
}

/* Quarters in [-2, 2]: faces, edges and corners of the box are lattice points, so contact is common and bounds cannot decide it. */
void draw_lattice(generator *g, triangle t)
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t[j][a] = (float)random_below(g, 17) * 0.25f - 2;
}

/* Tenths, which floats only approximate: a centre and half size formed from such bounds are rounded, and contact may be lost. */
void draw_tenths(generator *g, triangle t)
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t[j][a] = (float)random_below(g, 26) / 10;
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
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t[j][a] = (float)steps[j][a] / 4;
}

/* Steps of 1/10: the same, of rounded numbers. */
void draw_cad_tenths(generator *g, triangle t)
{
    int steps[3][3];
    draw_half_face(g, steps);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t[j][a] = (float)steps[j][a] / 10;
}

/* ---- order ----------------------------------------------------------------------------------------------------------------- */

typedef struct keyed {
    uint64_t key;
    triangle t;
} keyed;

static int by_key(const void *a, const void *b)
{
    const uint64_t p = ((const keyed *)a)->key, q = ((const keyed *)b)->key;
    return (p > q) - (p < q);
}

/* The bits of the centroid's cell on the three axes, interleaved: x lowest. */
static uint64_t morton_code(const float t[3][3], float reach)
{
    uint64_t code = 0;
    for (int a = 0; a < 3; a++) {
        const float middle = (t[0][a] + t[1][a] + t[2][a]) / 3;
        const unsigned cell = (unsigned)((middle / reach + 1) * 511.5f);
        for (int bit = 0; bit < 10; bit++)
            code |= (uint64_t)(cell >> bit & 1) << (3 * bit + a);
    }
    return code;
}

bool place_sort(triangle *triangles, size_t count, float reach)
{
    keyed *const order = malloc(count * sizeof *order);
    if (!order)
        return false;
    for (size_t i = 0; i < count; i++) {
        memcpy(order[i].t, triangles[i], sizeof(triangle));
        order[i].key = morton_code((const float(*)[3])triangles[i], reach);
    }
    qsort(order, count, sizeof *order, by_key);
    for (size_t i = 0; i < count; i++)
        memcpy(triangles[i], order[i].t, sizeof(triangle));
    free(order);
    return true;
}
