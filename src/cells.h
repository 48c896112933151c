/*
 * cells.h - how voxelize.c and the kernels speak of grids. Cells are counted on each axis from the grid's origin; a place on an axis
 * is told in cells, in double.
 */
#ifndef TRIBOX_CELLS_H
#define TRIBOX_CELLS_H

#include "tribox.h"

/* A grid as kernels see it. */
typedef struct tribox_lattice {
    double origin[3], per_cell[3]; /* the place of x is (x - origin) * per_cell */
    double size[3];                /* cells */
    double error[3];               /* cells: plane p, and the places of numbers near the grid, are so far out at most, together */
    double first_layer, end_layer; /* triangles outside these layers need no answer */
} tribox_lattice;

/*
 * Which cells the bounding boxes of 64 triangles touch: first[a][i] to last[a][i] on axis a, from -1 to size, where -1 stands for all
 * below the grid and size for all above it.
 */
typedef struct tribox_reach {
    double first[3][64], last[3][64];
    uint64_t unsure; /* triangles of which rounding leaves this open: only planes themselves can tell */
} tribox_reach;

/* The finite triangles of a word of the soup that touch the grid, and the layers asked: all, of the unsure ones also others. */
typedef uint64_t tribox_reach_walk(const tribox_soup *soup, size_t word, const tribox_lattice *lattice, tribox_reach *reach);

/* Triangles whose cells are told row by row, some at a time. */
enum { TRIBOX_STRIP = 32 };

/*
 * Limits on the cells of rows along x, linear in row j and layer k. Of triangle t, with i, j and k counted from its base:
 * a side leaves a row where offset - j_slope * j - k_slope * k is at least 0, and surely if beyond the error;
 * an upper limit leaves the cells i <= maybe - slope * (j or k), and surely those below `sure` instead of `maybe`; a lower limit i >=.
 */
typedef struct tribox_side {
    double offset[TRIBOX_STRIP], j_slope[TRIBOX_STRIP], k_slope[TRIBOX_STRIP], error[TRIBOX_STRIP];
} tribox_side;

typedef struct tribox_limit {
    double maybe[TRIBOX_STRIP], sure[TRIBOX_STRIP], slope[TRIBOX_STRIP];
} tribox_limit;

/* The plane: limits on both ends with the same slopes. */
typedef struct tribox_slab {
    double upper_maybe[TRIBOX_STRIP], upper_sure[TRIBOX_STRIP], lower_maybe[TRIBOX_STRIP], lower_sure[TRIBOX_STRIP];
    double j_slope[TRIBOX_STRIP], k_slope[TRIBOX_STRIP];
} tribox_slab;

typedef struct tribox_strip {
    unsigned count;
    float u[9][TRIBOX_STRIP];      /* u[3 * v + a][t]: axis a of vertex v */
    double base[3][TRIBOX_STRIP];  /* the first cell of its range, within the grid */
    double cells[3][TRIBOX_STRIP]; /* how many there are on each axis, within the grid */
    /* what prepare makes of these */
    tribox_side side[3];
    tribox_limit upper[2][2], lower[2][2]; /* [0] of the projection along y, linear in k; [1] along z, linear in j */
    tribox_slab plane;
} tribox_strip;

/*
 * The limits of the triangles of a strip. margin: 1 for error bounds, 0 for none. The numbers after the last triangle, up to a
 * multiple of 8, have to be finite.
 */
typedef void tribox_strip_prepare(tribox_strip *strip, const tribox_lattice *lattice, unsigned axes, double margin);

/* Of each of 64 rows, the cells that may overlap and those within them that surely do; none where last < first. */
typedef struct tribox_row_cells {
    double first_maybe[64], last_maybe[64], first_sure[64], last_sure[64];
} tribox_row_cells;

/* The rows from `row` of triangle t: row j + cells[1] * k is row j of layer k. At most 64. */
typedef void tribox_rows_walk(const tribox_strip *strip, unsigned t, double row, unsigned rows, tribox_row_cells *out);

typedef struct tribox_grid_kernel {
    tribox_reach_walk *reach;
    tribox_strip_prepare *prepare;
    tribox_rows_walk *rows;       /* both */
    tribox_rows_walk *rows_maybe; /* first_maybe and last_maybe alone */
} tribox_grid_kernel;

#endif
