/*
 * window.h - what is asked of a voxelization: a window of a grid, how places in it are told, and which of its layers are written.
 */
#ifndef TRIBOX_WINDOW_H
#define TRIBOX_WINDOW_H

#include "grid/grid_cells.h"
#include "grid/planes.h"
#include "kernel_voxels.h"
#include "mesh/vertex_numbers.h"
#include "mesh/positions.h"

/* The grid in float. */
typedef struct tribox_float_lattice {
    float origin[3], per_cell[3], size[3];
    float error[3]; /* that of tribox_lattice, rounded up */
    float doubt[3]; /* with what float adds to it, for every place in the grid */
    float off[3];   /* the place of the origin: a window's first plane is not where its lattice begins */
} tribox_float_lattice;

/*
 * How far the planes of a grid in float are from evenly spaced: where limits by the very planes of a row pay for rows with
 * undecided cells, and where for all rows, as most have some (PROOFS.md 7.13).
 */
typedef enum tribox_roughness { TRIBOX_EVEN, TRIBOX_ROUGH, TRIBOX_VERY_ROUGH } tribox_roughness;

/* The layers that are written of a grid, or a window of one as a grid of its own; in double always a window. */
typedef struct tribox_window {
    const tribox_grid *grid; /* NULL for a grid in double */
    uint32_t first[3];       /* the window's first cell among those of `grid`; in double planes have it: */
    const tribox_mesh *mesh; /* its strides set */
    size_t first_triangle;   /* the one with the number 0 */
    int32_t first_number;    /* that of the soup's first */
    tribox_planes planes;
    uint32_t size[3]; /* of the grid or window */
    int64_t first_layer, end_layer;
    tribox_lattice lattice;
    tribox_float_lattice in_float;
    tribox_roughness roughness;
    bool is_for_float; /* whether the soup's packets are sorted in float: PROOFS.md 7.9, of a mesh 7.11 */
    bool has_limits;   /* whether the limits of rows hold in double: else cells are asked themselves (PROOFS.md 7.10) */
} tribox_window;

/* Whether a window lies in a grid of this size. */
bool tribox_is_window(const uint32_t grid_size[3], const uint32_t first[3], const uint32_t size[3]);

/*
 * The lattice in float, about this origin, whose place is `off`. Float is a filter where it tells places in the grid apart by less
 * than half a cell, and nothing overflows (PROOFS.md 7.9): whether it does.
 */
bool tribox_window_make_float(tribox_window *w, const float origin[3], const double off[3]);

/* Plane p of axis a of the grid or window; of a grid in float. */
static inline float tribox_window_plane(const tribox_window *w, int a, uint64_t p)
{
    return tribox_grid_plane(w->grid, a, w->first[a] + p);
}

/*
 * One triangle: x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2, as everywhere below, floats of a soup or doubles of a mesh; and for a mesh its
 * number.
 */
typedef struct tribox_triangle {
    double u[9];
    int32_t number;
} tribox_triangle;

/* The three numbers of axis a of triangle `number` of the mesh. */
static inline void tribox_window_read_axis(const tribox_window *w, int32_t number, int a, double u[3])
{
    const tribox_mesh *const mesh = w->mesh;
    const char *const from = (const char *)mesh->positions + (size_t)a * mesh->axis_stride;
    const size_t corner = 3 * (w->first_triangle + (size_t)number);
    for (size_t j = 0; j < 3; j++)
        u[j] = tribox_number_read(mesh, from + tribox_vertex_number(mesh, tribox_vertex_bytes(mesh), corner + j) * mesh->stride);
}

static inline tribox_triangle tribox_window_read_triangle(const tribox_window *w, int32_t number)
{
    tribox_triangle triangle = {.number = number};
    for (int a = 0; a < 3; a++)
        tribox_window_read_axis(w, number, a, triangle.u + (size_t)3 * (size_t)a);
    return triangle;
}

#endif
