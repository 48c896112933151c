/* draw_mesh.c - closed meshes, in cells of the grid. */
#include "triangle_kinds.h"

#include <math.h>

#include "common/closed_meshes.h"

/* A body's size and place in a grid, and where its triangles go. */
typedef struct body {
    const grid_planes *l;
    double centre[3], radius[3];
    triangle_list *triangles;
} body;

static void put(void *mesh, const double a[3], const double b[3], const double c[3])
{
    const body *const at = mesh;
    const double *const corner[3] = {a, b, c};
    float u[3][3];
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++)
            u[v][k] = grid_planes_place(&at->l->grid, k, at->centre[k] + at->radius[k] * corner[v][k]);
    triangle_list_put(at->triangles, (const_vertices)u);
}

/* Twelve triangles between two corners, often planes of the grid. */
static void put_cuboid(random_source *r, body *at)
{
    const bool is_whole = random_int(r, 4);
    for (int a = 0; a < 3; a++) {
        double corner[2];
        for (int side = 0; side < 2; side++) {
            const double place = random_double(r, -1, (double)at->l->grid.size[a] + 1);
            corner[side] = is_whole ? floor(place) : place;
        }
        at->centre[a] = (corner[0] + corner[1]) / 2;
        at->radius[a] = (corner[1] - corner[0]) / 2;
    }
    closed_cube(&(closed_mesh_sink){put, at}, 1);
}

void draw_mesh(random_source *r, const grid_planes *l, triangle_list *c)
{
    body at = {.l = l, .triangles = c};
    for (int a = 0; a < 3; a++) {
        at.centre[a] = random_double(r, 0, l->grid.size[a]);
        at.radius[a] = l->grid.size[a] * random_double(r, 0.1, 0.8);
    }
    const closed_mesh_sink to = {put, &at};
    const int around = random_int_between(r, 3, 40), across = random_int_between(r, 3, 24), kind = random_int(r, 3);
    if (kind == 0)
        closed_globe(&to, around, across);
    else if (kind == 1)
        closed_torus(&to, around, across, 0.3);
    else
        for (int k = 0; k < 4; k++)
            put_cuboid(r, &at);
}
