/* closed_meshes.c - closed meshes, in cells of the grid. */
#include "triangle_kinds.h"

#include <math.h>

static const double full_turn = 6.283185307179586;

/* A body's size and place. */
typedef struct pose {
    double centre[3], radius[3];
} pose;

static void put_point(const grid_planes *l, const pose *at, const double p[3], float v[3])
{
    for (int a = 0; a < 3; a++)
        v[a] = grid_planes_place(&l->grid, a, at->centre[a] + at->radius[a] * p[a]);
}

typedef void surface(double s, double t, double p[3]);

static void sphere(double s, double t, double p[3])
{
    p[0] = sin(t * full_turn / 2) * cos(s * full_turn);
    p[1] = sin(t * full_turn / 2) * sin(s * full_turn);
    p[2] = cos(t * full_turn / 2);
}

static void torus(double s, double t, double p[3])
{
    const double across = 0.7 + 0.3 * cos(t * full_turn);
    p[0] = across * cos(s * full_turn);
    p[1] = 0.3 * sin(t * full_turn);
    p[2] = across * sin(s * full_turn);
}

/* Two triangles for each of n x m patches. */
static void put_surface(const grid_planes *l, const pose *at, surface *of, int n, int m, triangle_list *c)
{
    static const int corner[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 0}, {1, 1}, {0, 1}}};
    for (int i = 0; i < n; i++)
        for (int j = 0; j < m; j++)
            for (int half = 0; half < 2; half++) {
                float u[3][3];
                for (int v = 0; v < 3; v++) {
                    double p[3];
                    of((double)(i + corner[half][v][0]) / n, (double)(j + corner[half][v][1]) / m, p);
                    put_point(l, at, p, u[v]);
                }
                triangle_list_put(c, (const_vertices)u);
            }
}

/* Twelve triangles between two corners, often planes of the grid. */
static void put_cuboid(random_source *r, const grid_planes *l, triangle_list *c)
{
    double corner[2][3];
    const bool is_whole = random_int(r, 4);
    for (int a = 0; a < 3; a++)
        for (int side = 0; side < 2; side++) {
            const double at = random_double(r, -1, (double)l->grid.size[a] + 1);
            corner[side][a] = is_whole ? floor(at) : at;
        }
    for (int a = 0; a < 3; a++)
        for (int side = 0; side < 2; side++)
            for (int half = 0; half < 2; half++) {
                float u[3][3];
                for (int v = 0; v < 3; v++) {
                    const int b = (a + 1) % 3, d = (a + 2) % 3, across = (v + half + 1) % 4 & 1, along = (v + half) / 2 & 1;
                    u[v][a] = grid_planes_place(&l->grid, a, corner[side][a]);
                    u[v][b] = grid_planes_place(&l->grid, b, corner[across][b]);
                    u[v][d] = grid_planes_place(&l->grid, d, corner[along][d]);
                }
                triangle_list_put(c, (const_vertices)u);
            }
}

void draw_mesh(random_source *r, const grid_planes *l, triangle_list *c)
{
    pose at;
    for (int a = 0; a < 3; a++) {
        at.centre[a] = random_double(r, 0, l->grid.size[a]);
        at.radius[a] = l->grid.size[a] * random_double(r, 0.1, 0.8);
    }
    const int n = random_int_between(r, 3, 40), m = random_int_between(r, 3, 24), kind = random_int(r, 3);
    for (int k = 0; kind == 2 && k < 4; k++)
        put_cuboid(r, l, c);
    if (kind < 2)
        put_surface(l, &at, kind ? torus : sphere, n, m, c);
}
