/*
 * tribox - do these triangles overlap this axis-aligned box, or these cells of a grid?
 *
 * The separating-axis test of T. Akenine-Moller, "Fast 3D Triangle-Box Overlap Testing" (2001), asked of very many triangles at
 * once: thirteen axes, structure of arrays, one kernel per instruction set, chosen at run time.
 *
 * What every function keeps
 *   Closed sets   Triangle and box contain their borders: touching is overlap. A degenerate triangle is the segment or the point
 *                 that it is. Vertex order and winding never change an EXACT answer.
 *   Units         Any one length unit for triangles and boxes alike. There is no tolerance anywhere: no length is "small".
 *   NaN, inf      A triangle with a NaN or infinite coordinate overlaps nothing; that is no error.
 *   Errors        Come back as a tribox_status; on an error nothing is written. The library never prints, exits or allocates.
 *   Threads       Every function is pure and re-entrant: no locks, no state but the once-chosen kernel. Any number of threads may
 *                 call at once on shared input. Threads that share a mask should own whole words of it.
 *   Environment   The caller's rounding mode and flush-to-zero setting change no answer and are restored on return.
 *   Memory        No alignment or padding is asked for; nothing is read outside the streams or written outside the mask. The mask
 *                 and the report overlap no stream.
 *   Not promised  FAST and CONSERVATIVE masks may differ between kernels, and tribox_report.undecided between kernels and
 *                 versions. EXACT masks never differ.
 */
#ifndef TRIBOX_H
#define TRIBOX_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The version of this header, which is that of the library. */
#define TRIBOX_VERSION_MAJOR 0
#define TRIBOX_VERSION_MINOR 1
#define TRIBOX_VERSION_PATCH 0

#if defined(_WIN32) && defined(TRIBOX_SHARED_BUILD)
#define TRIBOX_API __declspec(dllexport)
#elif defined(_WIN32) && defined(TRIBOX_SHARED)
#define TRIBOX_API __declspec(dllimport)
#elif defined(__GNUC__)
#define TRIBOX_API __attribute__((visibility("default")))
#else
#define TRIBOX_API
#endif

/**
 * A closed axis-aligned box: touching it counts as overlapping it. Index: 0 is x, 1 is y, 2 is z.
 * lo == hi makes it a rectangle, a segment or a point; lo > hi on any axis is the empty box, which nothing overlaps.
 */
typedef struct tribox_box {
    float lo[3]; /* the lower bound on each axis, part of the box */
    float hi[3]; /* the upper bound on each axis, part of the box */
} tribox_box;

/**
 * A triangle soup as nine streams (structure of arrays). Index: vertex first, then triangle.
 * Streams of `count` floats each, any alignment; they may be NULL when count is 0.
 */
typedef struct tribox_soup {
    const float *x[3]; /* x[v][i]: the x of vertex v (0, 1, 2) of triangle i */
    const float *y[3]; /* y[v][i]: the y of the same vertex */
    const float *z[3]; /* z[v][i]: the z of the same vertex */
    size_t count;      /* triangles in the soup */
} tribox_soup;

/**
 * Boxes as six streams (structure of arrays). Index: axis first, then box.
 * Streams of `count` floats each, any alignment; they may be NULL when count is 0.
 */
typedef struct tribox_boxes {
    const float *lo[3]; /* lo[a][i]: the lower bound of box i on axis a */
    const float *hi[3]; /* hi[a][i]: its upper bound */
    size_t count;       /* boxes */
} tribox_boxes;

/** What a call answers about itself. Everything but TRIBOX_OK means that nothing was written. */
typedef enum tribox_status {
    TRIBOX_OK = 0,
    TRIBOX_BAD_ARGUMENT, /* a pointer that must not be NULL is; a count that overflows */
    TRIBOX_BAD_BOX,      /* a bound is NaN or infinite */
    TRIBOX_BAD_GRID,     /* a grid that is not finite, not positive, too large, or too fine for float */
    TRIBOX_BAD_OPTION,   /* an unknown accuracy, axis set or order */
    TRIBOX_NO_KERNEL,    /* an unknown kernel name, or one this processor cannot run */
    TRIBOX_NO_MEMORY,    /* for programs around the library, which itself never allocates */
    TRIBOX_BAD_INDEX     /* a mesh refers to a vertex that it does not have; tribox_mesh_bad_indices names the first */
} tribox_status;

/** One English sentence for a status: what is wrong, without a full stop. Static storage; never NULL. */
TRIBOX_API const char *tribox_status_text(tribox_status status);

/** How right an answer has to be. */
typedef enum tribox_accuracy {
    TRIBOX_EXACT = 0,    /* the true answer for every finite float input, the same on every processor */
    TRIBOX_CONSERVATIVE, /* never misses an overlap; may report one that is not, within a proved error bound */
    TRIBOX_FAST          /* single precision: errs within a stated bound of contact, for |coordinate| <= 2^40 only */
} tribox_accuracy;

/**
 * The paper's three groups of axes (section 2, its bullets 1, 2 and 3): 3 box normals, 1 triangle plane, 9 edge cross products.
 * Leaving groups out answers "no chosen axis separates": cheaper, never misses, reports more.
 */
enum {
    TRIBOX_AXES_BOX = 1,   /* bullet 1: the triangle's bounding box against the box */
    TRIBOX_AXES_PLANE = 2, /* bullet 2: the triangle's plane against the box */
    TRIBOX_AXES_EDGES = 4, /* bullet 3: the cross products of box edges and triangle edges */
    TRIBOX_AXES_ALL = 7
};

/** Options of a call. Zero-initialised they are the defaults: exact, all thirteen axes, the best order and kernel. */
typedef struct tribox_options {
    tribox_accuracy accuracy; /* TRIBOX_EXACT by default */
    unsigned axes;            /* a union of TRIBOX_AXES_*; 0 for all */
    unsigned order;     /* 123, 132, 213, 231, 312 or 321: the order of the groups, which changes no answer; 0 for the default */
    const char *kernel; /* "scalar", "sse2", "avx2", "avx512" or "neon"; NULL for the best this processor runs */
} tribox_options;

/** What a call counted. */
typedef struct tribox_report {
    size_t overlapping; /* set bits in the mask, or cells newly set by a voxelization */
    size_t undecided;   /* pairs left to a slower stage: a measure of cost, may differ between kernels (0 for FAST) */
} tribox_report;

/** How many 64-bit words a mask of `count` bits takes: (count + 63) / 64, for every count without overflow. */
TRIBOX_API size_t tribox_mask_words(size_t count);

/**
 * Tells for each triangle of a soup whether it overlaps one box.
 * Bit i % 64 of mask[i / 64] is set when triangle i overlaps the box; bits past count are zero.
 *
 * soup: nine streams of soup->count floats. Streams that an earlier axis made needless are not even loaded.
 * box: finite bounds, or TRIBOX_BAD_BOX; the empty box (lo > hi on an axis) is overlapped by nothing.
 * options: NULL for the defaults.
 * mask: tribox_mask_words(soup->count) words, all of them written; NULL when only the counts are wanted.
 * report: written on TRIBOX_OK; NULL when not wanted.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (soup, box or a stream of a non-empty soup is NULL, or count floats exceed the address
 * space), TRIBOX_BAD_BOX, TRIBOX_BAD_OPTION or TRIBOX_NO_KERNEL.
 */
TRIBOX_API tribox_status tribox_overlap(const tribox_soup *soup, const tribox_box *box, const tribox_options *options,
                                        uint64_t *mask, tribox_report *report);

/**
 * Counts the triangles of a soup that have a NaN or infinite coordinate. They overlap nothing, in every call; the batch calls do
 * not look for them, since they need not even load what an earlier axis made needless.
 *
 * soup: nine streams of soup->count floats; NULL, or NULL streams, count as an empty soup.
 * first: receives the lowest index of such a triangle, or the soup's count if there is none; NULL when not wanted.
 */
TRIBOX_API size_t tribox_soup_not_finite(const tribox_soup *soup, size_t *first);

/**
 * Tells for each of many boxes whether one triangle overlaps it: the inner loop of octree and grid builders.
 * Bit i % 64 of mask[i / 64] is set when the triangle overlaps box i; bits past count are zero.
 *
 * triangle: triangle[v][a] is axis a of vertex v. With a NaN or infinite coordinate it overlaps nothing. (Before C23 a pedantic C
 *   compiler wants a cast to `const float (*)[3]` where the array itself is not const.)
 * boxes: six streams of boxes->count floats. An empty box, or one with a NaN or infinite bound, overlaps nothing; it is no error.
 * options, mask, report: as for tribox_overlap, with boxes->count in place of soup->count.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (triangle, boxes or a stream of a non-empty set is NULL, or count floats exceed the
 * address space), TRIBOX_BAD_OPTION or TRIBOX_NO_KERNEL.
 */
TRIBOX_API tribox_status tribox_overlap_boxes(const float triangle[3][3], const tribox_boxes *boxes, const tribox_options *options,
                                              uint64_t *mask, tribox_report *report);

/**
 * Triangles as people hold them: an indexed mesh, or an array of structures with nine floats a triangle. Index: vertex v of triangle
 * i is vertex number indices[3 * i + v]; without indices, vertex number 3 * i + v.
 */
typedef struct tribox_mesh {
    const void *positions; /* x, y, z of vertex 0 as floats; vertex n lies n * stride bytes on, at any alignment */
    size_t stride;         /* bytes from a vertex to the next: 12 or more; 0 stands for 12 */
    size_t vertices;       /* vertices that there are; nothing after the z of the last is read */
    const void *indices;   /* 3 * count vertex numbers, at any alignment; NULL for 0, 1, 2, 3, ... */
    unsigned index_bytes;  /* 2 for uint16_t, 4 for uint32_t; of no account where indices is NULL */
    size_t count;          /* triangles */
} tribox_mesh;

/**
 * tribox_overlap for a mesh as it is: the same bits as for the nine streams of its triangles, without memory for them.
 *
 * mesh: read in blocks that fit the cache. Its positions and indices overlap neither mask nor report.
 * box, options, mask, report: as for tribox_overlap, with mesh->count in place of soup->count.
 *
 * Returns what tribox_overlap does; TRIBOX_BAD_ARGUMENT also for a stride of 1 to 11 and for index_bytes that are neither 2 nor 4;
 * TRIBOX_BAD_INDEX if a triangle refers to a vertex that is not there. All indices are looked at first.
 */
TRIBOX_API tribox_status tribox_overlap_indexed(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options,
                                                uint64_t *mask, tribox_report *report);

/**
 * Counts the indices of a mesh that refer to no vertex.
 *
 * mesh: NULL, or one that tribox_overlap_indexed would call TRIBOX_BAD_ARGUMENT, counts as an empty mesh.
 * first: receives the place of the first of them among all indices (its triangle is *first / 3, its corner *first % 3), or
 *   3 * count if there is none; NULL when not wanted.
 */
TRIBOX_API size_t tribox_mesh_bad_indices(const tribox_mesh *mesh, size_t *first);

/**
 * Writes triangles first .. first + count - 1 of a mesh as nine streams: x[v][i], y[v][i] and z[v][i] are vertex v of triangle
 * first + i. For the calls that take a soup, and for soups that are asked more than once.
 *
 * mesh: its positions and indices overlap no stream. options: only the kernel counts; NULL for the best.
 * x, y, z: three streams each, of `count` floats, any alignment. Values are copied as they are, NaN and infinity included.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (as tribox_overlap_indexed; a NULL stream where count > 0; first + count exceeds
 * mesh->count), TRIBOX_BAD_INDEX (only the indices of these triangles are looked at) or TRIBOX_NO_KERNEL.
 */
TRIBOX_API tribox_status tribox_mesh_to_streams(const tribox_mesh *mesh, size_t first, size_t count, const tribox_options *options,
                                                float *const x[3], float *const y[3], float *const z[3]);

/**
 * Finds the first triangle of a soup that overlaps the box: "does any?". What comes after its block of some thousand triangles is
 * not looked at.
 *
 * first: receives its index, or soup->count if no triangle overlaps.
 * Other arguments and the returned status as for tribox_overlap; TRIBOX_BAD_ARGUMENT also if first is NULL.
 */
TRIBOX_API tribox_status tribox_overlap_any(const tribox_soup *soup, const tribox_box *box, const tribox_options *options,
                                            size_t *first);

/**
 * Finds the first triangle of a soup that does not overlap the box: "do all?". A triangle with a NaN or infinite coordinate does not.
 *
 * first: receives its index, or soup->count if all triangles overlap. All else as for tribox_overlap_any.
 */
TRIBOX_API tribox_status tribox_overlap_all(const tribox_soup *soup, const tribox_box *box, const tribox_options *options,
                                            size_t *first);

/**
 * Tells of each triangle of a soup whether it misses the box (its bit is clear in both masks), straddles its border (set in mask
 * alone) or lies wholly inside (set in both): what builders of trees ask. A triangle is inside when its three vertices are in the
 * closed box; that is told exactly at every accuracy, and a triangle that is inside overlaps.
 *
 * inside: tribox_mask_words(soup->count) words, all of them written; overlaps neither mask nor streams; NULL when not wanted.
 * Other arguments and the returned status as for tribox_overlap.
 */
TRIBOX_API tribox_status tribox_classify(const tribox_soup *soup, const tribox_box *box, const tribox_options *options,
                                         uint64_t *mask, uint64_t *inside, tribox_report *report);

/**
 * Lists the set bits of a mask in ascending order. Returns how many there are.
 *
 * mask: tribox_mask_words(count) words; bits past count are of no account. count: at most 2^32; longer masks go in parts.
 * indices: room for as many as there are set bits, which is tribox_report.overlapping; NULL to count them.
 */
TRIBOX_API size_t tribox_mask_indices(const uint64_t *mask, size_t count, uint32_t *indices);

/**
 * A closed oriented box: the points p with |axis[k] . (p - center)| <= half[k] for k = 0, 1, 2. Index of axis: first which axis, then
 * its x, y, z. This is the meaning for all floats as they are: no frame of floats is orthonormal to the last bit, and any three axes
 * serve, sheared ones too. A negative half length makes it the empty box.
 */
typedef struct tribox_oriented_box {
    float center[3];  /* in the soup's unit of length */
    float half[3];    /* half the length along each axis, in units of the axis: of length, where the axes are unit vectors */
    float axis[3][3]; /* axis[k]: the direction of axis k */
} tribox_oriented_box;

/**
 * tribox_overlap for an oriented box. As in the paper (section 2, "moved to the box's frame") the triangles are moved into the frame
 * of the box, in blocks, and tested there.
 *
 * EXACT is the true answer about that box for every finite input: what the rounding of the move could change is settled in integers.
 * CONSERVATIVE never misses: the box is enlarged by the most that the move can have rounded. FAST moves and tests in single precision;
 * to its bound of contact add 2^-21 of |axis| * |p - center|. A triangle beside the box along one of its axes is mostly rejected while
 * it is moved. Flat boxes (a half length of zero) are slow at EXACT: every overlap is settled in integers, some microseconds each.
 *
 * box: finite, or TRIBOX_BAD_BOX. options: EXACT takes all thirteen axes, or TRIBOX_AXES_BOX alone (the triangle's bounding box in the
 *   frame); another set is TRIBOX_BAD_OPTION, as the frame's rounding leaves the direction of an edge or plane axis open.
 * Other arguments and the returned status as for tribox_overlap.
 */
TRIBOX_API tribox_status tribox_overlap_oriented(const tribox_soup *soup, const tribox_oriented_box *box,
                                                 const tribox_options *options, uint64_t *mask, tribox_report *report);

/**
 * A grid of size[0] x size[1] x size[2] closed cells. Index: 0 is x, 1 is y, 2 is z.
 * Plane p of axis a lies at the float nearest to origin[a] + p * cell[a], evaluated in double; the cells on both sides share that
 * very number, so no surface can slip between them. Cells need not be cubes.
 *
 * A grid can be served when origin and planes are finite, cells and sizes are greater than zero, no two planes of an axis are the
 * same float, and tribox_grid_words is at most 2^31. Any other is TRIBOX_BAD_GRID.
 */
typedef struct tribox_grid {
    float origin[3];  /* the lower corner of cell (0, 0, 0), in the soup's unit of length */
    float cell[3];    /* the lengths of a cell, in the same unit */
    uint32_t size[3]; /* how many cells on each axis */
} tribox_grid;

/** The box of cell (i, j, k), each less than the grid's size on its axis: what every voxelization asks about. */
TRIBOX_API tribox_box tribox_grid_cell(const tribox_grid *grid, uint32_t i, uint32_t j, uint32_t k);

/** The 64-bit words of a row of cells along x: (size[0] + 63) / 64. A row starts with a word of its own. */
TRIBOX_API size_t tribox_grid_row_words(const tribox_grid *grid);

/** The words of the whole grid: row words * size[1] * size[2], or SIZE_MAX where that overflows. */
TRIBOX_API size_t tribox_grid_words(const tribox_grid *grid);

/**
 * Sets the bit of every cell that some triangle of the soup overlaps. Cell (i, j, k) is bit i % 64 of
 * occupied[(k * size[1] + j) * row_words + i / 64]. Bits are only set, never cleared, so soups accumulate.
 *
 * EXACT is by definition tribox_overlap of every triangle with every tribox_grid_cell, for every axis set; CONSERVATIVE sets a
 * superset of it, whose other cells are within the error bound of a row (src/kernel/rows.h: at most 2^-8 of a cell along x, more only
 * for edges nearly parallel to x and where planes are as coarse as cells); FAST takes the same limits without bounds. Unlike
 * tribox_overlap all this is computed in double. Triangles may lie outside the grid in part or wholly.
 *
 * occupied: tribox_grid_words(grid) words. options: NULL for the defaults; the order of the axes is of no account here.
 * report: overlapping counts the cells newly set; NULL when not wanted.
 *
 * The time goes with the triangles and the rows of cells that they meet, not with the cells of their bounding boxes; except for axis
 * sets without TRIBOX_AXES_BOX, which ask every cell of the grid about every triangle.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (a NULL pointer, or count floats exceed the address space), TRIBOX_BAD_GRID,
 * TRIBOX_BAD_OPTION or TRIBOX_NO_KERNEL.
 */
TRIBOX_API tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options,
                                         uint64_t *occupied, tribox_report *report);

/**
 * The same for the layers k = first .. first + layers - 1 alone, with the same bits as the whole at every accuracy: for threads, of
 * which each owns some layers, and for grids larger than memory. Cell (i, j, k) is bit i % 64 of
 * occupied[((k - first) * size[1] + j) * row_words + i / 64]: row words * size[1] * layers words, other layers have none.
 *
 * Returns what tribox_voxelize does; TRIBOX_BAD_ARGUMENT also where first + layers exceeds size[2].
 */
TRIBOX_API tribox_status tribox_voxelize_layers(const tribox_soup *soup, const tribox_grid *grid, uint32_t first, uint32_t layers,
                                                const tribox_options *options, uint64_t *occupied, tribox_report *report);

/**
 * The name of the kernel that a call with these options runs, spelt as in tribox_options.kernel; options may be NULL.
 * NULL if none can: an unknown name, or one this processor cannot run. Static storage.
 */
TRIBOX_API const char *tribox_kernel_name(const tribox_options *options);

/**
 * The kernels that this processor runs, widest first, the scalar one last: the name of kernel i, spelt as in tribox_options.kernel,
 * or NULL when i is past the last. Name 0 is the default. Static storage.
 */
TRIBOX_API const char *tribox_kernel_list(size_t i);

#ifdef __cplusplus
}
#endif

#endif
