/*
 * test_rounded_boxes.c - boxes of doubles about triangles of floats: bounds between floats, halfway, one double beside one, in one
 * gap, beyond the floats and below them. Every form of call, set of axes, order and kernel against the oracle (PROOFS.md 3.9).
 *
 * EXACT is its answer, and what lies inside is exact at every accuracy; CONSERVATIVE never misses; both others differ from it only
 * where some axis is within rounding of contact.
 */
#include <float.h>
#include <math.h>

#include "base/rounded_box.h"
#include "common/ask.h"
#include "common/contact.h"
#include "common/harness.h"

/* Triangles beside one box, calls about them, and pairs of --pairs that a box takes. */
enum { TRIANGLES = 96, WORDS = 2, CALLS = 6, PAIRS_EACH = 2 };

typedef struct beside_box {
    tribox_box box;
    float stream[9][TRIANGLES], nine[TRIANGLES][3][3];
    oracle_axes truth[TRIANGLES];
} beside_box;

static pair_f64 pair_at(const beside_box *b, int i)
{
    pair_f64 pair = {.box = b->box};
    for (int k = 0; k < 9; k++)
        pair.u[k % 3][k / 3] = (double)b->stream[k][i];
    return pair;
}

/* Where all numbers of a case come from. */
typedef enum range { UNIT, FEW, FAR_OUT, SUBNORMAL, TINY, LARGE, GREATEST, ANY_SIZE, RANGES } range;

static float drawn(random_source *r, range from)
{
    static const int exponents[RANGES][2] = {
        [UNIT] = {-1, 0}, [TINY] = {-140, -110}, [LARGE] = {35, 41}, [GREATEST] = {126, 127}, [ANY_SIZE] = {-148, 127}};
    if (from == FEW)
        return (float)random_int_between(r, -2, 2);
    if (from == FAR_OUT)
        return 0x1p20f + 0.125f * (float)random_int(r, 5);
    if (from == SUBNORMAL)
        return (float)random_int_between(r, -8, 8) * 0x1p-149f;
    const int exponent = random_int_between(r, exponents[from][0], exponents[from][1]);
    return nearest_float(ldexp(random_double(r, 1, 2), exponent) * (random_int(r, 2) ? 1 : -1));
}

/* A number that is no float more often than not. */
static double widened(random_source *r, float number)
{
    const double up = (double)nextafterf(number, FLT_MAX), down = (double)nextafterf(number, -FLT_MAX), at = (double)number;
    switch (random_int(r, 10)) {
    case 0:
        return nextafter(at, DBL_MAX);
    case 1:
        return nextafter(at, -DBL_MAX);
    case 2:
        return (at + up) / 2;
    case 3:
        return (at + down) / 2;
    case 4:
        return nextafter((at + up) / 2, random_int(r, 2) ? DBL_MAX : -DBL_MAX);
    case 5:
        return random_double(r, at, up);
    case 6:
        return random_double(r, down, at);
    default:
        return at;
    }
}

/* Beyond the floats, or below them. */
static double beyond(random_source *r)
{
    static const double sizes[] = {DBL_MAX,  1e300,      0x1p200,    0x1p128,  0x1.fffffffp127, FLT_MAX,  DBL_MIN, 0x1p-1074,
                                   0x1p-150, 0x1.8p-150, 0x1.8p-149, 0x1p-149, 0x1p-127,        0x1p-200, 0};
    return sizes[random_int(r, (int)(sizeof sizes / sizeof *sizes))] * (random_int(r, 2) ? 1 : -1);
}

static void draw_box(random_source *r, tribox_box *box, range from)
{
    const bool is_tight = random_int(r, 2), is_flat = random_int(r, 3) == 0, goes_beyond = random_int(r, 4) == 0;
    for (int a = 0; a < 3; a++) {
        const float p = drawn(r, from), q = is_tight || random_int(r, 3) == 0 ? nudged(r, p, is_tight ? 6 : 2) : drawn(r, from);
        const double x = goes_beyond && random_int(r, 3) == 0 ? beyond(r) : widened(r, p);
        const double y = goes_beyond && random_int(r, 3) == 0 ? beyond(r) : is_flat && random_int(r, 2) ? x : widened(r, q);
        const bool is_empty = random_int(r, 100) == 0;
        box->lo[a] = is_empty ? fmax(x, y) : fmin(x, y);
        box->hi[a] = is_empty ? fmin(x, y) : fmax(x, y);
    }
}

static float draw_coordinate(random_source *r, const beside_box *b, int a, int j, int i, range from)
{
    const float bound = nearest_float(random_int(r, 2) ? b->box.lo[a] : b->box.hi[a]), first = b->stream[3 * a][i];
    switch (random_int(r, 6)) {
    case 0:
        return drawn(r, from);
    case 1:
        return j ? first : bound;
    case 2:
        return j ? nudged(r, first, 4) : nudged(r, bound, 40);
    case 3:
        return nudged(r, bound, 8);
    default:
        return nudged(r, bound, 2);
    }
}

static void draw_case(random_source *r, beside_box *b)
{
    const range from = (range)random_int(r, RANGES);
    draw_box(r, &b->box, from);
    for (int i = 0; i < TRIANGLES; i++) {
        for (int k = 0; k < 9; k++)
            b->stream[k][i] = draw_coordinate(r, b, k / 3, k % 3, i, from);
        if (random_int(r, 200) == 0)
            b->stream[random_int(r, 9)][i] = random_int(r, 2) ? INFINITY : NAN;
        for (int k = 0; k < 9; k++)
            b->nine[i][k % 3][k / 3] = b->stream[k][i];
        const pair_f64 pair = pair_at(b, i);
        b->truth[i] = pair_f64_is_finite(&pair) ? oracle_separating(&pair) : (oracle_axes){0, 0};
    }
}

/* Whether triangle and box end within rounding of each other along w (TRIBOX_CONSERVATIVE), from vertex 0. */
static bool is_within(const pair_f64 *p, const double w[3], double bound)
{
    double least = 0, most = 0, first = 0, last = 0;
    for (int j = 1; j < 3; j++) {
        double at = 0;
        for (int a = 0; a < 3; a++)
            at += w[a] * (p->u[j][a] - p->u[0][a]);
        first = fmin(first, at);
        last = fmax(last, at);
    }
    for (int a = 0; a < 3; a++) {
        const double x = w[a] * (p->box.lo[a] - p->u[0][a]), y = w[a] * (p->box.hi[a] - p->u[0][a]);
        least += fmin(x, y);
        most += fmax(x, y);
    }
    return !(fabs(fmin(most - first, last - least)) > 0x1p-19 * bound + 0x1p-64);
}

/* Whether some edge axis or the plane of the groups is that close: sizes as in tribox_accuracy. */
static bool is_near(const pair_f64 *p, unsigned groups)
{
    double F[3], m[3], f[3][3], n[3], S = 0;
    bool is = false;
    for (int a = 0; a < 3; a++) {
        const double least = fmin(fmin(p->u[0][a], p->u[1][a]), p->u[2][a]), most = fmax(fmax(p->u[0][a], p->u[1][a]), p->u[2][a]);
        F[a] = most - least;
        m[a] = fmax(most - p->box.lo[a], p->box.hi[a] - least);
        for (int j = 0; j < 3; j++)
            f[j][a] = p->u[(j + 1) % 3][a] - p->u[j][a];
    }
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        n[i] = f[0][a] * f[1][b] - f[0][b] * f[1][a];
        S += F[a] * F[b] * m[i];
        for (int j = 0; groups & TRIBOX_AXES_EDGES && j < 3; j++) {
            double w[3] = {0, 0, 0};
            w[a] = -f[j][b];
            w[b] = f[j][a];
            is |= is_within(p, w, F[a] * m[b] + F[b] * m[a]);
        }
    }
    return is || (groups & TRIBOX_AXES_PLANE && is_within(p, n, S));
}

/* FAST is promised of these alone. */
static bool is_moderate(const pair_f64 *p)
{
    bool is = true;
    for (int k = 0; k < 15; k++)
        is = is && fabs(pair_f64_number(p, k)) <= 0x1p40;
    return is;
}

static bool is_inside(const pair_f64 *p)
{
    bool is = pair_f64_is_finite(p);
    for (int k = 0; k < 9; k++)
        is = is && p->u[k / 3][k % 3] >= p->box.lo[k % 3] && p->u[k / 3][k % 3] <= p->box.hi[k % 3];
    return is;
}

static void check(const beside_box *b, int i, const tribox_options *o, bool hit, const bool *inside)
{
    const pair_f64 pair = pair_at(b, i);
    const unsigned groups = o->axes ? o->axes : TRIBOX_AXES_ALL;
    const bool overlaps = oracle_pair_overlaps(&pair, b->truth[i], groups);
    bool is_right = hit == overlaps;
    if (!is_right && o->accuracy == TRIBOX_CONSERVATIVE)
        is_right = hit && pair_f64_is_finite(&pair) && is_near(&pair, groups);
    if (!is_right && o->accuracy == TRIBOX_FAST)
        is_right = !is_moderate(&pair) || is_near(&pair, groups);
    if (is_right && (!inside || *inside == is_inside(&pair)))
        return;
    oracle_explain(stderr, &pair);
    fail_msg("seed %llu, accuracy %d, axes %u, order %u, %s: '%s'%s", (unsigned long long)args.seed, o->accuracy, groups,
             o->axis_order, o->kernel, hit ? "overlaps" : "does not overlap", inside ? *inside ? ", inside" : ", not inside" : "");
}

static void ask(random_source *r, const beside_box *b, const char *kernel)
{
    const float *const s[9] = {b->stream[0], b->stream[1], b->stream[2], b->stream[3], b->stream[4],
                               b->stream[5], b->stream[6], b->stream[7], b->stream[8]};
    const tribox_soup soup = {.x = {s[0], s[1], s[2]}, .y = {s[3], s[4], s[5]}, .z = {s[6], s[7], s[8]}, .count = TRIANGLES};
    const tribox_mesh mesh = {.positions = b->nine, .vertices = 3 * TRIANGLES, .count = TRIANGLES};
    const tribox_options o = {.accuracy = (tribox_accuracy)random_int(r, 3),
                              .axes = (unsigned)random_int(r, AXIS_SETS + 1),
                              .axis_order = order_digits(random_int(r, ORDERS)),
                              .kernel = kernel};
    const bool is_mesh = random_int(r, 2), is_classified = random_int(r, 2);
    uint64_t mask[WORDS], inside[WORDS];
    tribox_status status;
    if (is_classified)
        status = is_mesh ? tribox_mesh_classify(&mesh, &b->box, &o, mask, inside, NULL)
                         : tribox_classify(&soup, &b->box, &o, mask, inside, NULL);
    else
        status = is_mesh ? tribox_mesh_overlap(&mesh, &b->box, &o, mask, NULL) : tribox_overlap(&soup, &b->box, &o, mask, NULL);
    assert_int_equal(status, TRIBOX_OK);
    for (int i = 0; i < TRIANGLES; i++) {
        const bool lies_inside = is_classified && bit_of(inside, (size_t)i);
        check(b, i, &o, bit_of(mask, (size_t)i), is_classified ? &lies_inside : NULL);
    }
}

/* The origin (PROOFS.md 3.9). For FAST, C says where the middle is, as far as floats can, and H is longer by one float or none. */
static void check_floats_of(const tribox_box *box, bool is_box_asked)
{
    tribox_rounded_box rounded;
    tribox_box_round(box, is_box_asked, true, &rounded);
    for (int a = 0; a < 3; a++) {
        const double lo = box->lo[a], hi = box->hi[a], middle = (double)rounded.fast.origin[a], least = (double)rounded.of.H[a];
        const float H = rounded.fast.H[a], nearest = nearest_float(lo);
        const bool is_moved = rounded.fast.origin[a] != rounded.of.origin[a];
        assert_true(rounded.of.origin[a] == (is_box_asked && (double)nearest < lo ? nextafterf(nearest, INFINITY) : nearest));
        assert_true(!is_moved ||
                    (fabs(middle - (lo + hi) / 2) <= 0x1p-24 * fabs(middle) + 0x1p-150 &&
                     (double)nearest_float(hi - middle) == hi - middle && (double)nearest_float(lo - middle) == lo - middle));
        assert_true(!is_moved || rounded.fast.C[a] == nearest_float((hi - middle) + (lo - middle)));
        assert_true((double)H >= least && H <= nextafterf(rounded.of.H[a], INFINITY));
        assert_true(!(least >= FLT_MIN) || (double)H >= least * (1 + 0x1p-24) * (1 - 0x1p-24));
    }
}

CASE(test_boxes_of_doubles)
{
    random_source r = random_named(args.seed, "rounded boxes");
    for (size_t pairs = 0; pairs < (size_t)args.pairs * PAIRS_EACH; pairs += TRIANGLES) {
        beside_box b;
        draw_case(&r, &b);
        if (fabs(b.box.lo[0]) + fabs(b.box.lo[1]) + fabs(b.box.lo[2]) + fabs(b.box.hi[0]) + fabs(b.box.hi[1]) + fabs(b.box.hi[2]) <=
            0x1p40)
            check_floats_of(&b.box, pairs / TRIANGLES % 2);
        for (int k = 0; k < CALLS; k++)
            ask(&r, &b, names[random_int(&r, kernels)]);
    }
}

PROGRAM(RUN(test_boxes_of_doubles))
