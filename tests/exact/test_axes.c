/* test_axes.c - each of the thirteen axes by itself, in every orientation, and the small lattice, on which there is no rounding. */
#include "common/ask.h"

#include <math.h>

#include "common/harness.h"

/* Triangles and boxes, all of which are asked about each other. */
enum { EACH_MAX = 80 };

typedef struct boxes_and_triangles {
    size_t triangles, boxes;
    float u[EACH_MAX][3][3];
    tribox_box box[EACH_MAX];
    bool is_on_lattice[EACH_MAX];          /* of a box: single precision is exact, FAST and CONSERVATIVE must be right */
    oracle_axes truth[EACH_MAX][EACH_MAX]; /* box, triangle */
    float coordinate[3][3][EACH_MAX];      /* the triangles as streams: vertex, axis, triangle */
    float lower[3][EACH_MAX], upper[3][EACH_MAX];
} boxes_and_triangles;

static pair_f64 pair_of(const boxes_and_triangles *c, size_t box, size_t triangle)
{
    return pair_of_floats(c->u[triangle][0], &c->box[box]);
}

static void complete(boxes_and_triangles *c)
{
    for (size_t b = 0; b < c->boxes; b++)
        for (size_t k = 0; k < c->triangles; k++) {
            const pair_f64 pair = pair_of(c, b, k);
            c->truth[b][k] = oracle_separating(&pair);
        }
    for (int a = 0; a < 3; a++) {
        for (size_t k = 0; k < c->triangles; k++)
            for (int j = 0; j < 3; j++)
                c->coordinate[j][a][k] = c->u[k][j][a];
        for (size_t b = 0; b < c->boxes; b++) {
            c->lower[a][b] = (float)c->box[b].lo[a];
            c->upper[a][b] = (float)c->box[b].hi[a];
        }
    }
}

static void check_answer(const boxes_and_triangles *c, const origin *where, size_t box, size_t triangle, bool answer)
{
    const tribox_accuracy accuracy = where->options.accuracy;
    const bool overlaps = oracle_overlaps(c->truth[box][triangle], where->options.axes);
    const bool must_be_right = accuracy == TRIBOX_EXACT || c->is_on_lattice[box];
    if (answer == overlaps || !(must_be_right || (accuracy == TRIBOX_CONSERVATIVE && overlaps)))
        return;
    const pair_f64 pair = pair_of(c, box, triangle);
    fail_pair(where, &pair, answer);
}

static void ask_all_pairs(const boxes_and_triangles *c, origin where)
{
    uint64_t mask[(EACH_MAX + 63) / 64];
    tribox_soup soup = {.count = c->triangles};
    tribox_boxes boxes = {.count = c->boxes};
    for (int k = 0; k < 3; k++) {
        soup.x[k] = c->coordinate[k][0];
        soup.y[k] = c->coordinate[k][1];
        soup.z[k] = c->coordinate[k][2];
        boxes.lo[k] = c->lower[k];
        boxes.hi[k] = c->upper[k];
    }
    where.function = "tribox_overlap";
    for (size_t b = 0; b < c->boxes; b++) {
        ask_soup(&soup, &c->box[b], &where.options, mask);
        for (size_t k = 0; k < c->triangles; k++)
            check_answer(c, &where, b, k, bit_of(mask, k));
    }
    where.function = "tribox_overlap_boxes";
    for (size_t k = 0; k < c->triangles; k++) {
        ask_boxes(c->u[k][0], &boxes, &where.options, mask);
        for (size_t b = 0; b < c->boxes; b++)
            check_answer(c, &where, b, k, bit_of(mask, b));
    }
}

/* Every kernel and accuracy, on all thirteen axes and on a set of them that is drawn, in orders that are drawn. */
static void ask_every_way(const boxes_and_triangles *c, const char *test, random_source *r)
{
    for (int kernel = 0; kernel < kernels; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            origin where = {.scene = test, .seed = args.seed};
            where.options = (tribox_options){.accuracy = (tribox_accuracy)accuracy, .kernel = names[kernel]};
            const unsigned sets[] = {TRIBOX_AXES_ALL, (unsigned)random_int_between(r, 1, AXIS_SETS)};
            for (size_t s = 0; s < sizeof sets / sizeof sets[0]; s++) {
                where.options.axes = sets[s];
                where.options.axis_order = order_digits(random_int(r, ORDERS));
                ask_all_pairs(c, where);
            }
        }
}

/*
 * Thirteen triangles: number k touches this box, and axis k alone shows it. Smaller by one on every side, the box is kept apart
 * from triangle k by axis k alone. No two extents of the box are equal and no centre is zero; no edge of a triangle is parallel to
 * a box axis: a wrong half length, a wrong sign or a swapped component is seen.
 */
static const tribox_box touched_box = {{-1, -2, -4}, {2, 3, 5}};
static const int touching_triangle[ORACLE_AXES][3][3] = {
    {{-1, 1, 0}, {-3, 0, 5}, {-5, -1, 1}},  {{-2, -6, -2}, {0, -2, -1}, {-1, -4, 2}}, {{0, 1, -4}, {-3, 3, -9}, {-2, 0, -7}},
    {{-6, 0, -4}, {-4, 6, -1}, {6, 4, -6}}, {{1, -1, 7}, {-1, -4, 1}, {-3, -8, 2}},   {{4, -7, 0}, {2, -4, 4}, {0, -1, -8}},
    {{-1, 5, 0}, {0, 7, -3}, {1, 2, -6}},   {{0, 0, -6}, {-3, 1, 0}, {-6, 2, -5}},    {{-5, -2, -5}, {0, 1, -6}, {-3, -1, 0}},
    {{1, -1, -6}, {6, 0, -2}, {5, 2, 2}},   {{-3, 2, 1}, {0, -4, 0}, {-4, -2, -1}},   {{-4, -1, -1}, {0, -4, 1}, {-3, 2, -3}},
    {{0, -4, 1}, {-4, -2, 0}, {-3, 2, -3}},
};

/* A mirroring, a permutation of the axes and a shift, in this order: old axis a becomes axis to[a]. */
typedef struct frame {
    int sign[3], shift[3];
    const int *to;
} frame;

static float in_frame(const frame *f, int a, float number) { return (float)f->sign[a] * number + (float)f->shift[a]; }

static tribox_box box_in_frame(const frame *f, const tribox_box *box)
{
    tribox_box moved;
    for (int a = 0; a < 3; a++) {
        const float p = in_frame(f, a, (float)box->lo[a]), q = in_frame(f, a, (float)box->hi[a]);
        moved.lo[f->to[a]] = p < q ? p : q;
        moved.hi[f->to[a]] = p < q ? q : p;
    }
    return moved;
}

/* The number of axis k in a frame, with vertex order[v] of the triangle in place v. */
static int axis_in_frame(const frame *f, const int order[3], int k)
{
    if (k < ORACLE_PLANE)
        return f->to[k];
    if (k == ORACLE_PLANE)
        return k;
    const int i = (k - ORACLE_EDGES) / 3, j = (k - ORACLE_EDGES) % 3;
    int opposite = 0; /* the new place of the vertex opposite to edge j */
    while (order[opposite] != (j + 2) % 3)
        opposite++;
    return ORACLE_EDGES + 3 * f->to[i] + (opposite + 1) % 3;
}

enum { SMALLER, ULP_SMALLER, TOUCHED, ULP_LARGER, LARGER, BOX_SIZES };

static tribox_box resized(const tribox_box *box, int size)
{
    tribox_box other = *box;
    for (int a = 0; a < 3; a++) {
        if (size == SMALLER || size == LARGER) {
            other.lo[a] += size == SMALLER ? 1.0f : -1.0f;
            other.hi[a] -= size == SMALLER ? 1.0f : -1.0f;
        } else if (size != TOUCHED) {
            other.lo[a] = nextafterf((float)box->lo[a], size == ULP_SMALLER ? INFINITY : -INFINITY);
            other.hi[a] = nextafterf((float)box->hi[a], size == ULP_SMALLER ? -INFINITY : INFINITY);
        }
    }
    return other;
}

static void check_that_it_alone_decides(int axis, const oracle_axes truth[BOX_SIZES])
{
    const unsigned alone = 1u << axis;
    assert_int_equal(truth[SMALLER].apart, alone);
    assert_int_equal(truth[ULP_SMALLER].apart, alone);
    assert_int_equal(truth[TOUCHED].apart, 0);
    assert_int_equal(truth[TOUCHED].touching, alone);
    assert_int_equal(truth[ULP_LARGER].apart | truth[ULP_LARGER].touching, 0);
    assert_int_equal(truth[LARGER].apart | truth[LARGER].touching, 0);
}

/* The thirteen triangles in a frame, each with its vertices in all six orders, and the box in five sizes. */
static void make_thirteen(const frame *f, boxes_and_triangles *c)
{
    const tribox_box box = box_in_frame(f, &touched_box);
    c->boxes = BOX_SIZES;
    for (int size = 0; size < BOX_SIZES; size++) {
        c->box[size] = resized(&box, size);
        c->is_on_lattice[size] = size != ULP_SMALLER && size != ULP_LARGER;
    }
    c->triangles = 0;
    for (int k = 0; k < ORACLE_AXES; k++)
        for (int order = 0; order < ORDERS; order++, c->triangles++)
            for (int v = 0; v < 3; v++)
                for (int a = 0; a < 3; a++)
                    c->u[c->triangles][v][f->to[a]] = in_frame(f, a, (float)touching_triangle[k][permutations[order][v]][a]);
    complete(c);
    for (size_t t = 0; t < c->triangles; t++) {
        oracle_axes truth[BOX_SIZES];
        for (int size = 0; size < BOX_SIZES; size++)
            truth[size] = c->truth[size][t];
        check_that_it_alone_decides(axis_in_frame(f, permutations[t % ORDERS], (int)t / ORDERS), truth);
    }
}

CASE(test_thirteen_axes)
{
    random_source r = random_named(args.seed, "thirteen axes");
    static boxes_and_triangles c;
    for (int mirror = 0; mirror < 8; mirror++)
        for (int axes = 0; axes < ORDERS; axes++)
            for (int is_shifted = 0; is_shifted < 2; is_shifted++) {
                frame f = {.to = permutations[axes], .shift = {is_shifted * 3, is_shifted * -5, is_shifted * 2}};
                for (int a = 0; a < 3; a++)
                    f.sign[a] = mirror >> a & 1 ? -1 : 1;
                make_thirteen(&f, &c);
                ask_every_way(&c, "thirteen axes", &r);
            }
}

/* A triangle across each corner of a box, whose plane cuts the corner off, touches it or misses it. */
CASE(test_corner_cuts)
{
    random_source r = random_named(args.seed, "corner cuts");
    static const int half[3] = {2, 4, 6}, centre[3] = {1, -3, 2};
    static boxes_and_triangles c;
    c.boxes = 1;
    c.is_on_lattice[0] = true;
    for (int a = 0; a < 3; a++) {
        c.box[0].lo[a] = (float)(centre[a] - half[a]);
        c.box[0].hi[a] = (float)(centre[a] + half[a]);
    }
    /* x / half[0] + y / half[1] + z / half[2] is 3 at the corner, and twice that here. */
    c.triangles = 0;
    for (int corner = 0; corner < 8; corner++)
        for (int twice = 5; twice <= 7; twice++, c.triangles++)
            for (int j = 0; j < 3; j++)
                for (int a = 0; a < 3; a++) {
                    const int sign = corner >> a & 1 ? -1 : 1;
                    c.u[c.triangles][j][a] = (float)(centre[a] + (a == j ? sign * half[a] * twice / 2 : 0));
                }
    complete(&c);
    for (size_t k = 0; k < c.triangles; k++) {
        const unsigned plane = 1u << ORACLE_PLANE;
        assert_int_equal(c.truth[0][k].apart, k % 3 == 2 ? plane : 0);
        assert_int_equal(c.truth[0][k].touching & plane, k % 3 == 1 ? plane : 0);
    }
    for (int times = 0; times < AXIS_SETS * ORDERS; times++)
        ask_every_way(&c, "corner cuts", &r);
}

/* Triangles and boxes of small whole numbers, flat and degenerate ones among them. */
static void draw_lattice(random_source *r, boxes_and_triangles *c)
{
    c->triangles = c->boxes = 70; /* a word and a tail */
    for (int a = 0; a < 3; a++) {
        for (size_t k = 0; k < c->triangles; k++)
            for (int j = 0; j < 3; j++)
                c->u[k][j][a] = random_sign_of_zero(r, (float)random_int_between(r, -4, 4));
        for (size_t b = 0; b < c->boxes; b++) {
            const int lo = random_int_between(r, -4, 3);
            c->box[b].lo[a] = random_sign_of_zero(r, (float)lo);
            c->box[b].hi[a] = random_sign_of_zero(r, (float)(lo + random_int_between(r, 0, 4)));
            c->is_on_lattice[b] = true;
        }
    }
    complete(c);
}

CASE(test_lattice)
{
    random_source r = random_named(args.seed, "lattice");
    static boxes_and_triangles c;
    /* By default 2^20 pairs. */
    for (size_t pairs = 0; pairs < 10 * args.pairs; pairs += c.triangles * c.boxes) {
        draw_lattice(&r, &c);
        ask_every_way(&c, "lattice", &r);
    }
}

PROGRAM(RUN(test_thirteen_axes), RUN(test_corner_cuts), RUN(test_lattice))
