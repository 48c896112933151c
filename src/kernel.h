/*
 * kernel.h - what a kernel is: its name, its lanes, its walks, and what they are asked. All that kernels and dispatch share.
 *
 * A walk answers words of 64 triangles (or boxes). For each word it writes two: `hit`, the lanes that overlap at the accuracy of
 * the call, and `undecided`, the lanes that it leaves to a slower stage. A lane is in at most one of the two.
 */
#ifndef TRIBOX_KERNEL_H
#define TRIBOX_KERNEL_H

#include <math.h>
#include <stdbool.h>

#include "base/bits.h"
#include "base/compiler.h"
#include "base/inexact_flag.h"
#include "base/rounded_box.h"
#include "pairs/rounded_frame.h"
#include "voxels/kernel_voxels.h"
#include "index/kernel_nodes.h"
#include "mesh/positions.h"
#include "base/soup.h"
#include "pairs/sequences.h"

/*
 * A small build (packaging/npm) has no scalar kernel, and walks of soups alone: it reads meshes by way of streams, and is without
 * tribox_overlap_boxes.
 */
#if defined(TRIBOX_SMALL)
enum { TRIBOX_WALKS_SOUPS_ALONE = 1 };
#else
enum { TRIBOX_WALKS_SOUPS_ALONE = 0 };
#endif

/* EXACT and CONSERVATIVE take one walk: they differ in how the pairs that it leaves undecided are settled. */
typedef enum tribox_walk_kind { TRIBOX_BY_MARGIN, TRIBOX_BY_SIGN, TRIBOX_WALK_KINDS } tribox_walk_kind;
TRIBOX_INLINE tribox_walk_kind tribox_walk_kind_of(tribox_accuracy accuracy)
{
    return accuracy == TRIBOX_FAST ? TRIBOX_BY_SIGN : TRIBOX_BY_MARGIN;
}

/*
 * Where triangles of a mesh lie: vertex v of triangle i is offset[3 * i + v] bytes after base, and four numbers can be read there.
 * Without offsets a triangle is nine numbers, and the next one follows it. Pairs have all corners.
 */
typedef struct tribox_corners {
    const char *base;
    const uint32_t *offset;
    const double *origin; /* NULL of floats; doubles are read less origin[k], of axis k % 3, and rounded: TRIBOX_LOCAL of them */
    bool has_all;         /* else another vertex stands for the last of the mesh */
    size_t ahead;         /* triangles of nine numbers that may come into the cache early: none where less than 2 MiB do */
    const char *const *place; /* of a few of floats, in place of all else: those of vertex v of triangle i are at 3 * i + v */
} tribox_corners;

/* The most lanes of float, and of double. The lanes of every kernel divide them. */
enum { TRIBOX_LANES_MAX = 16, TRIBOX_DOUBLES_MAX = 8 };

/* What doubles are read relative to, axis by axis, as often as the widest load needs it. */
enum { TRIBOX_LOCAL = 3 * TRIBOX_LANES_MAX };

/*
 * From where on a walk of a soup asks whether it computes ties exactly; else it leaves them undecided. For EXACT alone, about a box
 * whose bounds are floats.
 */
typedef enum tribox_ties { TRIBOX_TIES_LEFT, TRIBOX_TIES_WHERE_SEVERAL, TRIBOX_TIES_AT_ONCE } tribox_ties;

/* What a call asks: a soup or corners against a box, or a triangle against boxes. The caller has checked them. */
typedef struct tribox_query {
    const tribox_soup *soup;
    const tribox_corners *corners; /* all axes are asked */
    const tribox_rounded_box *box;
    const float *triangle; /* [3 * v + a]: axis a of vertex v */
    const tribox_boxes *boxes;
    size_t count;
    tribox_ties ties;
} tribox_query;

/*
 * Answers `count` pairs, one or more, from pair 64 * word on; bits past them are zero. Whole packets are read, the last of which
 * ends with the last pair: so a walk reads pairs before its first one, too. Where the streams have fewer pairs than the kernel has
 * lanes, there have to be numbers after them (tribox_partial_packet); tribox_walk_few needs none.
 */
typedef void tribox_walk(const tribox_query *pairs, size_t word, size_t count, uint64_t *hit, uint64_t *undecided);

/*
 * Answers the pairs of a query, 64 at most, about all axes, and returns the hits. Reads no other pair, however few they are. Of
 * corners it takes places: of whole packets, the last of which may repeat a triangle.
 */
typedef uint64_t tribox_walk_few(const tribox_query *pairs, size_t count, uint64_t *undecided);

/*
 * Walks of corners of doubles, rounded about the lower corner of their box, which begins at 0 (PROOFS.md 14). What rounding leaves
 * in doubt is undecided, so hits are overlaps of the doubles. TRIBOX_LOCAL_BOX tests the box normals alone.
 */
typedef enum tribox_local_walk { TRIBOX_LOCAL_BOX, TRIBOX_LOCAL_ALL, TRIBOX_LOCAL_WALKS } tribox_local_walk;

/*
 * What a survey saw of the packets of a word, bit k for packet k. Each is in one of `apart` if the box normals reject all lanes:
 * where the x axis does, or x and y, or all three. Of the others, the sets of groups (TRIBOX_AXES_*) that reject all lanes; if box
 * normals and plane do together, nothing is said of the edges.
 */
typedef struct tribox_seen {
    unsigned packets;
    uint64_t apart[3];
    uint64_t rejected[TRIBOX_AXES_ALL];
    bool has_ties, are_ties_exact; /* some were asked about; and nothing of the word is rounded */
} tribox_seen;

/* Answers a word of a soup whose pairs are all present, all axes asked, like a walk, and surveys it. Returns the hits. */
typedef uint64_t tribox_survey(const tribox_query *pairs, size_t word, tribox_seen *seen, uint64_t *undecided);

/*
 * Pairs that the walks left undecided, gathered: number[k][i] is number k of pair i, in the order x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1
 * z_2 (x_j is the x of vertex j), then lo and hi. The boxes are finite. No pair is apart on a box normal if the axes have BOX.
 */
enum { TRIBOX_BATCH = 64 };
typedef struct tribox_batch {
    _Alignas(64) double number[15][TRIBOX_BATCH];
} tribox_batch;

/* The triangles of a batch and of one more, as they lie in a soup: numbers of a triangle in the order of a batch. */
typedef struct tribox_packed {
    _Alignas(64) float number[9][2 * TRIBOX_BATCH + TRIBOX_LANES_MAX];
} tribox_packed;

/* These lanes of a word, out of `count` triangles in all, closed up from place `at` on, one of the first 64; and then anything. */
typedef void tribox_pack(const tribox_soup *soup, size_t count, size_t word, uint64_t lanes, tribox_packed *to, size_t at);

/*
 * Of the pairs of a batch, a bit each: those that overlap, those not decided, and those of a finite triangle, as all these are.
 * Wild are those not decided whose lengths are so small or so large that nothing is known of them; no pair of floats is.
 */
typedef struct tribox_verdict {
    uint64_t overlapping, undecided, finite, wild;
} tribox_verdict;

/*
 * The first `count` pairs of a batch, at least one, in double. packed: if not NULL, their triangles, for
 * the batch, which has boxes alone.
 * is_exact: ties may be decided where arithmetic happens to be exact, since integers decide the others as exactly.
 */
typedef tribox_verdict tribox_in_double(tribox_batch *batch, const tribox_packed *packed, unsigned count, unsigned axes,
                                        bool is_exact);

/*
 * Pairs that are fewer than the lanes of a kernel, spread over a packet, as whole packets are read: the numbers after them repeat
 * the first pair. They are never asked about.
 */
struct tribox_partial_packet {
    _Alignas(64) float number[9][TRIBOX_LANES_MAX];
    tribox_soup soup;
    tribox_boxes boxes;
};

/* One triangle or box at least; nothing else is read. */
typedef void tribox_spread_triangles(const tribox_soup *soup, tribox_partial_packet *partial);
typedef void tribox_spread_boxes(const tribox_boxes *boxes, tribox_partial_packet *partial);

/* The candidates among the triangles of a word that lie wholly in the box. Whole packets are read, as by a walk. */
typedef uint64_t tribox_inside(const tribox_soup *soup, const tribox_rounded_box *box, size_t word, uint64_t candidates);

/* The least and the greatest vertex number of triangles first .. first + count - 1 of a mesh, one at least. */
typedef struct tribox_vertices {
    size_t least, greatest;
} tribox_vertices;
typedef tribox_vertices tribox_find_vertices(const tribox_mesh *mesh, size_t first, size_t count);

/*
 * Where the corners of these triangles lie, of one at least. offset: room for three of each. Returns the greatest vertex number: if
 * it is not in the mesh, the rest means nothing. The base is NULL where they cannot be found. The stride is set, here and below.
 */
typedef size_t tribox_find_corners(const tribox_mesh *mesh, size_t first, size_t count, uint32_t *offset, tribox_corners *corners);

/*
 * Triangles first .. first + count - 1, or list[first] .. of a list, none of whose vertices is missing, as nine streams x_0 x_1 x_2
 * y_0 y_1 y_2 z_0 z_1 z_2: of a mesh of doubles near what is given, else as they are. Of a list whole packets may be
 * written, the last of which ends with anything.
 */
typedef void tribox_gather(const tribox_mesh *mesh, const double *origin, const uint32_t *list, size_t first, size_t count,
                           float *const to[9]);

/* A box against positions x y z x y z ...: the bounds of axis k % 3 at place k. */
typedef struct tribox_box_pattern {
    float lo[3 * TRIBOX_LANES_MAX], hi[3 * TRIBOX_LANES_MAX];
    const double *origin; /* of doubles, as of tribox_corners */
} tribox_box_pattern;

/* Whether the box normals separate all triangles of these vertices; false too where finding out costs as much as testing them. */
typedef bool tribox_is_apart(const tribox_mesh *mesh, const tribox_box_pattern *box, tribox_vertices named);

/*
 * Codes of vertices, a byte each: bit a, that it is beyond the lower bound of axis a, bit 3 + a, beyond the upper one, and bit 7,
 * that it is beyond none. NaN is beyond all of them. `count` positions of three numbers that follow each other, in floats and in
 * doubles; the count is a multiple of TRIBOX_CODED.
 */
enum { TRIBOX_CODED = TRIBOX_LANES_MAX, TRIBOX_CODE_INSIDE = 128 };
typedef union tribox_coded_bound {
    float single[3 * TRIBOX_LANES_MAX];
    double wide[3 * TRIBOX_DOUBLES_MAX];
} tribox_coded_bound;
typedef struct tribox_coded_box {
    tribox_coded_bound below, above; /* the numbers beside the bounds, outside: number k is of axis k % 3 */
} tribox_coded_box;
typedef void tribox_code(const void *positions, size_t count, const tribox_coded_box *box, uint8_t *code);

/* Words of triangles in the frame of an oriented box. */
enum { TRIBOX_MOVED_WORDS = 8 };
typedef struct tribox_moved {
    float number[9][64 * TRIBOX_MOVED_WORDS]; /* the streams x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2 */
    uint64_t apart[TRIBOX_MOVED_WORDS];       /* certainly apart from the box on one of its axes */
    uint64_t wild[TRIBOX_MOVED_WORDS];        /* too far away for float, or not finite: the streams mean nothing */
    uint64_t far[TRIBOX_MOVED_WORDS];         /* of the others those that reach beyond `near` of the frame */
    float error[3];                           /* how far off those that are none of these can be on each axis */
} tribox_moved;

/* `count` triangles of a soup, from triangle `first` on, into the frame of the box: a whole packet at least. */
typedef void tribox_to_frame(const tribox_soup *soup, const tribox_rounded_frame *box, size_t first, size_t count,
                             tribox_moved *moved);

/* The halves of a box on each axis, the lower and the upper: its eight children have either of each. */
typedef struct tribox_halves {
    tribox_rounded_box half[2];
} tribox_halves;

/*
 * Answers all triangles of a soup, at least as many as the kernel has lanes, about eight children: bit c of bits[i] is a hit of
 * child c, and bit 8 + c says that it is left undecided, as by a walk. Returns whether anything is. LOCAL: triangles and halves of
 * doubles, less the point that all children share, and rounded (PROOFS.md 14.6).
 */
typedef enum tribox_split_kind {
    TRIBOX_SPLIT_BY_MARGIN,
    TRIBOX_SPLIT_BY_SIGN,
    TRIBOX_SPLIT_LOCAL,
    TRIBOX_SPLIT_BOX,
    TRIBOX_SPLIT_LOCAL_BOX,
    TRIBOX_SPLIT_KINDS
} tribox_split_kind;
typedef bool tribox_split_walk(const tribox_soup *soup, const tribox_halves *halves, int32_t *bits);

/* What is done in double. */
typedef struct tribox_settle_kernel {
    tribox_in_double *in_double;
    tribox_code *code;
} tribox_settle_kernel;

/*
 * Whether a product is rounded before it meets a sum, as it is written: clang makes one operation of them by -ffp-contract=fast,
 * which no macro tells of. Call in the environment of environment.h.
 */
typedef bool tribox_rounds_products(void);

typedef struct tribox_kernel {
    const char *name; /* as in tribox_options.kernel */
    unsigned lanes;   /* triangles in a vector: a divisor of 64 */
    tribox_rounds_products *rounds_products;
    tribox_walk *walk[TRIBOX_WALK_KINDS][TRIBOX_SEQUENCES];
    tribox_walk_few *walk_few[TRIBOX_WALK_KINDS]; /* NULL in a small build */
    tribox_survey *survey[TRIBOX_WALK_KINDS];
    tribox_walk *walk_local[TRIBOX_LOCAL_WALKS];
    tribox_spread_triangles *spread_triangles;
    tribox_spread_boxes *spread_boxes;
    tribox_inside *inside;
    tribox_find_vertices *find_vertices;
    tribox_find_corners *find_corners;
    tribox_gather *gather;
    tribox_is_apart *is_apart;
    tribox_code *code; /* of floats */
    tribox_to_frame *to_frame;
    tribox_split_walk *split[TRIBOX_SPLIT_KINDS];
    tribox_pack *pack;
    const tribox_settle_kernel *settle;
    const tribox_cells_kernel *cells;
    const tribox_rows_kernel *rows;
    const tribox_nodes_kernel *nodes;
} tribox_kernel;

#endif
