/*
 * test_integers.c - the last stages on pairs of doubles: the integers in each of their forms, and whole batches on every kernel,
 * against thirteen two-sided axes in GMP.
 */
#include "common/ask.h"

#include <float.h>
#include <math.h>

#include "common/harness.h"
#include "dispatch.h"
#include "exact/exact.h"
#include "pairs/settle.h"

/* exact_short.c as it is where the compiler has no integers of 128 bits. */
bool tribox_exact_short_in_words(const tribox_short_pair *pair, unsigned axes);

/* Few bits, so that what is added up from several of them is exact. */
static double small(random_source *r) { return random_int_between(r, -512, 512) * 0x1p-8; }

static void draw_box(random_source *r, pair_f64 *p)
{
    for (int a = 0; a < 3; a++) {
        const double x = small(r), y = small(r);
        p->box.lo[a] = fmin(x, y);
        p->box.hi[a] = fmax(x, y);
    }
}

static void draw_triangle(random_source *r, pair_f64 *p)
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p->u[j][a] = small(r);
}

static double corner(random_source *r, const pair_f64 *p, int a) { return random_int(r, 2) ? p->box.lo[a] : p->box.hi[a]; }

/* Edge 0 goes through a point of the box's edge along some axis. */
static void draw_touching_edge(random_source *r, pair_f64 *p)
{
    const int along = random_int(r, 3), times = random_int_between(r, 1, 4);
    draw_box(r, p);
    draw_triangle(r, p);
    for (int a = 0; a < 3; a++) {
        const double middle = (p->box.lo[a] + p->box.hi[a]) / 2, c = a == along ? middle : corner(r, p, a), e = small(r);
        p->u[0][a] = c + e;
        p->u[1][a] = c - times * e;
    }
}

/* The plane goes through a corner. */
static void draw_touching_plane(random_source *r, pair_f64 *p)
{
    const int s = random_int_between(r, -3, 3), t = random_int_between(r, -3, 3);
    draw_box(r, p);
    for (int a = 0; a < 3; a++) {
        const double c = corner(r, p, a), e = small(r), f = small(r);
        p->u[0][a] = c + e;
        p->u[1][a] = c + f;
        p->u[2][a] = c + s * e + t * f;
    }
}

static void draw_tenths(random_source *r, pair_f64 *p)
{
    for (int a = 0; a < 3; a++) {
        const int at = random_int_between(r, -5, 5);
        p->box.lo[a] = at / 10.0;
        p->box.hi[a] = (at + random_int_between(r, 0, 9)) / 10.0;
        for (int j = 0; j < 3; j++)
            p->u[j][a] = random_int_between(r, -12, 12) / 10.0;
    }
}

/* As touching, with all 53 bits: rounded, so on either side. */
static void draw_near_tie(random_source *r, pair_f64 *p)
{
    const double s = random_double(r, -2, 2), t = random_double(r, -2, 2);
    const bool is_plane = random_int(r, 2);
    for (int a = 0; a < 3; a++) {
        const double x = random_double(r, -1, 1), y = random_double(r, -1, 1), e = random_double(r, -1, 1),
                     f = random_double(r, -1, 1);
        p->box.lo[a] = fmin(x, y);
        p->box.hi[a] = fmax(x, y);
        const double c = corner(r, p, a);
        p->u[0][a] = c + e;
        p->u[1][a] = is_plane ? c + f : c - fabs(s) * e;
        p->u[2][a] = is_plane ? c + s * e + t * f : random_double(r, -2, 2);
    }
}

/* The numbers of an axis as long as the short form takes, and somewhat longer: the largest near a power of two, and odd ones. */
static void draw_long_numbers(random_source *r, pair_f64 *p)
{
    for (int a = 0; a < 3; a++) {
        double number[5];
        const int bits = random_int_between(r, 57, 62);
        for (int k = 0; k < 5; k++) {
            const int64_t odd = (int64_t)(random_bits(r) >> 12) | 1;
            const double sign = random_int(r, 2) ? 1 : -1;
            number[k] = sign * (random_int(r, 3) ? ldexp(1, bits) - ldexp(random_int(r, 9), bits - 53) : (double)odd);
        }
        p->box.lo[a] = fmin(number[3], number[4]);
        p->box.hi[a] = fmax(number[3], number[4]);
        for (int j = 0; j < 3; j++)
            p->u[j][a] = number[j];
        if (random_int(r, 2)) /* a vertex above a corner */
            p->u[random_int(r, 3)][a] = number[3];
    }
}

/* Small integers about a corner of a box that is as large as short numbers can be: what is near a tie is near it by a few units. */
static void draw_vast_box(random_source *r, pair_f64 *p)
{
    for (int a = 0; a < 3; a++) {
        const int at = random_int_between(r, -4, 4);
        const bool is_above = random_int(r, 2);
        p->box.lo[a] = is_above ? at : -0x1p59;
        p->box.hi[a] = is_above ? 0x1p59 : at;
        for (int j = 0; j < 3; j++)
            p->u[j][a] = at + random_int_between(r, -5, 5);
    }
}

/* A triangle so small, beside a corner, that the products of its normal underflow. */
static void draw_vanishing(random_source *r, pair_f64 *p)
{
    const int power = random_int_between(r, 530, 560);
    for (int a = 0; a < 3; a++) {
        const bool is_above = random_int(r, 2);
        p->box.lo[a] = is_above ? 0 : -1;
        p->box.hi[a] = is_above ? 1 : 0;
        for (int j = 0; j < 3; j++)
            p->u[j][a] = ldexp(random_double(r, -1, 0.4) * (is_above ? 1 : -1), -power);
    }
}

/* Ordinary numbers beside what rounding leaves where zero is meant. */
static void draw_noise(random_source *r, pair_f64 *p)
{
    if (random_int(r, 2))
        draw_touching_edge(r, p);
    else
        draw_near_tie(r, p);
    for (int n = random_int_between(r, 1, 5); n; n--)
        p->u[random_int(r, 3)][random_int(r, 3)] = ldexp(random_double(r, -1, 1), -random_int_between(r, 50, 180));
}

static void draw_any_exponents(random_source *r, pair_f64 *p)
{
    for (int a = 0; a < 3; a++) {
        double number[5];
        for (int k = 0; k < 5; k++)
            number[k] = ldexp(random_double(r, -2, 2), random_int_between(r, -1080, 1022));
        p->box.lo[a] = fmin(number[3], number[4]);
        p->box.hi[a] = fmax(number[3], number[4]);
        for (int j = 0; j < 3; j++)
            p->u[j][a] = random_int(r, 3) ? number[j] : number[3];
    }
}

typedef struct pair_scene {
    const char *name;
    void (*draw)(random_source *r, pair_f64 *p);
    int least_power, most_power; /* what every axis may be scaled by */
} pair_scene;

static const pair_scene scenes[] = {
    {"tenths", draw_tenths, 0, 0},
    {"touching_edge", draw_touching_edge, -190, 190},
    {"touching_plane", draw_touching_plane, -190, 190},
    {"touching_subnormal", draw_touching_edge, -1066, -1060},
    {"touching_huge", draw_touching_plane, 1017, 1017},
    {"touching_far_apart", draw_touching_plane, -1066, 1017},
    {"near_tie", draw_near_tie, -150, 150},
    {"near_tie_far_apart", draw_near_tie, -1000, 1000},
    {"long_numbers", draw_long_numbers, -100, 100},
    {"vast_box", draw_vast_box, -100, 100},
    {"vanishing", draw_vanishing, 0, 0},
    {"noise", draw_noise, -10, 10},
    {"any_exponents", draw_any_exponents, 0, 0},
};

/* Kinds of degenerate pairs: a point, a segment, equal vertices, a flat box. */
static void degenerate(random_source *r, pair_f64 *p)
{
    const int kind = random_int(r, 12), a = random_int(r, 3);
    if (kind == 0)
        p->box.hi[a] = p->box.lo[a];
    for (int b = 0; b < 3; b++) {
        if (kind == 1)
            p->u[2][b] = p->u[1][b] = p->u[0][b];
        if (kind == 2)
            p->u[2][b] = p->u[1][b];
        if (kind == 3 && b != a)
            p->u[1][b] = p->u[2][b] = p->u[0][b];
        if (kind == 4)
            p->u[b][a] = p->box.hi[a];
    }
}

/* Every axis in a unit of its own, a few numbers a bit off, and vertices and axes in any order. */
static void draw(const pair_scene *s, random_source *r, pair_f64 *to)
{
    pair_f64 p;
    s->draw(r, &p);
    degenerate(r, &p);
    const int *const vertex = permutations[random_int(r, ORDERS)], *const axis = permutations[random_int(r, ORDERS)];
    for (int a = 0; a < 3; a++) {
        const int power = random_int_between(r, s->least_power, s->most_power);
        for (int j = 0; j < 3; j++)
            to->u[vertex[j]][axis[a]] = ldexp(p.u[j][a], power);
        to->box.lo[axis[a]] = ldexp(p.box.lo[a], power);
        to->box.hi[axis[a]] = ldexp(p.box.hi[a], power);
    }
    if (!random_int(r, 3)) {
        double *const number = &to->u[random_int(r, 3)][random_int(r, 3)];
        *number = nextafter(*number, random_int(r, 2) ? DBL_MAX : -DBL_MAX);
    }
}

typedef struct counts {
    size_t short_pairs, long_pairs, overlapping;
} counts;

static void check(origin *where, const char *function, const pair_f64 *p, unsigned axes, bool answer, bool expected)
{
    where->function = function;
    where->options.axes = axes;
    if (answer != expected)
        fail_pair(where, p, answer);
}

static void check_integers(origin *where, const pair_f64 *p, oracle_axes truth, counts *count)
{
    tribox_pair pair;
    tribox_short_pair counted;
    memcpy(pair.u, p->u, sizeof pair.u);
    memcpy(pair.lo, p->box.lo, sizeof pair.lo);
    memcpy(pair.hi, p->box.hi, sizeof pair.hi);
    const bool is_short = tribox_short_pair_of(&pair, &counted);
    count->short_pairs += is_short;
    count->long_pairs += !is_short;
    for (unsigned axes = 1; axes <= AXIS_SETS; axes++) {
        const bool overlaps = oracle_overlaps(truth, axes);
        if ((axes & TRIBOX_AXES_BOX) && !oracle_overlaps(truth, TRIBOX_AXES_BOX))
            continue;
        count->overlapping += overlaps;
        check(where, "tribox_exact_overlap", p, axes, tribox_exact_overlap(&pair, axes), overlaps);
        if (is_short) {
            check(where, "tribox_exact_long", p, axes, tribox_exact_long(&pair, axes), overlaps);
            check(where, "tribox_exact_short without 128 bits", p, axes, tribox_exact_short_in_words(&counted, axes), overlaps);
        }
    }
}

/* Pairs that a batch may hold, some of them not finite. */
typedef struct gathered {
    tribox_batch batch;
    pair_f64 pair[TRIBOX_BATCH];
    oracle_axes truth[TRIBOX_BATCH];
    unsigned count;
} gathered;

static void gather(gathered *g, random_source *r, const pair_f64 *p, oracle_axes truth)
{
    const unsigned i = g->count++;
    g->pair[i] = *p;
    g->truth[i] = truth;
    if (!random_int(r, 20))
        g->pair[i].u[random_int(r, 3)][random_int(r, 3)] = random_int(r, 2) ? (double)NAN : random_int(r, 2) ? HUGE_VAL : -HUGE_VAL;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            g->batch.number[3 * a + j][i] = g->pair[i].u[j][a];
        g->batch.number[9 + a][i] = p->box.lo[a];
        g->batch.number[12 + a][i] = p->box.hi[a];
    }
}

static void check_batch(origin *where, gathered *g, unsigned axes)
{
    where->options.axes = axes;
    tribox_plan plan;
    assert_int_equal(tribox_plan_make(&where->options, &plan), TRIBOX_OK);
    const tribox_verdict verdict = tribox_settle_batch(&g->batch, g->count, &plan);
    assert_true(!verdict.undecided);
    for (unsigned i = 0; i < g->count; i++) {
        const bool answer = verdict.overlapping >> i & 1, is_finite = pair_f64_is_finite(&g->pair[i]);
        const bool overlaps = is_finite && oracle_overlaps(g->truth[i], axes);
        const bool may_be_wrong = where->options.accuracy == TRIBOX_CONSERVATIVE && !overlaps && is_finite;
        if ((answer != overlaps && !may_be_wrong) || (verdict.finite >> i & 1) != is_finite)
            check(where, "tribox_settle_batch", &g->pair[i], axes, answer, !answer);
    }
}

static void settle(origin *where, gathered *g, unsigned axes)
{
    for (size_t k = 0; k < tribox_kernel_count(); k++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST && tribox_kernel_runs_here(k); accuracy++) {
            where->options = (tribox_options){.kernel = tribox_kernel_at(k)->name, .accuracy = (tribox_accuracy)accuracy};
            check_batch(where, g, axes);
        }
    where->options = (tribox_options){.kernel = NULL};
    g->count = 0;
}

static void try_scene(const pair_scene *s)
{
    static gathered with_box, without_box; /* the box normals separate no pair of the first */
    origin where = {.scene = s->name, .seed = args.seed};
    random_source r = random_named(args.seed, s->name);
    counts count = {0, 0, 0};
    with_box.count = without_box.count = 0;
    for (size_t k = args.pairs / 100; k; k--) {
        pair_f64 p;
        draw(s, &r, &p);
        const oracle_axes truth = oracle_separating(&p);
        check_integers(&where, &p, truth, &count);
        if (oracle_overlaps(truth, TRIBOX_AXES_BOX))
            gather(&with_box, &r, &p, truth);
        gather(&without_box, &r, &p, truth);
        if (with_box.count == TRIBOX_BATCH || (k == 1 && with_box.count))
            settle(&where, &with_box, TRIBOX_AXES_BOX | (random_int(&r, 2) ? TRIBOX_AXES_EDGES : (unsigned)random_int(&r, 8)));
        if (without_box.count == TRIBOX_BATCH || k == 1)
            settle(&where, &without_box, random_int(&r, 2) ? TRIBOX_AXES_PLANE : TRIBOX_AXES_EDGES);
    }
    printf("%-18s %zu short, %zu long, %zu answers of overlap\n", s->name, count.short_pairs, count.long_pairs, count.overlapping);
}

CASE(test_scenes)
{
    for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++)
        if (!args.scenes || !strcmp(args.scenes, scenes[k].name))
            try_scene(&scenes[k]);
}

PROGRAM(RUN(test_scenes))
