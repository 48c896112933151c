/*
 * kernel_voxels.h - how voxelizing.c and the kernels speak of grids. Cells are counted on each axis from the first of the window;
 * a place on an axis is in cells too. Kernels are asked about 2^30 cells an axis at most, and in float about 2^20 (PROOFS.md 7.9,
 * 7.10).
 */
#ifndef TRIBOX_KERNEL_VOXELS_H
#define TRIBOX_KERNEL_VOXELS_H

#include <stdbool.h>

#include "tribox.h"

typedef struct tribox_voxels tribox_voxels; /* one call: voxelizing.h */

/* A window as kernels see it. */
typedef struct tribox_lattice {
    double origin[3], per_cell[3]; /* the place of x is (x - origin) * per_cell */
    double error[3]; /* cells: how far off plane p and the place of a number near the window can be, together (PROOFS.md 7.2) */
} tribox_lattice;

/* What places and layers of a window of a sound grid are (window.h): of triangles of floats, or of these doubles. */
typedef struct tribox_voxel_window tribox_voxel_window;
typedef void tribox_make_window(tribox_voxel_window *w, const tribox_grid *grid, const tribox_window *asked,
                                const tribox_mesh *doubles, unsigned axes);

/* Triangles are limited row by row, this many at a time. */
enum { TRIBOX_STRIP = 16 };

/*
 * Which axes matter: all three projections and the plane; or, where the bounding box lies in one layer of cells across an axis, the
 * projection along that axis alone, as there it overlaps a cell exactly if its shadow does (PROOFS.md 7.4).
 */
typedef enum tribox_shape { TRIBOX_SOLID, TRIBOX_FLAT_X, TRIBOX_FLAT_Y, TRIBOX_FLAT_Z, TRIBOX_SHAPES } tribox_shape;

/* Triangles of one shape. */
typedef struct tribox_strip {
    unsigned count;
    double u[9][TRIBOX_STRIP];                     /* x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2 of triangle t at [t] */
    int32_t number[TRIBOX_STRIP];                  /* that of tribox_triangle */
    double base[3][TRIBOX_STRIP];                  /* the first cell of its range, within the grid */
    double cells[3][TRIBOX_STRIP];                 /* how many there are on each axis, within the grid */
    int32_t word[TRIBOX_STRIP], bit[TRIBOX_STRIP]; /* of cells base[0], base[1] in the first layer of it that is asked for */
} tribox_strip;

/*
 * Sets the rows of a strip's triangles. The numbers of the strip after the last, up to a multiple of TRIBOX_DOUBLES_MAX (kernel.h),
 * have to be finite, and cells not zero.
 */
typedef void tribox_set_strip(tribox_voxels *v);

/* Triangles of nine numbers each, one at least, that fill no packet, as one: lanes past them repeat the first. */
typedef struct tribox_partial_packet tribox_partial_packet;
typedef void tribox_spread_nines(const float (*nine)[9], size_t count, tribox_partial_packet *partial);

/*
 * Sorts the triangles of a soup, one at least, by their cells: those of lines are listed, larger ones join the strips, others wait
 * in queues. Whole packets are read: where the triangles are fewer than the lanes of the kernel, numbers have to follow them
 * (tribox_partial_packet).
 */
typedef void tribox_sort_soup(tribox_voxels *v, const tribox_soup *soup);

/* The cells of what waits in queues; after the last soup. Writes the listed bits. */
typedef void tribox_finish(tribox_voxels *v);

/* Writes the listed bits. */
typedef void tribox_write(tribox_voxels *v);

/*
 * The tiles of a grid as kernels see them, where float tells their places apart: fewer than 2^31 in all. The place of x is
 * (x - origin) * per_tile + off.
 */
typedef struct tribox_tile_lattice {
    float origin[3], per_tile[3], off[3];
    float end[3];     /* the place where the grid ends */
    float doubt[3];   /* how far off places and planes can be, together (PROOFS.md 7.12) */
    int32_t along[3]; /* how many tiles */
} tribox_tile_lattice;

/*
 * Which tiles the bounding boxes of triangles touch: the number of the first, and how many follow it along x, y and z, in
 * TRIBOX_TILES_BITS each. Or there is none, or the planes have to be asked.
 */
enum {
    TRIBOX_TILES_BLOCK = 256,
    TRIBOX_TILES_BITS = 10,
    TRIBOX_TILES_MORE = (1 << TRIBOX_TILES_BITS) - 1,
    TRIBOX_TILES_NONE = -2,
    TRIBOX_TILES_UNKNOWN = -1
};
typedef struct tribox_tile_range {
    int32_t first[TRIBOX_TILES_BLOCK], more[TRIBOX_TILES_BLOCK];
} tribox_tile_range;

/* Of the triangles of a soup, TRIBOX_TILES_BLOCK at most. Whole packets are read, as by tribox_sort_soup. */
typedef void tribox_find_tiles(const tribox_soup *soup, const tribox_tile_lattice *lattice, tribox_tile_range *range);

/* The least and the greatest of numbers. */
typedef struct tribox_ends {
    float least, most;
} tribox_ends;

/* Widens them to these numbers, but NaN. Whole packets are read: any of the numbers has to follow them. */
typedef void tribox_find_ends(const float *number, size_t count, tribox_ends *ends);

/* A sink, and how many cells it was given. */
typedef struct tribox_outlet {
    tribox_sink sink;
    size_t cells;
} tribox_outlet;

/*
 * Emits the bricks of a window of bits that are not empty, by z, then y, then x, and clears the bits. Its first cell, `first`,
 * is the first of a brick, and it has 1024 along x at most. Returns whether to go on; if not, some bits are left. In the
 * environment of the caller, as nothing is counted in floats.
 */
typedef bool tribox_emit(uint64_t *bits, const uint32_t first[3], const uint32_t size[3], tribox_outlet *outlet);

/* The ids of the first cell of a brick, and how many there are from one row of it to the next, and from one layer. */
typedef struct tribox_brick_rows {
    const uint32_t *ids;
    size_t row, layer;
} tribox_brick_rows;

/*
 * The ids of a brick with these bits; all bits of an id are set where that of its cell is clear. Up to TRIBOX_LANES_MAX ids of a
 * row are read, and as many from the last row on are written.
 */
enum { TRIBOX_BRICK_IDS = 512 };
typedef void tribox_take_ids(const tribox_brick_rows *rows, const uint64_t bits[8], uint32_t *to);

/* tribox_window_cells. */
typedef size_t tribox_number_cells(const uint64_t *occupied, const uint32_t size[3], uint32_t (*cells)[3]);

typedef struct tribox_cells_kernel {
    tribox_make_window *make_window;
    tribox_spread_nines *spread_nines;
    tribox_sort_soup *sort;
    tribox_finish *finish;
    tribox_write *write;
    tribox_find_tiles *find_tiles;
    tribox_find_ends *find_ends;
    tribox_emit *emit;
    tribox_take_ids *take_ids;
    tribox_number_cells *number_cells;
} tribox_cells_kernel;

/* Turns a bit for each crossing of the first `count` triangles, in a grid that has places. Nothing of those that are not finite. */
typedef struct tribox_crossings tribox_crossings;
typedef struct tribox_seen_along tribox_seen_along;
typedef void tribox_cross(tribox_crossings *c, const tribox_seen_along *seen, size_t count);

typedef struct tribox_rows_kernel {
    tribox_set_strip *set_strip[TRIBOX_SHAPES];
    tribox_cross *cross;
} tribox_rows_kernel;

#endif
