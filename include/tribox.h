/*
 * tribox.h - which of many triangles overlap a box, or the cells of a grid
 *
 * The separating-axis test of T. Akenine-Moller, "Fast 3D Triangle-Box Overlap Testing" (2001), for many triangles at once:
 * thirteen axes, structure of arrays, one kernel per instruction set, chosen at run time.
 *
 * What every function guarantees
 *   Closed sets   Triangles and boxes contain their borders: touching is overlap. A degenerate triangle is treated as the segment
 *                 or point that its vertices span. Vertex order and winding never change an EXACT answer.
 *   Units         Any unit of length, the same for triangles and boxes. There are no tolerances: no length is "small".
 *   NaN, inf      A triangle with a NaN or infinite coordinate overlaps nothing. This is not an error.
 *   Errors        Are returned as a tribox_status, and then nothing is written. The library never prints, exits or allocates.
 *   Threads       Every function is re-entrant: no locks, and no state but the kernel, which is chosen once. Any number of threads
 *                 may make calls on the same input at once. Threads that share a mask should each own whole words of it.
 *   Environment   The caller's rounding mode and flush-to-zero setting change no answer and are restored on return.
 *   Memory        No alignment or padding is needed. Nothing is read outside the input or written outside the mask. Masks and
 *                 reports must not overlap the input or each other. No call takes more than 108 KB of stack.
 *   Not promised  FAST and CONSERVATIVE masks may differ between kernels, tribox_report.undecided between kernels and versions.
 *                 EXACT masks never differ.
 */
#ifndef TRIBOX_H
#define TRIBOX_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The version of this header, and of the library that it belongs to. */
#define TRIBOX_VERSION_MAJOR 1
#define TRIBOX_VERSION_MINOR 0
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

/*
 * Which call: tribox_NAME of a soup, nine arrays of floats; tribox_mesh_NAME of a mesh, indexed or an array of structures.
 *
 *   one box                              overlap; also what is inside: classify; the first: find; an oriented box: overlap_oriented
 *   very many boxes, the same triangles  tribox_index_build once, then tribox_index_list, _lists, _overlap or _any
 *   a node of an octree, with its list   split: its eight children at once
 *   a grid, or leaves of one size        voxelize: a bit a cell; tribox_window_cells lists those that are set
 *   the same beyond memory; as spans,    tile_lists, then bricks: what is set alone, to a function of yours (examples/bricks.c)
 *     a hash of cells or a sparse tree
 *   each cell: which triangles           voxelize_ids or bricks_ids for the lowest; cell_lists or bricks_lists for all
 *   what a surface encloses              voxelize, then tribox_fill_outside or fill_parity
 *   one triangle, many boxes of floats   tribox_overlap_boxes
 */

/* ============================================================================================================================== */
/*                                                      Triangles and boxes                                                       */
/* ============================================================================================================================== */

/**
 * A closed axis-aligned box. Index: 0 is x, 1 is y, 2 is z. lo == hi makes it a rectangle, a segment or a point; lo > hi on any
 * axis makes it the empty box, which nothing overlaps.
 *
 * Bounds are doubles even if triangles are floats: 0.1 means the double 0.1, and no bound is rounded to float.
 */
typedef struct tribox_box {
    double lo[3]; /* the lower bound on each axis, part of the box */
    double hi[3]; /* the upper bound on each axis, part of the box */
} tribox_box;

/**
 * A closed oriented box: the points p with |axis[k] . (p - center)| <= half[k] for k = 0, 1, 2. Index of axis: first which axis,
 * then its x, y, z. The formula is taken literally for the doubles given. The axes need not be orthonormal (rounded numbers hardly
 * ever are) and may even be sheared. A negative half length makes it the empty box.
 */
typedef struct tribox_oriented_box {
    double center[3];  /* in the same unit of length as the triangles */
    double half[3];    /* half the length along each axis, in units of that axis: a length if the axes are unit vectors */
    double axis[3][3]; /* axis[k]: the direction of axis k */
} tribox_oriented_box;

/**
 * Boxes as six streams (structure of arrays). Index: axis first, then box.
 * Each stream has `count` floats, at any alignment; it may be NULL when count is 0.
 */
typedef struct tribox_boxes {
    const float *lo[3]; /* lo[a][i]: the lower bound of box i on axis a */
    const float *hi[3]; /* hi[a][i]: its upper bound */
    size_t count;       /* boxes */
} tribox_boxes;

/**
 * A triangle soup: nine streams (structure of arrays). Index: vertex first, then triangle. Each stream has `count` floats, at any
 * alignment; it may be NULL when count is 0. An array of triangles of nine numbers each is not a soup: it is a tribox_mesh without
 * indices.
 */
typedef struct tribox_soup {
    const float *x[3]; /* x[v][i]: the x of vertex v (0, 1, 2) of triangle i */
    const float *y[3]; /* y[v][i]: the y of the same vertex */
    const float *z[3]; /* z[v][i]: the z of the same vertex */
    size_t count;      /* triangles in the soup */
} tribox_soup;

/**
 * Triangles as most programs hold them, of floats or of doubles: an indexed mesh, or an array of structures with nine numbers per
 * triangle. Vertex v of triangle i is vertex number indices[3 * i + v], or number 3 * i + v without indices. Zero-initialise fields
 * that you do not set.
 *
 * For a matrix whose columns are x, y and z, set axis_stride to the size of a column in bytes; a stride of 0 then means
 * position_bytes. An axis_stride of 0 or position_bytes means that x, y and z are adjacent; a stride of 0 then means 12, or 24 for
 * doubles.
 *
 * axes renames the stored numbers: 321 takes the third as x and the first as z. Rows of a grid then run along another axis, and
 * nothing is copied: with 321 the bits lie as in a C array occupied[x][y][z], and with 231, if y is up, a column is a row. Boxes
 * and grids use the renamed axes. Voxelizing takes the same time. For single boxes, rename the axes of the box instead.
 */
typedef struct tribox_mesh {
    const void *positions;   /* x, y, z of vertex 0; vertex n lies n * stride bytes after it, at any alignment */
    size_t stride;           /* bytes from one vertex to the next: at least 12, or 24 for doubles; 0 if there are no gaps */
    size_t vertices;         /* how many vertices there are; nothing after the z of the last is read */
    const void *indices;     /* 3 * count vertex numbers, at any alignment; NULL for 0, 1, 2, 3, ... */
    unsigned index_bytes;    /* 2 for uint16_t, 4 for uint32_t; ignored if indices is NULL */
    size_t count;            /* triangles */
    unsigned position_bytes; /* 4, or 0, for positions of float; 8 for double */
    size_t axis_stride;      /* bytes from x to y, and from y to z: at least position_bytes, or 0 if the three follow each other */
    unsigned axes;           /* which stored number is x, which y and which z: 0 or 123 as stored, or another order of 1, 2 and 3 */
    uint32_t reserved[4];    /* zero, or TRIBOX_BAD_ARGUMENT */
} tribox_mesh;

/* ============================================================================================================================== */
/*                                                   Status, options and report                                                   */
/* ============================================================================================================================== */

/** The result of a call. Anything but TRIBOX_OK means that nothing was written, except bricks that a sink was handed. */
typedef enum tribox_status {
    TRIBOX_OK = 0,       /* the call succeeded */
    TRIBOX_BAD_ARGUMENT, /* a required pointer is NULL, or a count, range, stride or index size is not allowed */
    TRIBOX_BAD_BOX,      /* a number of the box is NaN or infinite, or the middle at which to split it is not within it */
    TRIBOX_BAD_GRID,     /* the grid is not finite, not positive, too large, or so fine that two planes are one number */
    TRIBOX_BAD_OPTION,   /* an option is unknown, or not available in this call; or a reserved number is not zero */
    TRIBOX_NO_KERNEL,    /* the kernel's name is unknown, or this processor cannot run it, or -ffp-contract=fast has broken it */
    TRIBOX_BAD_VERTEX,   /* a mesh refers to a vertex (tribox_mesh_bad_vertices), or a list to a triangle, that does not exist */
    TRIBOX_STOPPED       /* a sink ended the call: the bricks that it was handed are right, the rest are missing */
} tribox_status;

/** The version of the library at run time, such as "1.0.0", which may be newer than this header. Static storage. */
TRIBOX_API const char *tribox_version(void);

/** What a status means, in English, without a full stop. Static storage; never NULL. */
TRIBOX_API const char *tribox_status_text(tribox_status status);

/**
 * How accurate an answer has to be. CONSERVATIVE and FAST err only within rounding of contact, which means that on some axis the
 * projections of triangle and box are apart, or overlap, by less than single precision can tell. Let F_a be the triangle's extent
 * on axis a, and m_a the greatest distance on that axis of a point of the triangle from a point of the box. The projections are dot
 * products with the axis. They may be wrong by less than 2^-19 (F_a m_b + F_b m_a) for a cross product of edges in the plane of
 * axes a and b, by less than 2^-19 (F_x F_y m_z + F_y F_z m_x + F_z F_x m_y) for the triangle's normal, and by less than 2^-64 if
 * products or lengths underflow.
 *
 * The guarantee is weak if the axis is short: the normal of a segment or sliver, or an axis of an edge far shorter than the others.
 * Rounding alone then decides whether that axis separates, and FAST can miss a triangle that runs straight through the box. It
 * misses most segments that are much longer than the box, and some slivers that are more than 2^16 times as long as high (2^16 / k
 * times if they are k times as long as a side of the box). Use EXACT or CONSERVATIVE for these. Use EXACT if triangles lie in faces
 * of boxes: if coordinates are rounded, to tenths for example, rounding alone decides the sign of a tie. FAST is wrong about some
 * of these contacts: from a sixth to three times as many as the paper's test in float, as the box has it (PROOFS.md 10). With
 * TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES, CONSERVATIVE costs hardly more than FAST on slivers, but also reports wider triangles that
 * only the plane separates.
 */
typedef enum tribox_accuracy {
    TRIBOX_EXACT = 0,    /* the true answer for every finite float input, the same on every processor */
    TRIBOX_CONSERVATIVE, /* never misses an overlap; may report a triangle that misses the box within rounding of contact */
    TRIBOX_FAST          /* single precision: may err either way within rounding of contact; for |coordinate| <= 2^40 only */
} tribox_accuracy;

/**
 * The paper's three groups of axes (section 2, its bullets 1, 2 and 3): 3 box normals, 1 triangle plane, 9 edge cross products.
 * A call without some of the groups answers "no chosen axis separates": cheaper, and it never misses, but it reports more.
 */
enum {
    TRIBOX_AXES_BOX = 1,   /* bullet 1: the triangle's bounding box against the box */
    TRIBOX_AXES_PLANE = 2, /* bullet 2: the triangle's plane against the box */
    TRIBOX_AXES_EDGES = 4, /* bullet 3: the cross products of box edges and triangle edges */
    TRIBOX_AXES_ALL = 7    /* all thirteen axes */
};

/**
 * Options of a call. Zero-initialised, they are the defaults: exact, all thirteen axes, the best order and kernel. For a soup,
 * orders 213 and 231 run the same code, as do 312 and 321: the first group alone, then all three for the triangles that it leaves.
 * They pay if the box normals reject few triangles and the first group most of them. Otherwise they take up to 10 times as long as
 * 132 (tribox-bench sweep). For a mesh, for boxes, and for a call without some of the groups, the order makes no difference.
 */
typedef struct tribox_options {
    tribox_accuracy accuracy; /* TRIBOX_EXACT by default */
    unsigned axes;            /* a union of TRIBOX_AXES_*; 0 for all */
    unsigned axis_order;      /* of the groups: 123, 132, 213, 231, 312 or 321; 0 lets the call choose; it changes no answer */
    const char *kernel;       /* "scalar", "sse2", "avx2", "avx512" or "neon"; NULL for the best that this processor runs */
    uint32_t reserved[4];     /* zero, or TRIBOX_BAD_OPTION */
} tribox_options;

/** What a call counted. */
typedef struct tribox_report {
    size_t overlapping; /* bits set in the mask, or cells newly set by a voxelization */
    size_t undecided;   /* pairs that a slower stage decided: what a call costs; differs by kernel, order and block (0 for FAST) */
} tribox_report;

/* ============================================================================================================================== */
/*                                                    Many triangles, one box                                                     */
/* ============================================================================================================================== */

/**
 * Tests every triangle of a soup against one box.
 * Bit i % 64 of mask[i / 64] is set if triangle i overlaps the box; bits past count are zero.
 *
 * soup: nine streams of soup->count floats. A stream is not loaded once no triangle needs it.
 * box: finite bounds, or TRIBOX_BAD_BOX; nothing overlaps the empty box (lo > hi on an axis).
 * options: NULL for the defaults.
 * mask: tribox_mask_words(soup->count) words, all of them written; NULL if only the counts are wanted.
 * report: written on TRIBOX_OK; NULL if not wanted.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (soup, box or a stream of a non-empty soup is NULL, or count floats exceed the address
 * space), TRIBOX_BAD_BOX, TRIBOX_BAD_OPTION or TRIBOX_NO_KERNEL.
 */
TRIBOX_API tribox_status tribox_overlap(const tribox_soup *soup, const tribox_box *box, const tribox_options *options,
                                        uint64_t *mask, tribox_report *report);

/**
 * tribox_overlap for an oriented box. As in the paper (section 2) the triangles are moved into the frame of the box, in blocks, and
 * tested there.
 *
 * EXACT is the true answer about the box given by these doubles, for every finite input: if rounding of the move could change the
 * answer, exact signs decide. CONSERVATIVE never misses: the box is enlarged by what the move can have rounded. A false positive
 * would overlap if each half length were greater by 2^-17 of |axis| * |p - center|, where p is its own farthest vertex, or by 2^-12
 * of |axis| times the greatest half / |axis|. No other triangle of the call matters. FAST moves and tests in single precision; add
 * 2^-21 of |axis| * |p - center| to its rounding of contact. It misses segments and slivers as tribox_overlap does, including
 * triangles that the move makes thin. Most triangles that are outside along one axis of the box are rejected while they are moved.
 *
 * If an axis of the box is a unit vector along an axis of space, and the two other axes of the box are 0 there, no float is moved
 * along it. So a box that is turned about the vertical and stands on the floor of a model takes little longer than one just above
 * the floor. If all three axes are like that, and double holds the bounds of the box, EXACT is tribox_overlap. Otherwise EXACT
 * leaves every triangle that lies in a turned face to the last stage, and for a flat box (a half length of zero) every overlap. The
 * last stage takes half a microsecond a triangle, or some microseconds, rarely tens, if double cannot tell a sign. Positions of
 * double are always moved.
 *
 * box: finite, or TRIBOX_BAD_BOX.
 * options: EXACT takes all thirteen axes, or TRIBOX_AXES_BOX alone (the triangle's bounding box in the frame); any other set is
 *   TRIBOX_BAD_OPTION, as the rounded frame does not fix the directions of edge and plane axes.
 *
 * Other arguments and the returned status are as for tribox_overlap.
 */
TRIBOX_API tribox_status tribox_overlap_oriented(const tribox_soup *soup, const tribox_oriented_box *box,
                                                 const tribox_options *options, uint64_t *mask, tribox_report *report);

/** What tribox_find looks for. */
typedef enum tribox_find_what {
    TRIBOX_FIRST_HIT, /* the first triangle that overlaps the box: do any? */
    TRIBOX_FIRST_MISS /* the first that does not, which one with a NaN or infinite coordinate never does: do all? */
} tribox_find_what;

/**
 * Finds the first triangle of a soup that overlaps the box, or the first that misses it. The search stops at the end of the block,
 * of some thousand triangles, in which that triangle lies.
 *
 * triangle: receives the triangle's number, or soup->count if there is none.
 *
 * Other arguments and the returned status are as for tribox_overlap; TRIBOX_BAD_ARGUMENT also if triangle is NULL or `what` is
 * neither.
 */
TRIBOX_API tribox_status tribox_find(const tribox_soup *soup, const tribox_box *box, const tribox_options *options,
                                     tribox_find_what what, size_t *triangle);

/**
 * Divides the triangles of a soup into three kinds, as tree builders need: triangles that miss the box (bit clear in both masks),
 * straddle its border (set in mask alone) or lie wholly inside (set in both). A triangle is inside if its three vertices are in the
 * closed box. Inside is exact at every accuracy, and a triangle that is inside overlaps. FAST may answer parts of the soup as EXACT
 * does, if EXACT costs no more.
 *
 * inside: tribox_mask_words(soup->count) words, all of them written; NULL if not wanted.
 *
 * Other arguments and the returned status are as for tribox_overlap.
 */
TRIBOX_API tribox_status tribox_classify(const tribox_soup *soup, const tribox_box *box, const tribox_options *options,
                                         uint64_t *mask, uint64_t *inside, tribox_report *report);

/* ============================================================================================================================== */
/*                                                      Meshes and one box                                                        */
/* ============================================================================================================================== */

/**
 * tribox_overlap for a mesh as it is, of floats or doubles: exact for every finite number, however far from the origin, without
 * memory for streams. Moving the mesh towards the origin first is unnecessary, and gains nothing.
 *
 * mesh: read in place, in blocks that fit the cache. With indices each vertex is compared with the box once. That decides most
 *   triangles, as long as triangles near each other in the list use vertices near each other in number, as in most files. FAST does
 *   not do this for floats.
 * box, options, mask, report: as for tribox_overlap, with mesh->count in place of soup->count. For floats the same bits as for the
 *   nine streams of the triangles, at every accuracy. For doubles, and for floats with an axis_stride other than position_bytes,
 *   FAST is the same as CONSERVATIVE: it never misses, and any false positives lie within the bounds of tribox_accuracy, for
 *   doubles with 2^-47 in place of 2^-19. The order of the axes is then ignored. Only all axes, or TRIBOX_AXES_BOX alone, are fast:
 *   with other sets every triangle that the box normals leave takes the second stage.
 *
 * Returns what tribox_overlap does; TRIBOX_BAD_ARGUMENT also if a size or a stride of the mesh is not allowed, or a reserved number
 * is not zero; TRIBOX_BAD_VERTEX if a triangle refers to a vertex that does not exist.
 */
TRIBOX_API tribox_status tribox_mesh_overlap(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options,
                                             uint64_t *mask, tribox_report *report);

/**
 * tribox_classify for a mesh: which triangles miss the box, straddle its border, and lie wholly inside. Other arguments and the
 * returned status are as for tribox_classify and tribox_mesh_overlap.
 */
TRIBOX_API tribox_status tribox_mesh_classify(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options,
                                              uint64_t *mask, uint64_t *inside, tribox_report *report);

/**
 * tribox_overlap_oriented for a mesh as it is. EXACT is the true answer about its numbers, for every finite double and every finite
 * box. For floats it gives the same bits as for the nine streams of the triangles, at every accuracy. Doubles are rounded to float
 * relative to the center of the box, so no distance from the origin makes an answer slower or less accurate. If the product of that
 * distance and an axis exceeds 2^97, or float is too narrow for the box, every triangle takes the last stage.
 *
 * Other arguments and the returned status are as for tribox_overlap_oriented and tribox_mesh_overlap.
 */
TRIBOX_API tribox_status tribox_mesh_overlap_oriented(const tribox_mesh *mesh, const tribox_oriented_box *box,
                                                      const tribox_options *options, uint64_t *mask, tribox_report *report);

/**
 * tribox_find for a mesh. Only the indices of triangles that are tested are checked. Other arguments and the returned status are as
 * for tribox_find and tribox_mesh_overlap.
 */
TRIBOX_API tribox_status tribox_mesh_find(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options,
                                          tribox_find_what what, size_t *triangle);

/* ============================================================================================================================== */
/*                                              Many triangles, the children of a box                                             */
/* ============================================================================================================================== */

/**
 * Tests listed triangles against the eight children of a box at once: the inner loop of a program that builds an octree from lists
 * of triangles or, with a middle at an end of some axes, a quadtree or a k-d tree. Bit c of children[i] is set if triangle list[i]
 * overlaps child c.
 *
 * On axis a, child c has the bounds lo .. middle if bit a of c is clear, and middle .. hi if it is set. Children are closed: a
 * triangle that touches the plane between two children overlaps both. EXACT is tribox_overlap of each child, with its bounds as
 * doubles. The other accuracies answer within the bounds of tribox_accuracy.
 *
 * For the cells of a uniform grid, do not build top-down: tribox_bricks gives the cells of the lowest level many times as fast.
 *
 * soup: nine streams of soup->count floats.
 * list: `count` triangle numbers, in any order, and any of them more than once. NULL for all triangles of the soup: count is then
 *   soup->count.
 * box: finite bounds, or TRIBOX_BAD_BOX. Nothing overlaps the empty box, nor any child of it, whatever its middle.
 * middle: one plane on each axis, in lo .. hi; at an end a child is flat. NULL for the double nearest to (lo + hi) / 2.
 * options: all axes or TRIBOX_AXES_BOX alone; any other set is TRIBOX_BAD_OPTION. NULL for the defaults.
 * children: `count` bytes, all of them written; must not overlap the list. NULL if only the counts are wanted.
 * report: overlapping counts bits, undecided pairs of a triangle and a child; NULL if not wanted.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (soup, box or a stream of a non-empty soup is NULL, count or soup->count floats exceed the
 * address space, or there is no list and count is not soup->count), TRIBOX_BAD_BOX (also if the middle is not finite or not within
 * the box), TRIBOX_BAD_OPTION, TRIBOX_NO_KERNEL, or TRIBOX_BAD_VERTEX if the list names a triangle that does not exist.
 */
TRIBOX_API tribox_status tribox_split(const tribox_soup *soup, const uint32_t *list, size_t count, const tribox_box *box,
                                      const double middle[3], const tribox_options *options, uint8_t *children,
                                      tribox_report *report);

/**
 * tribox_split for a mesh, of floats or doubles: EXACT is tribox_mesh_overlap of each child. Doubles take FAST as CONSERVATIVE, and
 * their children are as fast as a child of tribox_mesh_overlap only if every side of a child is between 2^-36 and 2^36.
 *
 * mesh: only the indices of listed triangles are checked.
 *
 * Other arguments are as for tribox_split, as is the returned status, plus the mesh errors of tribox_mesh_overlap.
 */
TRIBOX_API tribox_status tribox_mesh_split(const tribox_mesh *mesh, const uint32_t *list, size_t count, const tribox_box *box,
                                           const double middle[3], const tribox_options *options, uint8_t *children,
                                           tribox_report *report);

/* ============================================================================================================================== */
/*                                                    One triangle, many boxes                                                    */
/* ============================================================================================================================== */

/**
 * Tests one triangle against many boxes, of any sizes and at any places.
 * Bit i % 64 of mask[i / 64] is set if the triangle overlaps box i; bits past count are zero.
 *
 * A call pays from some eight boxes on. For many triangles against the children of a box use tribox_split, and for the cells of a
 * grid tribox_voxelize or tribox_bricks: each is many times as fast.
 *
 * Bounds are floats, as the kernel has a box in each lane: doubles would take twice as many lanes. Rounding bounds changes answers.
 * If yours are not floats, call tribox_overlap for each box, or one of the calls just named, which all take doubles.
 *
 * triangle: triangle[3 * v + a] is axis a of vertex v. With a NaN or infinite coordinate it overlaps nothing.
 * boxes: six streams of boxes->count floats. A box that is empty, or has a NaN or infinite bound, overlaps nothing. This is not an
 *   error.
 * options, mask, report: as for tribox_overlap, with boxes->count in place of soup->count.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (triangle, boxes or a stream of a non-empty set is NULL, or count floats exceed the
 * address space), TRIBOX_BAD_OPTION or TRIBOX_NO_KERNEL.
 */
TRIBOX_API tribox_status tribox_overlap_boxes(const float triangle[9], const tribox_boxes *boxes, const tribox_options *options,
                                              uint64_t *mask, tribox_report *report);

/* ============================================================================================================================== */
/*                                                   Box after box: an index                                                      */
/* ============================================================================================================================== */

/**
 * An index over a soup or a mesh: a tree of bounding boxes, of every 64 triangles, of every 64 of those boxes, and so on, in memory
 * that you provide. The time of a query then grows with its answer and with the border of the box, not with the number of
 * triangles. Answers are the same, bit for bit, as by tribox_overlap or tribox_mesh_overlap, and for doubles exact about the
 * doubles.
 *
 * It pays if triangles that are near in number are near in space, as tribox_soup_sort and tribox_mesh_sort order them. Any other
 * order gives the same answers, at worst at about the speed of no index.
 *
 * The nodes hold no addresses: they may be copied, mapped, or written to a file for the same version of the library and the same
 * byte order. Whatever they contain, nothing is read outside them and the triangles, even if the triangles have changed since. A
 * triangle that then refers to a vertex that does not exist overlaps nothing. Any number of threads may query at once.
 */
typedef struct tribox_index {
    const void *nodes;       /* tribox_index_bytes(count) bytes, at any alignment, fastest at 64; not read by a build */
    const tribox_soup *soup; /* the triangles: either this soup, and mesh is NULL, */
    const tribox_mesh *mesh; /* or this mesh of floats or doubles, and soup is NULL */
    const uint32_t *ids;     /* lists give ids[i] for triangle i, say the order that it was gathered by; NULL for i itself */
    uint32_t reserved[4];    /* zero, or TRIBOX_BAD_ARGUMENT */
} tribox_index;

/** What an index is queried with: a box or an oriented box. The other pointer must be NULL, or TRIBOX_BAD_ARGUMENT. */
typedef struct tribox_region {
    const tribox_box *box;               /* finite, or TRIBOX_BAD_BOX */
    const tribox_oriented_box *oriented; /* finite, or TRIBOX_BAD_BOX */
} tribox_region;

/** The size in bytes of an index over count triangles: some 1.1 % of their soup, and at least 1600. It overflows for no count. */
TRIBOX_API size_t tribox_index_bytes(size_t count);

/**
 * Builds an index: reads its soup or mesh once, and writes the nodes. Triangles with a NaN or infinite coordinate overlap nothing,
 * and do not slow down queries near other triangles.
 *
 * options: only the kernel matters; NULL for the best. Every kernel builds the same bytes, and so do a soup and a mesh of floats.
 * nodes: tribox_index_bytes(count of triangles) bytes, all of them written. Must not overlap the triangles.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (index or nodes are NULL; not exactly one of soup and mesh is given; a reserved number is
 * not zero; what tribox_overlap or tribox_mesh_overlap says of the triangles), TRIBOX_NO_KERNEL or TRIBOX_BAD_VERTEX (a triangle
 * refers to a vertex that does not exist).
 */
TRIBOX_API tribox_status tribox_index_build(const tribox_index *index, const tribox_options *options, void *nodes);

/** Triangles under one node of the lowest level: the unit in which threads share an update of an index. */
enum { TRIBOX_INDEX_BLOCK = 4096 };

/**
 * Brings an index up to date if only triangles first .. first + count - 1 have changed. The bytes are then the ones that
 * tribox_index_build would write.
 *
 * Threads may share this work, or that of a build, by ranges of whole blocks, which begin at a multiple of TRIBOX_INDEX_BLOCK and
 * end at one or with the triangles. An update of such a range writes nothing that other ranges share, unless it is of all
 * triangles, so any number of threads may update ranges at once. When all are done, finish the index with one call of count 0.
 * Before that call, answers may be wrong.
 *
 * index, options: as for tribox_index_build.
 * nodes: of an index over as many triangles.
 *
 * Returns what tribox_index_build does, but TRIBOX_BAD_VERTEX only for the blocks that are read; TRIBOX_BAD_ARGUMENT also if
 * first + count exceeds the count of triangles.
 */
TRIBOX_API tribox_status tribox_index_update(const tribox_index *index, size_t first, size_t count, const tribox_options *options,
                                             void *nodes);

/**
 * tribox_overlap, or its form for a mesh or an oriented box, by an index. EXACT and CONSERVATIVE give the same mask as that call.
 * FAST adds all triangles of groups of 64 that lie wholly inside the box, as it does not test them. For an oriented box
 * CONSERVATIVE and FAST may differ, within rounding of contact, from the call without an index: groups that certainly miss the box,
 * or certainly lie inside, are not tested.
 *
 * index: the nodes, and the triangles that they were built over. With other triangles or damaged nodes the answers are wrong, but
 *   nothing worse happens.
 * region: finite, or TRIBOX_BAD_BOX.
 * options: as for tribox_overlap, but the axes must include TRIBOX_AXES_BOX, because without it triangles far away overlap too.
 * mask: all of its words are written, however few triangles overlap. With NULL the call only counts, and reads the least.
 *
 * Other arguments and the returned status are as for tribox_overlap, tribox_mesh_overlap or tribox_overlap_oriented, except that
 * vertices are not checked again; TRIBOX_BAD_ARGUMENT also if tribox_index_build returns it, or if region does not have exactly one
 * box; TRIBOX_BAD_OPTION also without TRIBOX_AXES_BOX.
 */
TRIBOX_API tribox_status tribox_index_overlap(const tribox_index *index, const tribox_region *region, const tribox_options *options,
                                              uint64_t *mask, tribox_report *report);

/**
 * The words of that mask that are not zero, in ascending order: bit b of bits[k] means that triangle 64 * number[k] + b overlaps.
 *
 * room: how many words number, bits and inside have room for; further words are not written.
 * inside: as in tribox_classify, for the same words: which triangles lie wholly inside; NULL if not wanted. At FAST such triangles
 *   are then set in bits, too.
 * found: receives how many words there are, even if that exceeds room.
 *
 * Other arguments and the returned status are as for tribox_index_overlap; TRIBOX_BAD_ARGUMENT also if found is NULL, number or
 * bits is NULL and room is not 0, inside is not NULL about an oriented box, or there are more than 2^38 triangles.
 */
TRIBOX_API tribox_status tribox_index_words(const tribox_index *index, const tribox_region *region, const tribox_options *options,
                                            size_t room, uint32_t *number, uint64_t *bits, uint64_t *inside, size_t *found,
                                            tribox_report *report);

/**
 * Lists the triangles that overlap, by their index->ids, or by their numbers without ids; in ascending order of the numbers.
 *
 * room: how many triangles list has room for; further ones are not written.
 * found: receives how many triangles overlap, even if that exceeds room.
 *
 * Other arguments and the returned status are as for tribox_index_overlap; TRIBOX_BAD_ARGUMENT also if found is NULL, list is NULL
 * and room is not 0, or there are more than 2^32 triangles.
 */
TRIBOX_API tribox_status tribox_index_list(const tribox_index *index, const tribox_region *region, const tribox_options *options,
                                           size_t room, uint32_t *list, size_t *found);

/**
 * The lists of many boxes, one after another: that of box i is list[start[i]] .. list[start[i + 1] - 1]. Boxes near in number
 * should be near in space (tribox_boxes_sort), so that their triangles are still in the cache.
 *
 * boxes: six streams. A box that is empty, or has a NaN or infinite bound, has an empty list. This is not an error.
 * room: as for tribox_index_list. Lists are written in turn until room is used up.
 * start: boxes->count + 1 numbers, all of them written; start[boxes->count] is the room that all lists together need.
 *
 * Other arguments and the returned status are as for tribox_index_list; TRIBOX_BAD_ARGUMENT also if boxes, a stream of a non-empty
 * set or start is NULL.
 */
TRIBOX_API tribox_status tribox_index_lists(const tribox_index *index, const tribox_boxes *boxes, const tribox_options *options,
                                            size_t room, uint32_t *list, size_t *start);

/**
 * Finds any one triangle that overlaps the region: not the first, but at EXACT the same one on every processor. FAST may find a
 * triangle that lies wholly inside and that tribox_overlap misses at FAST.
 *
 * triangle: receives its number, or the count of triangles if none overlaps.
 *
 * Other arguments and the returned status are as for tribox_index_overlap; TRIBOX_BAD_ARGUMENT also if triangle is NULL.
 */
TRIBOX_API tribox_status tribox_index_any(const tribox_index *index, const tribox_region *region, const tribox_options *options,
                                          size_t *triangle);

/**
 * Finds an order in which triangles that are near in number are near in space: order[k] is the triangle that comes k-th. It is the
 * same on every processor.
 *
 * The triangles are cut in two across the longest side of their extent, and so are the parts, down to the 64 of a word. Cuts lie at
 * multiples of the greatest power of 64 below the count, so that no node of an index straddles one. Triangles are compared by the
 * middle of their bounding box, then by number. Triangles with a NaN or infinite coordinate come last. The time grows with count *
 * log(count), whatever the triangles are. tribox_threads.h has the single steps, for threads that share the work.
 *
 * order: room for soup->count numbers.
 * scratch: 16 bytes for each triangle, aligned as floats are. The call also takes up to 64 KB of stack.
 *
 * Returns TRIBOX_OK or TRIBOX_BAD_ARGUMENT (soup or a stream of a non-empty soup is NULL; order or scratch is NULL and the soup is
 * not empty; count is more than 2^32 or exceeds the address space).
 */
TRIBOX_API tribox_status tribox_soup_sort(const tribox_soup *soup, uint32_t *order, void *scratch);

/** tribox_soup_sort for boxes. Boxes with a NaN or infinite bound come last. */
TRIBOX_API tribox_status tribox_boxes_sort(const tribox_boxes *boxes, uint32_t *order, void *scratch);

/**
 * tribox_soup_sort for a mesh. Floats have the order of the nine streams of the triangles. Doubles are rounded to float relative to
 * the median of up to 64 vertices from all over the mesh, axis by axis, after scaling by a power of two if they lie very far apart
 * or very close. So the order is as good far from zero, in any unit of length, and with a few triangles far from all others.
 *
 * Other arguments and the returned status are as for tribox_soup_sort; TRIBOX_BAD_ARGUMENT also if tribox_mesh_overlap returns it,
 * TRIBOX_BAD_VERTEX if a triangle refers to a vertex that does not exist.
 */
TRIBOX_API tribox_status tribox_mesh_sort(const tribox_mesh *mesh, uint32_t *order, void *scratch);

/**
 * Writes triangles order[first] .. order[first + count - 1] of a soup as nine streams: x[v][i], y[v][i] and z[v][i] are vertex v of
 * triangle order[first + i]. Threads may each write a part of the streams.
 *
 * order: at least first + count triangles of the soup, in any order; a triangle may come more than once.
 * x, y, z: three streams each, of `count` floats, at any alignment, which must not overlap the soup's. Values are copied as they
 *   are, NaN and infinity included.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (soup or a stream of a non-empty soup is NULL; order or a stream that is written is NULL
 * and count > 0; first + count exceeds the address space) or TRIBOX_BAD_VERTEX (these places of order name a triangle that the
 * soup does not have).
 */
TRIBOX_API tribox_status tribox_soup_gather(const tribox_soup *soup, const uint32_t *order, size_t first, size_t count,
                                            float *const x[3], float *const y[3], float *const z[3]);

/**
 * tribox_soup_gather for a mesh: from its triangles as they are to ordered streams, relative to an origin as in
 * tribox_mesh_to_soup.
 *
 * Returns what tribox_soup_gather does; TRIBOX_BAD_ARGUMENT also if tribox_mesh_to_soup does, TRIBOX_BAD_VERTEX also if one of
 * these triangles refers to a vertex that does not exist.
 */
TRIBOX_API tribox_status tribox_mesh_gather(const tribox_mesh *mesh, const double origin[3], const uint32_t *order, size_t first,
                                            size_t count, float *const x[3], float *const y[3], float *const z[3]);

/* ============================================================================================================================== */
/*                                                        Cells of a grid                                                         */
/* ============================================================================================================================== */

/**
 * A grid of size[0] x size[1] x size[2] closed cells, which need not be cubes. Index: 0 is x, 1 is y, 2 is z.
 * Plane p of axis a lies at the double nearest to origin[a] + p * cell[a], rounded once (C's fma), for triangles of floats and of
 * doubles. The cells on both sides share that very number, so no surface can slip between them. If a cell is a power of two and the
 * origin a multiple of it, planes less than 2^53 cells from zero are not rounded (they are whole numbers of cells), so they are the
 * bounds that an octree finds by halving.
 *
 * Origin and planes must be finite, cells and sizes greater than zero, and no two planes of an axis the same double; otherwise
 * TRIBOX_BAD_GRID. A grid may have any number of cells; one call writes at most 2^31 words.
 */
typedef struct tribox_grid {
    double origin[3]; /* the lower corner of cell (0, 0, 0), in the same unit of length as the triangles */
    double cell[3];   /* the lengths of a cell, in the same unit */
    uint32_t size[3]; /* the number of cells on each axis */
} tribox_grid;

/** A box of cells: first[a] .. first[a] + size[a] - 1 of each axis. */
typedef struct tribox_window {
    uint32_t first[3]; /* the lowest cell */
    uint32_t size[3];  /* how many cells on each axis; 0 makes it empty */
} tribox_window;

/** The box of cell (i, j, k), each less than the grid's size on its axis: the very box that is tested by voxelizations. */
TRIBOX_API tribox_box tribox_grid_cell(const tribox_grid *grid, uint32_t i, uint32_t j, uint32_t k);

/**
 * The number of 64-bit words for the cells of a grid or window of this size: size[1] * size[2] rows of (size[0] + 63) / 64 words,
 * as every row along x starts a new word. SIZE_MAX if that overflows.
 */
TRIBOX_API size_t tribox_window_words(const uint32_t size[3]);

/**
 * Lists the set cells of a grid or window by z, then y, then x: each as i, j, k within it. Returns how many there are.
 *
 * occupied: as tribox_voxelize writes them; bits past a row's last cell are ignored.
 * size: of the grid or window; with a 0 there are no cells, and occupied may be NULL.
 * cells: room for as many cells as are set, which a call without room, or tribox_report.overlapping of one that began with clear
 *   bits, says; NULL to count them.
 */
TRIBOX_API size_t tribox_window_cells(const uint64_t *occupied, const uint32_t size[3], uint32_t (*cells)[3]);

/**
 * Sets the bit of every cell that some triangle of the soup overlaps. Bits are only set, never cleared, so soups accumulate. Only
 * the surface is marked: a cell inside a closed mesh that no triangle overlaps stays clear.
 *
 * EXACT is by definition tribox_overlap of every triangle with every tribox_grid_cell, for every axis set. CONSERVATIVE sets a
 * superset. With all axes, with BOX, or with BOX and EDGES, the extra cells miss their triangle by less than 2^-7 of a cell on some
 * axis, and by more only if there are more than 2^13 cells along an axis, or if floats near the window are hardly finer than its
 * cells. With other sets of axes, a triangle whose vertices are nearly on a line may set cells farther away. FAST uses the same
 * limits without error bounds, except for that of the plane, and may err as much either way. Triangles may lie partly or wholly
 * outside the grid.
 *
 * window: the cells that are wanted; NULL for the whole grid. EXACT gives the bits of the whole grid. So do the other accuracies if
 *   the window consists of whole layers of a grid with at most 2^30 layers: threads can each own some layers. In other windows they
 *   may differ from the whole grid within rounding of contact. Triangles outside the window cost next to nothing.
 * occupied: tribox_window_words(size) words, size being that of the window. Let rows have W = (size[0] + 63) / 64 words: cell
 *   (i, j, k) of the window, which is cell (first[0] + i, first[1] + j, first[2] + k) of the grid, is bit i % 64 of
 *   occupied[(k * size[1] + j) * W + i / 64]. Layer k alone begins at occupied + k * size[1] * W.
 * options: NULL for the defaults; the order of the axes is ignored here.
 * report: overlapping counts the cells newly set; NULL if not wanted, which spares the counting.
 *
 * The time grows with the triangles and the rows of cells that they cross, not with the cells of their bounding boxes. Warning:
 * axis sets without TRIBOX_AXES_BOX are slow, as every triangle is then tested against every cell of the window. Many triangles in
 * one call are faster than many calls, as small triangles are taken a packet at a time: with AVX2 or AVX-512 a call about 64 cells
 * takes 250 to 390 ns for one triangle, 420 to 690 for eight and 1,600 to 2,900 for 64 (tribox-bench calls; AMD EPYC, Zen 5,
 * virtual). So gather some hundred triangles first.
 *
 * A bit for every cell has to be cleared, and read again if you want a list of cells, spans or a sparse tree. If most cells are
 * clear, use tribox_bricks, which hands over only the set ones and touches no memory for the others. With 1024 cells along a mesh
 * it takes 0.7 to 2.1 times as long as the bits alone, lists by tile included (tribox-bench grids; AMD EPYC, Zen 4, virtual), and
 * spans take a quarter of the time of spans made from bits (examples/bricks.c).
 *
 * New memory costs more than its cells, as the system stops a program at its first touch of each page. With 1024 cells along a
 * mesh, a call into fresh memory from calloc takes 3 to 10 times as long as into pages of 2 MB (AMD EPYC, Zen 5, virtual, Linux).
 * Ask for such pages, in three lines (examples/large_pages.h), or reuse memory.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (a NULL pointer, count floats exceed the address space, or the window leaves the grid),
 * TRIBOX_BAD_GRID (also if there are more than 2^31 words to write: ask for windows), TRIBOX_BAD_OPTION or TRIBOX_NO_KERNEL.
 */
TRIBOX_API tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                                         const tribox_options *options, uint64_t *occupied, tribox_report *report);

/**
 * tribox_voxelize for a mesh, of floats or doubles: EXACT is tribox_mesh_overlap of the mesh with every tribox_grid_cell. A mesh of
 * floats gives the bits of its soup at every accuracy; for doubles FAST is treated as CONSERVATIVE.
 *
 * Returns what tribox_voxelize does; TRIBOX_BAD_ARGUMENT also if tribox_mesh_overlap returns it; TRIBOX_BAD_VERTEX if a triangle
 * refers to a vertex that does not exist.
 */
TRIBOX_API tribox_status tribox_mesh_voxelize(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_window *window,
                                              const tribox_options *options, uint64_t *occupied, tribox_report *report);

/**
 * tribox_voxelize that also says, for each cell that it sets, which triangle overlaps it: the one with the lowest number. EXACT has
 * only one answer, the same on every kernel and in every window. CONSERVATIVE and FAST give the lowest number of the triangles for
 * which they set the bit, and their ids may differ wherever their bits may. To find the triangle with the greatest area in a cell,
 * take all triangles of the cell (tribox_bricks_lists) and cut each at the cell's planes.
 *
 * Calls accumulate: if a bit is set before the call, its id stays if it is the lowest. So a soup may come in parts, in any order.
 *
 * first: the number of the soup's first triangle: 0, or how many triangles precede it in other calls. All numbers must be less than
 *   UINT32_MAX.
 * occupied: as for tribox_voxelize. If a bit is set before the call, its cell must have an id from an earlier call.
 * ids: one for each cell of the window, cell (i, j, k) at ids[(k * size[1] + j) * size[0] + i], without a gap after a row. An id is
 *   written only if its bit is set, so ids need not be cleared; if the bit is clear, the id means nothing. If the ids do not fit
 *   the caches, each set cell waits for memory, and in new memory for a page (see tribox_voxelize): tribox_bricks_ids works in
 *   tiles that fit.
 *
 * Threads that own some layers of the grid own the ids of these layers. Other arguments are as for tribox_voxelize.
 *
 * Returns what tribox_voxelize does; TRIBOX_BAD_ARGUMENT also if ids is NULL or numbers would reach UINT32_MAX; TRIBOX_BAD_GRID
 * also if the ids exceed the address space.
 */
TRIBOX_API tribox_status tribox_voxelize_ids(const tribox_soup *soup, uint32_t first, const tribox_grid *grid,
                                             const tribox_window *window, const tribox_options *options, uint64_t *occupied,
                                             uint32_t *ids, tribox_report *report);

/** tribox_voxelize_ids for a mesh, of floats or doubles. Returns what it does, plus the mesh errors of tribox_mesh_voxelize. */
TRIBOX_API tribox_status tribox_mesh_voxelize_ids(const tribox_mesh *mesh, uint32_t first, const tribox_grid *grid,
                                                  const tribox_window *window, const tribox_options *options, uint64_t *occupied,
                                                  uint32_t *ids, tribox_report *report);

/**
 * The cells of a thin surface: about half as many as by tribox_voxelize. A flat surface is one cell thick, and yet does not leak. A
 * cell is set if a triangle crosses one of the three lines through its middle along x, y and z, between the cell's planes. Such
 * surfaces are called 6-separating by J. Huang et al. ("An Accurate Method for Voxelizing Polygon Meshes", 1998); the three lines
 * are the crosshair of S. Laine, "A Topological Approach to Voxelization" (2013). Tests of planes and edges against a thinner box,
 * as by M. Schwarz and H.-P. Seidel, "Fast Parallel Surface and Solid Voxelization on GPUs" (2010), find more cells at edges.
 *
 * Exact, and without ties: lines are crossed as in tribox_fill_parity, which moves them by less than any distance. A triangle in
 * the plane between two cells sets one of them, and in a plane of the grid's border the cell within. A triangle along a line does
 * not cross it. Triangles without an area set nothing. The order of triangles and vertices makes no difference.
 *
 * Two clear cells that share a face are both inside or both outside a closed mesh (PROOFS.md 15.7). So no path across faces leads
 * through the surface, and both ways of filling work with these cells. Paths across edges and corners do lead through it. Use it
 * for surfaces that are built of blocks, counted, or simulated by neighbours across faces. A piece smaller than a cell may set no
 * cell.
 *
 * options: EXACT and all axes, or TRIBOX_BAD_OPTION; only the kernel matters. NULL for the defaults.
 * report: overlapping as for tribox_voxelize, undecided 0.
 *
 * Other arguments and the returned status are as for tribox_voxelize. Triangles with a NaN or infinite coordinate are left out.
 */
TRIBOX_API tribox_status tribox_voxelize_thin(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                                              const tribox_options *options, uint64_t *occupied, tribox_report *report);

/** tribox_voxelize_thin for a mesh, of floats or doubles. Returns what it does, plus the mesh errors of tribox_mesh_voxelize. */
TRIBOX_API tribox_status tribox_mesh_voxelize_thin(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_window *window,
                                                   const tribox_options *options, uint64_t *occupied, tribox_report *report);

/* ============================================================================================================================== */
/*                                                        Tiles and bricks                                                        */
/* ============================================================================================================================== */

/**
 * A share of the tiles of a grid. A grid beyond memory is voxelized tile by tile. Tiles are cubes of `side` cells a side, cut short
 * at the upper borders of the grid. Tile (i, j, k) has the number (k * nj + j) * ni + i, where ni and nj are the numbers of tiles
 * along x and y: size divided by side, rounded up. 128 cells a side suit the caches.
 *
 * A share is the work of one thread, or of a machine that has no memory for all tiles.
 */
typedef struct tribox_tiles {
    uint32_t side; /* cells along a side of a tile */
    size_t first;  /* the share: tiles first .. first + count - 1 */
    size_t count;  /* how many they are */
} tribox_tiles;

/** The number of tiles of a grid of this size; 0 if side or a size is 0, SIZE_MAX if there are too many to number. */
TRIBOX_API size_t tribox_tile_count(const uint32_t size[3], uint32_t side);

/**
 * Lists which triangles are in which tile, in two passes. Without a list it counts them, and writes where the list of each tile
 * begins. With a list, and the starts of a first pass with the same arguments, it writes the numbers of the triangles, in rising
 * order for each tile. With tiles of one cell, these are the lists by cell that builders of grids and trees need.
 *
 * If the share is all tiles of the grid, and the side is 1, 2 or 4, or 8 without a cut tile, EXACT makes the lists from the pairs
 * of triangle and cell that voxelizing finds. That mostly takes a half to a tenth of the time of the same tiles in several shares.
 *
 * A triangle is in a tile if it overlaps the tile's box, from the lowest plane of its cells to the highest: EXACT is by definition
 * tribox_overlap, CONSERVATIVE may list more, and FAST is treated as CONSERVATIVE.
 *
 * soup: at most 2^32 triangles.
 * grid: as for tribox_voxelize.
 * tiles: the share.
 * options: NULL for the defaults; the order of the axes is ignored. Without TRIBOX_AXES_BOX all triangles are tested against all
 *   tiles.
 * starts: tiles->count + 1 numbers, written if list is NULL. The list of tile tiles->first + t goes from starts[t] to before
 *   starts[t + 1], and the last number is the length of all lists. With a list they are read; they change during the call, and are
 *   the same again on return. They take 8 bytes a tile, with triangles or without: 1 GiB for all tiles of 128 in a grid of 65,536
 *   cells a side. If few tiles have triangles, find these by tribox_split and hand each to tribox_bricks, as voxelize of tribox.hpp
 *   does: its memory goes with the triangles.
 * list: starts[tiles->count] numbers, written; NULL to count.
 *
 * Returns what tribox_voxelize does; TRIBOX_BAD_ARGUMENT also if the side is 0, if the grid does not have all tiles of the share,
 * or if there are more than 2^32 triangles; TRIBOX_BAD_GRID also if all lists together exceed the address space.
 */
TRIBOX_API tribox_status tribox_tile_lists(const tribox_soup *soup, const tribox_grid *grid, const tribox_tiles *tiles,
                                           const tribox_options *options, size_t *starts, uint32_t *list);

/** tribox_tile_lists for a mesh, of floats or doubles. Returns what it does, plus the mesh errors of tribox_mesh_voxelize. */
TRIBOX_API tribox_status tribox_mesh_tile_lists(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_tiles *tiles,
                                                const tribox_options *options, size_t *starts, uint32_t *list);

/**
 * Lists which triangles overlap which cell of a window, in two passes like tribox_tile_lists with tiles of one cell. It gives all
 * triangles of a cell, while tribox_voxelize_ids gives the lowest, in 2.3 to 4.5 times its time (tribox-bench grids; AMD EPYC, Zen
 * 4, virtual). List a grid beyond memory window by window, from the triangles of each, or sparsely by tribox_bricks_lists.
 *
 * soup, grid, options: as for tribox_tile_lists; CONSERVATIVE lists a triangle for each cell that tribox_voxelize sets for it.
 * window: NULL for the whole grid.
 * starts: one for each cell of the window, and one more: cell (i, j, k) has the triangles from starts[c] to before starts[c + 1] of
 *   the list, where c = (k * size[1] + j) * size[0] + i. Otherwise as for tribox_tile_lists.
 *
 * With EXACT, tribox_voxelize sets exactly the cells that have triangles here, and the lists of a window are the same as in the
 * whole grid.
 *
 * Returns what tribox_tile_lists does; TRIBOX_BAD_ARGUMENT also if the window is not within the grid.
 */
TRIBOX_API tribox_status tribox_cell_lists(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                                           const tribox_options *options, size_t *starts, uint32_t *list);

/** tribox_cell_lists for a mesh, of floats or doubles. Returns what it does, plus the mesh errors of tribox_mesh_voxelize. */
TRIBOX_API tribox_status tribox_mesh_cell_lists(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_window *window,
                                                const tribox_options *options, size_t *starts, uint32_t *list);

/**
 * Receives bricks: 8 x 8 x 8 cells of which some are set. Bit i + 8 j of bits[k] is cell (8 at[0] + i, 8 at[1] + j, 8 at[2] + k),
 * for i, j, k = 0 .. 7. take returns 0 to go on; anything else ends the call. It runs in the caller's floating-point environment,
 * may call the library, and must return.
 */
typedef struct tribox_sink {
    int (*take)(void *data, const uint32_t at[3], const uint64_t bits[8]); /* 0 to go on */
    void *data;                                                            /* what take is handed */
} tribox_sink;

/** The bytes of scratch that tribox_bricks needs for tiles of this side, whatever the grid; SIZE_MAX if that overflows. */
TRIBOX_API size_t tribox_bricks_bytes(uint32_t side);

/**
 * tribox_voxelize for grids whose cells need not fit into memory, or are mostly clear: hands each brick that is not empty to a
 * sink, once. Use it for hashes of cells, for sparse trees (the levels above are the numbers of bricks, shifted) and for spans: if
 * the axes of the mesh make the height x, each row of a brick is a byte (examples/bricks.c). EXACT gives the cells of
 * tribox_voxelize. The other accuracies may differ from it within rounding of contact.
 *
 * Tiles come in the order of their numbers, and the bricks of each by z, then y, then x. Shares of the tiles together give the
 * bricks of the whole, so they may be spread over threads, tasks and machines. Tiles without triangles cost next to nothing. Each
 * tile uses the same scratch, so the call touches no new memory (see tribox_voxelize), but a sink that keeps bricks does.
 *
 * soup, grid: as for tribox_voxelize.
 * tiles: the share; its side is a multiple of 8, at most 1024.
 * starts, list: for each tile, which triangles to look at; starts[0] is for the first tile of the share. Usually take them from
 *   tribox_tile_lists for the same axes, at any accuracy. Other lists work too: triangles not listed for a tile are not in its
 *   bricks.
 * scratch: tribox_bricks_bytes(tiles->side) bytes, at any alignment; one for each thread.
 * report: overlapping counts the cells of all bricks that were handed to the sink; NULL if not wanted.
 *
 * Returns what tribox_voxelize does; TRIBOX_BAD_ARGUMENT also for another side, a share that the grid does not have, a sink without
 * take, or decreasing starts; TRIBOX_BAD_VERTEX if a list names a triangle that the soup does not have, when bricks of earlier
 * tiles have already been handed to the sink; TRIBOX_STOPPED if the sink ended the call: the report then covers what it was handed.
 */
TRIBOX_API tribox_status tribox_bricks(const tribox_soup *soup, const tribox_grid *grid, const tribox_tiles *tiles,
                                       const size_t *starts, const uint32_t *list, const tribox_options *options, void *scratch,
                                       const tribox_sink *sink, tribox_report *report);

/**
 * tribox_bricks for a mesh, of floats or doubles: EXACT gives the cells of tribox_mesh_voxelize. TRIBOX_BAD_VERTEX also if a
 * triangle of a list refers to a vertex that does not exist; with indices, triangles that are in no list are not checked.
 */
TRIBOX_API tribox_status tribox_mesh_bricks(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_tiles *tiles,
                                            const size_t *starts, const uint32_t *list, const tribox_options *options,
                                            void *scratch, const tribox_sink *sink, tribox_report *report);

/**
 * Receives bricks with ids: as tribox_sink, and ids[64 * k + 8 * j + i] is the lowest number of a triangle that overlaps cell
 * (i, j, k) of the brick, or UINT32_MAX where its bit is clear. They are valid until take returns.
 */
typedef struct tribox_ids_sink {
    int (*take)(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512]); /* 0 to go on */
    void *data;                                                                                     /* what take is handed */
} tribox_ids_sink;

/**
 * The bytes of scratch that tribox_bricks_ids needs for tiles of this side, most of them four for each cell of a tile; SIZE_MAX if
 * that overflows. Tiles of 64 cells a side, whose ids fit into 1 MiB, suit the caches.
 */
TRIBOX_API size_t tribox_bricks_ids_bytes(uint32_t side);

/**
 * tribox_bricks with an id for each cell, as by tribox_voxelize_ids: with EXACT the lowest number of a triangle that overlaps it
 * and is listed for its tile. Ids are numbers of triangles in the soup, whatever the order of a list.
 *
 * soup: of fewer than 2^32 triangles.
 * scratch: tribox_bricks_ids_bytes(tiles->side) bytes, at any alignment; one for each thread.
 *
 * Other arguments and the returned status are as for tribox_bricks.
 */
TRIBOX_API tribox_status tribox_bricks_ids(const tribox_soup *soup, const tribox_grid *grid, const tribox_tiles *tiles,
                                           const size_t *starts, const uint32_t *list, const tribox_options *options, void *scratch,
                                           const tribox_ids_sink *sink, tribox_report *report);

/** tribox_bricks_ids for a mesh, of floats or doubles. Returns what it does, plus the mesh errors of tribox_mesh_bricks. */
TRIBOX_API tribox_status tribox_mesh_bricks_ids(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_tiles *tiles,
                                                const size_t *starts, const uint32_t *list, const tribox_options *options,
                                                void *scratch, const tribox_ids_sink *sink, tribox_report *report);

/**
 * Receives bricks with the triangles of each cell: as tribox_sink, and cell (i, j, k) of the brick, which has the number
 * c = 64 * k + 8 * j + i, is overlapped by triangles[starts[c]] .. triangles[starts[c + 1] - 1], in rising order. starts[512] is
 * how many there are in all. They are valid until take returns.
 */
typedef struct tribox_lists_sink {
    int (*take)(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t starts[513],
                const uint32_t *triangles); /* 0 to go on */
    void *data;                             /* what take is handed */
} tribox_lists_sink;

/**
 * The bytes of scratch that tribox_bricks_lists needs for tiles of this side; SIZE_MAX if that overflows, or side is above 1024.
 *
 * most: the length of the longest list of a tile. Scratch has room for that whole list in each cell of a brick, about 2 KB a
 *   triangle. Only as much is touched as there are pairs.
 */
TRIBOX_API size_t tribox_bricks_lists_bytes(uint32_t side, size_t most);

/**
 * tribox_bricks with all triangles of each cell, as by tribox_cell_lists, from the list of its tile. EXACT gives the triangles that
 * overlap the cell, the other accuracies the triangles for which they set its bit. If a list names a triangle twice, it comes
 * twice. Tiles of 64 cells a side suit the caches.
 *
 * soup: at most 2^32 triangles.
 * scratch: tribox_bricks_lists_bytes(tiles->side, most) bytes, at any alignment; one for each thread.
 * report: undecided counts pairs of cells and triangles.
 *
 * Other arguments and the returned status are as for tribox_bricks; TRIBOX_BAD_GRID also if a brick has 2^32 pairs or more, when
 * bricks before it have already been handed to the sink.
 */
TRIBOX_API tribox_status tribox_bricks_lists(const tribox_soup *soup, const tribox_grid *grid, const tribox_tiles *tiles,
                                             const size_t *starts, const uint32_t *list, const tribox_options *options,
                                             void *scratch, const tribox_lists_sink *sink, tribox_report *report);

/** tribox_bricks_lists for a mesh, of floats or doubles. Returns what it does, plus the mesh errors of tribox_mesh_bricks. */
TRIBOX_API tribox_status tribox_mesh_bricks_lists(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_tiles *tiles,
                                                  const size_t *starts, const uint32_t *list, const tribox_options *options,
                                                  void *scratch, const tribox_lists_sink *sink, tribox_report *report);

/* ============================================================================================================================== */
/*                                                      Insides of surfaces                                                       */
/* ============================================================================================================================== */

/** The bytes of scratch that filling needs for a grid of this size, about two bits a row of cells; SIZE_MAX if that overflows. */
TRIBOX_API size_t tribox_fill_bytes(const uint32_t size[3]);

/**
 * Fills what a surface encloses: sets every cell that cannot be reached from outside the grid across faces of cells that are not
 * occupied. Exact by construction, as it depends on nothing but the cells of the surface. Surfaces may be doubled,
 * self-intersecting or in pieces; a hole of a cell or more lets the outside in.
 *
 * size: of the grid: at most 2^31 words.
 * occupied: the cells of the surface, as tribox_voxelize writes them; bits past a row's last cell are ignored.
 * scratch: tribox_fill_bytes(size) bytes, at any alignment.
 * solid: as many words as occupied, not overlapping it; written: the surface and its inside, with zeros past each row's last cell.
 * inside: receives how many cells were filled, not counting occupied ones; NULL if not wanted.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (a NULL pointer) or TRIBOX_BAD_GRID (a size of 0, or too many words).
 */
TRIBOX_API tribox_status tribox_fill_outside(const uint32_t size[3], const uint64_t *occupied, void *scratch, uint64_t *solid,
                                             size_t *inside);

/**
 * Fills by parity: sets every cell for which the surface crosses the line along x an odd number of times below the cell's middle.
 * Exact: the signs of determinants of the numbers themselves decide about crossings. If a line meets an edge or a vertex, or a
 * middle lies on the surface, the middle is moved a little, by the same rule for all triangles (symbolic perturbation). On a closed
 * mesh it fills what tribox_fill_outside fills, except pockets outside the mesh that cells of the surface seal off. What a mesh
 * encloses twice is outside. If the mesh is open, there are streaks along x: see odd_rows, and examples/insides for pictures.
 *
 * soup, grid: as the surface was voxelized. The middle of a cell lies at the double nearest to the middle of its planes or, if
 *   there is no double between them, at the lower plane.
 * occupied, scratch, solid, inside: as for tribox_fill_outside, for the words of the grid. If no bit of occupied is set, solid has
 *   the cells whose middles are inside the mesh, as in programs that voxelize by sampling middles (the centre rule).
 * odd_rows: receives how many rows of cells along x have an odd number of crossings in all. If there is one, the mesh is certainly
 *   not closed. NULL if not wanted.
 *
 * Triangles with a NaN or infinite coordinate are left out. Returns what tribox_voxelize does.
 */
TRIBOX_API tribox_status tribox_fill_parity(const tribox_soup *soup, const tribox_grid *grid, const uint64_t *occupied,
                                            void *scratch, uint64_t *solid, size_t *inside, size_t *odd_rows);

/** tribox_fill_parity for a mesh, of floats or doubles. Returns what it does, plus the mesh errors of tribox_mesh_voxelize. */
TRIBOX_API tribox_status tribox_mesh_fill_parity(const tribox_mesh *mesh, const tribox_grid *grid, const uint64_t *occupied,
                                                 void *scratch, uint64_t *solid, size_t *inside, size_t *odd_rows);

/* ============================================================================================================================== */
/*                                                   Masks, meshes and kernels                                                    */
/* ============================================================================================================================== */

/** The number of 64-bit words in a mask of `count` bits: (count + 63) / 64, without overflow for any count. */
TRIBOX_API size_t tribox_mask_words(size_t count);

/**
 * Lists the set bits of a mask in ascending order. Returns how many there are.
 *
 * mask: tribox_mask_words(count) words; bits past count are ignored.
 * count: at most 2^32; longer masks are listed in parts.
 * indices: room for one index per set bit, of which there are tribox_report.overlapping; NULL to count them.
 */
TRIBOX_API size_t tribox_mask_indices(const uint64_t *mask, size_t count, uint32_t *indices);

/**
 * Counts the triangles of a soup that have a NaN or infinite coordinate. They overlap nothing, in any call. Other calls do not
 * count them, as they do not load all coordinates.
 *
 * soup: nine streams of soup->count floats; NULL, or NULL streams, count as an empty soup.
 * first: receives the lowest index of such a triangle, or the soup's count if there is none; NULL if not wanted.
 */
TRIBOX_API size_t tribox_soup_not_finite(const tribox_soup *soup, size_t *first);

/**
 * tribox_soup_not_finite for a mesh of floats or doubles. A triangle that names a vertex that does not exist is skipped
 * (tribox_mesh_bad_vertices).
 *
 * mesh: counts as empty if it is NULL, or if tribox_mesh_overlap would return TRIBOX_BAD_ARGUMENT for it.
 * first: as above.
 */
TRIBOX_API size_t tribox_mesh_not_finite(const tribox_mesh *mesh, size_t *first);

/**
 * Counts the indices of a mesh that refer to a vertex that does not exist.
 *
 * mesh: counts as empty if it is NULL, or if tribox_mesh_overlap would return TRIBOX_BAD_ARGUMENT for it.
 * first: receives the position of the first such index among all indices (its triangle is *first / 3, its corner *first % 3), or
 *   3 * count if there is none; NULL if not wanted.
 */
TRIBOX_API size_t tribox_mesh_bad_vertices(const tribox_mesh *mesh, size_t *first);

/**
 * Writes triangles first .. first + count - 1 of a mesh as the nine streams of a soup: x[v][i], y[v][i] and z[v][i] are vertex v of
 * triangle first + i. It is for calls that take a soup, and for triangles that are tested more than once.
 *
 * mesh: must not overlap the streams.
 * origin: with NULL floats are copied as they are, NaN and infinity included, and doubles are rounded; with finite numbers each
 *   coordinate u becomes the float nearest to u - origin, the difference taken in double. Answers about such streams are exact
 *   about these floats, which are off by 2^-24 of u - origin.
 * options: only the kernel matters; NULL for the best.
 * x, y, z: three streams each, of `count` floats, at any alignment. Numbers beyond the range of float become infinite.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (as tribox_mesh_overlap; a NULL stream and count > 0; origin is not finite; first +
 * count exceeds mesh->count), TRIBOX_BAD_VERTEX (only the indices of these triangles are checked) or TRIBOX_NO_KERNEL.
 */
TRIBOX_API tribox_status tribox_mesh_to_soup(const tribox_mesh *mesh, const double origin[3], size_t first, size_t count,
                                             const tribox_options *options, float *const x[3], float *const y[3],
                                             float *const z[3]);

/**
 * The name of the kernel that a call with these options runs, spelt as in tribox_options.kernel; NULL if none can run, because the
 * name is unknown or this processor cannot run that kernel. Static storage.
 *
 * options: NULL for the defaults.
 */
TRIBOX_API const char *tribox_kernel_name(const tribox_options *options);

/**
 * The name of the i-th kernel that this processor runs, widest first and the scalar one last, spelt as in tribox_options.kernel;
 * NULL if i is past the last. Kernel 0 is the default. Static storage.
 */
TRIBOX_API const char *tribox_kernel_list(size_t i);

#ifdef __cplusplus
}
#endif

#endif
