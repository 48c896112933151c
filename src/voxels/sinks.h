/* sinks.h - what kernels fill while they voxelize: bits, and bounded lists of what waits for its turn. */
#ifndef TRIBOX_SINKS_H
#define TRIBOX_SINKS_H

#include "cell_ids.h"
#include "kernel.h"
#include "window.h"

/* Bits to be set, in halves of words (kernel/cells/writes.h): written when more than TRIBOX_WRITES are listed. */
enum { TRIBOX_WRITES = 1024, TRIBOX_WRITES_STEP = 320, TRIBOX_WRITES_AHEAD = 48 };
typedef struct tribox_writes {
    unsigned count;
    int32_t half[TRIBOX_WRITES + TRIBOX_WRITES_STEP + TRIBOX_WRITES_AHEAD], bits[TRIBOX_WRITES + TRIBOX_WRITES_STEP];
    int32_t number[TRIBOX_WRITES + TRIBOX_WRITES_STEP]; /* of the triangle, where ids or pairs are asked for */
} tribox_writes;

/*
 * Who takes what is listed, where pairs of cells and triangles are asked for in place of bits: each pair comes once (PROOFS.md
 * 7.14). Triangle 0 has the number `first`.
 */
typedef struct tribox_pair_sink {
    void (*take)(void *taker, const tribox_writes *listed, uint32_t first);
    void *taker;
} tribox_pair_sink;

/*
 * Triangles that wait until they fill a packet, by the cells that their boxes touch: lines of few cells are set at once; flats and
 * solids have a kernel of their own, and wait with others of about their size.
 */
enum {
    TRIBOX_LINE_MOST = 8,  /* most rows of a line */
    TRIBOX_FLAT_MOST = 32, /* most cells of a flat along an axis, and of a line or a solid along x */
    TRIBOX_SOLID_MOST = 8, /* most cells of a solid along y and along z */
    TRIBOX_QUEUE = 48
};
typedef enum tribox_class { TRIBOX_FLATS, TRIBOX_SOLIDS_2, TRIBOX_SOLIDS_4, TRIBOX_SOLIDS_8, TRIBOX_CLASSES } tribox_class;
enum { TRIBOX_QUEUED = 15 };
typedef struct tribox_queue {
    unsigned count;
    /*
     * x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2 of each, its first cell on each axis, and how many: for flats, 0 on the axis across
     * them
     */
    float number[TRIBOX_QUEUED][TRIBOX_QUEUE + TRIBOX_LANES_MAX];
    int32_t triangle[TRIBOX_QUEUE + TRIBOX_LANES_MAX]; /* its number, where they have any */
} tribox_queue;

/* Open cells of up to TRIBOX_WAITING rows. Entry n: cell at[0][n] + b of row (at[1][n], at[2][n]) for every bit b; all unsigned. */
enum { TRIBOX_WAITING = 128 };
typedef struct tribox_waiting {
    unsigned count;
    float u[9][TRIBOX_WAITING + TRIBOX_LANES_MAX];     /* the triangle, of floats; */
    int32_t number[TRIBOX_WAITING + TRIBOX_LANES_MAX]; /* its number, where they have any: of doubles alone that is read */
    int32_t at[3][TRIBOX_WAITING + TRIBOX_LANES_MAX], bits[TRIBOX_WAITING + TRIBOX_LANES_MAX];
} tribox_waiting;

/* The cells of a triangle's bounding box: within the grid, and on which axes there are more than one, even if some lie outside. */
typedef struct tribox_cell_range {
    int64_t base[3], cells[3];
    bool spans[3];
} tribox_cell_range;

/*
 * What a kernel does not do itself, handed in by whoever starts a voxelization: kernel texts know no function of src. Seldom
 * called, as most triangles and cells are decided where they are.
 */
typedef struct tribox_voxel_handlers {
    void (*write)(tribox_voxels *v); /* what is listed: there is room for more after */
    void (*take_triangle)(tribox_voxels *v, const tribox_triangle *triangle, const tribox_cell_range *range); /* touches these */
    void (*add_triangle)(tribox_voxels *v, const tribox_triangle *triangle); /* may touch any, and have any numbers */
    void (*settle_waiting)(tribox_voxels *v);                                /* `waiting` is full; is empty after */
} tribox_voxel_handlers;

typedef struct tribox_voxel_sinks {
    uint64_t *occupied; /* of the first layer */
    size_t row_words;
    int32_t row_halves, layer_halves; /* modulo 2^32, as halves are counted */
    bool is_far;                      /* from the nearer caches: more than 1 MiB of bits */
    bool is_counted;                  /* how many cells are newly set */
    tribox_cell_ids ids;
    const tribox_pair_sink *pairs; /* or NULL; there are no bits where they are asked for */
    tribox_writes writes;
    tribox_queue queue[TRIBOX_CLASSES];
    tribox_waiting waiting;
    tribox_strip strip[TRIBOX_SHAPES]; /* triangles that wait for their rows */
    const tribox_voxel_handlers *handlers;
} tribox_voxel_sinks;

#endif
