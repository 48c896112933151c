/*
 * window.h - what is asked of a voxelization: a window of a grid, how places in it are told, which of its layers are written, and
 * where triangles of doubles are.
 */
#ifndef TRIBOX_WINDOW_H
#define TRIBOX_WINDOW_H

#include "grid/grid_cells.h"
#include "kernel_voxels.h"
#include "mesh/positions.h"
#include "grid/triangles.h"

/* The window in float, for triangles of floats as they are, and for those of doubles less the place of plane 0. */
typedef struct tribox_float_lattice {
    float origin[3], per_cell[3], size[3];
    float off[3];        /* the place of the origin: plane 0 need not be a float; */
    float off_middle[3]; /* from the middle of cell 0 */
    float cell[3];       /* where all planes are floats that float arithmetic makes without rounding; else 0 */
    float error[3];      /* that of tribox_lattice, and what `off` adds to it */
    float doubt[3];      /* with what float adds to it, for every place in the window */
} tribox_float_lattice;

/* A window of a grid as a grid of its own, and the layers of it that are written. */
struct tribox_voxel_window {
    tribox_planes planes;
    uint32_t size[3];
    int64_t first_layer, end_layer;
    tribox_lattice lattice;
    tribox_float_lattice in_float;
    bool is_for_float;   /* whether packets are sorted in float (PROOFS.md 7.9, of doubles 7.11) */
    bool has_limits;     /* whether the limits of rows hold in double: else cells are asked themselves (7.10); */
    bool has_all_limits; /* of all triangles */

    const tribox_mesh *doubles; /* NULL where triangles are of floats; */
    size_t first_triangle;      /* the one with the number 0; */
    bool has_numbers;           /* whether triangles have any: those of doubles, and where ids are asked for; */
    const int32_t *number;      /* those of the soup that is sorted, or NULL */
};

/*
 * One triangle: x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2, as everywhere below, floats or doubles; and its number modulo 2^32, where
 * triangles have numbers.
 */
typedef struct tribox_triangle {
    double u[9];
    int32_t number;
} tribox_triangle;

/* The three numbers of axis a of triangle `number`, of doubles. */
static inline void tribox_window_read_axis(const tribox_voxel_window *w, int32_t number, int a, double u[3])
{
    const tribox_mesh *const mesh = w->doubles;
    const char *const from = tribox_axis_begin(mesh, a);
    const size_t corner = 3 * (w->first_triangle + (uint32_t)number);
    for (size_t j = 0; j < 3; j++)
        memcpy(&u[j], from + tribox_vertex_number(mesh, tribox_vertex_bytes(mesh), corner + j) * mesh->stride, sizeof u[j]);
}

static inline tribox_triangle tribox_window_read_triangle(const tribox_voxel_window *w, int32_t number)
{
    tribox_triangle triangle = {.number = number};
    for (int a = 0; a < 3; a++)
        tribox_window_read_axis(w, number, a, triangle.u + (size_t)3 * (size_t)a);
    return triangle;
}

#endif
