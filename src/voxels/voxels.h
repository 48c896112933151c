/*
 * voxels.h - one voxelization: what its rooms share.
 *
 * The bits of cells that certainly overlap are set by the kernel. Cells that rounding leaves open wait with their triangle until
 * the bits of others are written, as those set most of them; the rest are settled by their own boxes.
 */
#ifndef TRIBOX_VOXELS_H
#define TRIBOX_VOXELS_H

#include <string.h>

#include "grid/cell_bits.h"
#include "grid/grid_cells.h"
#include "plan.h"
#include "grid/planes.h"
#include "mesh/positions.h"

/* Bits to be set, in halves of words (kernel/writes.h): written when more than TRIBOX_WRITES are listed. */
enum { TRIBOX_WRITES = 1024, TRIBOX_WRITES_STEP = 320, TRIBOX_WRITES_AHEAD = 48 };
typedef struct tribox_writes {
    unsigned count;
    int32_t half[TRIBOX_WRITES + TRIBOX_WRITES_STEP + TRIBOX_WRITES_AHEAD], bits[TRIBOX_WRITES + TRIBOX_WRITES_STEP];
} tribox_writes;

/*
 * Triangles that wait until they fill a packet, by the cells that their boxes touch: lines of few cells are set at once; flats and
 * bricks have a kernel of their own, and wait beside others of about their size.
 */
enum {
    TRIBOX_LINE = 8,  /* most rows of a line */
    TRIBOX_FLAT = 32, /* most cells of a flat along an axis, and of a line or a brick along x */
    TRIBOX_BRICK = 8, /* most cells of a brick along y and along z */
    TRIBOX_QUEUE = 48
};
typedef enum tribox_class { TRIBOX_FLATS, TRIBOX_BRICKS_2, TRIBOX_BRICKS_4, TRIBOX_BRICKS_8, TRIBOX_CLASSES } tribox_class;
enum { TRIBOX_QUEUED = 15 };
typedef struct tribox_queue {
    unsigned count;
    /* x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2 of each, its first cell on each axis, and how many: of flats 0 across the layer */
    float number[TRIBOX_QUEUED][TRIBOX_QUEUE + TRIBOX_LANES_MAX];
    int32_t triangle[TRIBOX_QUEUE + TRIBOX_LANES_MAX]; /* of a mesh its number */
} tribox_queue;

/*
 * One triangle: x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2, as everywhere below, floats of a soup or doubles of a mesh; and for a mesh its
 * number.
 */
typedef struct tribox_triangle {
    double u[9];
    int32_t number;
} tribox_triangle;

/* The grid in float. */
typedef struct tribox_float_lattice {
    float origin[3], per_cell[3], size[3];
    float error[3]; /* that of tribox_lattice, rounded up */
    float doubt[3]; /* with what float adds to it, for every place in the grid */
    float off[3];   /* the place of the origin: a window's first plane is not where its lattice begins */
} tribox_float_lattice;

/* The cells of a triangle's bounding box: within the grid, and on which axes there are more than one, even if some lie outside. */
typedef struct tribox_cell_range {
    int64_t base[3], cells[3];
    bool spans[3];
} tribox_cell_range;

/* Open cells of up to TRIBOX_WAITING rows: of row at[1], at[2] those of these bits, counted along x from at[0] on, all unsigned. */
enum { TRIBOX_WAITING = 128 };
typedef struct tribox_waiting {
    unsigned count;
    float u[9][TRIBOX_WAITING + TRIBOX_LANES_MAX];     /* the triangle of a soup, */
    int32_t number[TRIBOX_WAITING + TRIBOX_LANES_MAX]; /* or the number of one of a mesh */
    int32_t at[3][TRIBOX_WAITING + TRIBOX_LANES_MAX], bits[TRIBOX_WAITING + TRIBOX_LANES_MAX];
} tribox_waiting;

/*
 * How far the planes of a grid in float are from evenly spaced: where limits by the very planes of a row pay for rows with open
 * cells, and where for all rows, as most have some (PROOFS.md 7.13).
 */
typedef enum tribox_roughness { TRIBOX_EVEN, TRIBOX_ROUGH, TRIBOX_VERY_ROUGH } tribox_roughness;

/* One call: the layers that it writes of a grid, or a window of one as a grid of its own; in double always a window. */
struct tribox_voxels {
    const tribox_grid *grid; /* NULL for a grid in double */
    uint32_t first[3];       /* the window's first cell among those of `grid`; in double planes have it: */
    const tribox_mesh *mesh; /* its strides set */
    size_t first_triangle;   /* the one with the number 0 */
    int32_t first_number;    /* that of the soup's first */
    tribox_planes planes;
    tribox_roughness roughness;
    bool is_for_float; /* whether the soup's packets are sorted in float: PROOFS.md 7.9, of a mesh 7.11 */
    bool has_limits;   /* whether the limits of rows hold in double: else cells are asked themselves (PROOFS.md 7.10) */

    uint32_t size[3]; /* of the grid or window */
    tribox_plan plan;
    tribox_lattice lattice;
    tribox_float_lattice in_float;
    int64_t first_layer, end_layer;
    size_t row_words;
    int32_t row_halves, layer_halves; /* modulo 2^32, as halves are counted */
    uint64_t *occupied;               /* of the first layer */
    bool is_far;                      /* from the nearer caches: more than 1 MiB of bits */
    tribox_report counts;
    tribox_writes writes;
    tribox_queue queue[TRIBOX_CLASSES];
    tribox_waiting waiting;
    tribox_strip strip[TRIBOX_SHAPES]; /* triangles that wait for their rows */
};

static inline int64_t tribox_least(int64_t a, int64_t b) { return a < b ? a : b; }
static inline int64_t tribox_greatest(int64_t a, int64_t b) { return a > b ? a : b; }

/*
 * The lattice in float, about this origin, whose place is `off`. Float is a filter where it tells places in the grid apart by less
 * than half a cell, and nothing overflows (PROOFS.md 7.9): whether it does.
 */
bool tribox_voxels_make_float(tribox_voxels *v, const float origin[3], const double off[3]);

/*
 * A window of a sound grid as a grid of its own; the plan is made. In the environment of environment.h: open it, put soups into it,
 * close it. Bits and counts are whole when it is closed.
 */
void tribox_voxels_open(tribox_voxels *v, const tribox_grid *grid, const uint32_t first[3], const uint32_t size[3],
                        uint64_t *occupied);
void tribox_voxels_put(tribox_voxels *v, const tribox_soup *soup);
void tribox_voxels_close(tribox_voxels *v);

/* Before the first triangle, once sizes and layers are known. */
void tribox_voxels_start(tribox_voxels *v, uint64_t *occupied);

/* Cells first to last of row (j, k) wait with their triangle. */
void tribox_voxels_wait(tribox_voxels *v, const tribox_triangle *triangle, int64_t first, int64_t last, int64_t j, int64_t k);

/* The same of all cells, where the triangle is finite. */
void tribox_voxels_wait_everywhere(tribox_voxels *v, const tribox_triangle *triangle);

/* Settles the cells that wait, but those that are set by now: once more after the last triangle. */
void tribox_voxels_settle(tribox_voxels *v);

/* A triangle that touches these cells of the grid: a line is set, another joins the strip of its shape. */
void tribox_voxels_take(tribox_voxels *v, const tribox_triangle *triangle, const tribox_cell_range *range);

/* The rows of all strips that hold triangles. */
void tribox_voxels_set_strips(tribox_voxels *v);

/* One triangle, whatever its numbers: the planes of the grid decide which cells its box touches. */
void tribox_voxels_add(tribox_voxels *v, const tribox_triangle *triangle);

/* Plane p of axis a of the grid or window; of a grid in float. */
static inline float tribox_voxels_plane(const tribox_voxels *v, int a, uint64_t p)
{
    return tribox_grid_plane(v->grid, a, v->first[a] + p);
}

/* The three numbers of axis a of triangle `number` of the mesh. */
static inline void tribox_voxels_read(const tribox_voxels *v, int32_t number, int a, double u[3])
{
    const tribox_mesh *const mesh = v->mesh;
    const char *const from = (const char *)mesh->positions + (size_t)a * mesh->axis_stride;
    const size_t corner = 3 * (v->first_triangle + (size_t)number);
    for (size_t j = 0; j < 3; j++)
        u[j] = tribox_number_read(mesh, from + tribox_vertex_number(mesh, tribox_vertex_bytes(mesh), corner + j) * mesh->stride);
}

/* Triangle `number` of the mesh. */
tribox_triangle tribox_voxels_numbered(const tribox_voxels *v, int32_t number);

/* The triangle of a mesh whose cells are found by no limits, but by asking blocks of them, and blocks of these (PROOFS.md 7.10). */
void tribox_voxels_ask(tribox_voxels *v, const tribox_triangle *triangle, const tribox_cell_range *range);

#endif
