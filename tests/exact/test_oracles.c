/* test_oracles.c - the two oracles agree, and every slow stage of the exact test agrees with them where it applies. */
#include "common/ask.h"

#include "common/harness.h"
#include "common/scenes.h"
#include "dispatch.h"
#include "exact/exact.h"
#include "exact/oriented/oriented.h"

/* How often each stage was asked: a stage that was never asked was not tested. */
typedef struct reached {
    size_t double_certain, double_undecided, short_pairs, long_pairs;
} reached;

static void check(const origin *where, const char *function, const pair_f64 *pair, unsigned axes, bool answer, bool truth)
{
    if (answer == truth)
        return;
    origin here = *where;
    here.function = function;
    here.options = (tribox_options){.axes = axes, .kernel = "none"};
    fail_pair(&here, pair, answer);
}

static void check_oracles(const origin *where, const pair_f64 *pair, oracle_axes truth, bool is_gmp_due)
{
    check(where, "oracle_clip", pair, TRIBOX_AXES_ALL, oracle_clip(pair), oracle_overlaps(truth, TRIBOX_AXES_ALL));
    if (!is_gmp_due)
        return;
    const oracle_axes slow = oracle_separating_gmp(pair);
    if (slow.apart != truth.apart || slow.touching != truth.touching)
        fail_pair(where, pair, !truth.apart);
}

/* A batch as the oracle sees it. */
typedef struct judged_batch {
    scene_batch batch;
    oracle_axes truth[SCENE_TRIANGLES];
} judged_batch;

/* Pairs of a batch gathered for the settling stage: pair i is triangle[i] of the batch. */
typedef struct gathered_pairs {
    tribox_batch pairs;
    int triangle[TRIBOX_BATCH];
    unsigned count;
} gathered_pairs;

static void gather(gathered_pairs *g, const pair_f64 *pair, int triangle)
{
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            g->pairs.number[3 * a + j][g->count] = pair->u[j][a];
        g->pairs.number[9 + a][g->count] = pair->box.lo[a];
        g->pairs.number[12 + a][g->count] = pair->box.hi[a];
    }
    g->triangle[g->count++] = triangle;
}

/* What a kernel settles is right; what it leaves open it does not report. */
static void check_settled(const origin *where, const judged_batch *judged, gathered_pairs *g, const tribox_kernel *kernel,
                          unsigned axes, reached *count)
{
    origin here = *where;
    here.function = "in_double";
    here.options = (tribox_options){.axes = axes, .kernel = kernel->name};
    const tribox_verdict verdict = kernel->settle->in_double(&g->pairs, NULL, g->count, axes, true);
    const uint64_t overlapping = verdict.overlapping, open = verdict.undecided;
    assert_true(!(overlapping & open) && (g->count == TRIBOX_BATCH || (overlapping | open) >> g->count == 0));
    assert_true(verdict.finite == ~UINT64_C(0) >> (TRIBOX_BATCH - g->count));
    for (unsigned i = 0; i < g->count; i++) {
        const bool is_open = open >> i & 1, answer = overlapping >> i & 1;
        count->double_undecided += is_open;
        count->double_certain += !is_open;
        if (is_open || answer == oracle_overlaps(judged->truth[g->triangle[i]], axes))
            continue;
        const pair_f64 pair = scene_pair(&judged->batch, g->triangle[i]);
        fail_pair(&here, &pair, answer);
    }
}

/* The double stage of every kernel that runs here. With the box normals in the set, it relies on these not separating. */
static void check_settling(const origin *where, const judged_batch *judged, unsigned axes, reached *count)
{
    static gathered_pairs g;
    g.count = 0;
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        const pair_f64 pair = scene_pair(&judged->batch, k);
        if (!(axes & TRIBOX_AXES_BOX) || oracle_overlaps(judged->truth[k], TRIBOX_AXES_BOX))
            gather(&g, &pair, k);
        if (!g.count || (g.count < TRIBOX_BATCH && k + 1 < SCENE_TRIANGLES))
            continue;
        for (size_t i = 0; i < tribox_kernel_count(); i++)
            if (tribox_kernel_runs_here(i))
                check_settled(where, judged, &g, tribox_kernel_at(i), axes, count);
        g.count = 0;
    }
}

/* Integers, in both forms where the pair is short. */
static void check_integers(const origin *where, const pair_f64 *pair, oracle_axes truth, reached *count)
{
    tribox_pair asked;
    tribox_short_pair counted;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            asked.u[j][a] = (double)pair->u[j][a];
        asked.lo[a] = (double)pair->box.lo[a];
        asked.hi[a] = (double)pair->box.hi[a];
    }
    const bool is_short = tribox_short_pair_of(&asked, &counted);
    count->short_pairs += is_short;
    count->long_pairs += !is_short;
    for (unsigned axes = 1; axes <= AXIS_SETS; axes++) {
        const bool overlaps = oracle_overlaps(truth, axes);
        /* With the box normals in the set, the integers rely on these not separating. */
        if ((axes & TRIBOX_AXES_BOX) && !oracle_overlaps(truth, TRIBOX_AXES_BOX))
            continue;
        check(where, "tribox_exact_overlap", pair, axes, tribox_exact_overlap(&asked, axes), overlaps);
        if (is_short)
            check(where, "tribox_exact_long", pair, axes, tribox_exact_long(&asked, axes), overlaps);
    }
}

/* a + b, if that is a double. */
static bool is_sum_exact(double a, double b, double *sum)
{
    *sum = a + b;
    const double part = *sum - a;
    return a - (*sum - part) == 0 && b - part == 0;
}

/*
 * Oriented boxes, about a box of the same axes as the others', whose bounds are the doubles about its centre; and each stage alone.
 */
static void check_oriented(const origin *where, const pair_f64 *pair, unsigned axes)
{
    tribox_oriented_pair oriented = {.box.axis = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    tribox_pair straight;
    bool is_apart = false;
    for (int a = 0; a < 3; a++) {
        const double center = pair->box.lo[a] / 2 + pair->box.hi[a] / 2, half = pair->box.hi[a] / 2 - pair->box.lo[a] / 2;
        oriented.box.center[a] = center;
        oriented.box.half[a] = half;
        if (!is_sum_exact(center, -half, &straight.lo[a]) || !is_sum_exact(center, half, &straight.hi[a]))
            return;
        int below = 0, above = 0;
        for (int j = 0; j < 3; j++) {
            oriented.u[j][a] = straight.u[j][a] = (double)pair->u[j][a];
            below += straight.u[j][a] < straight.lo[a];
            above += straight.u[j][a] > straight.hi[a];
        }
        is_apart = is_apart || below == 3 || above == 3;
    }
    const bool overlaps = !((axes & TRIBOX_AXES_BOX) && is_apart) && tribox_exact_overlap(&straight, axes);
    check(where, "tribox_oriented_overlap", pair, axes, tribox_oriented_overlap(&oriented, axes), overlaps);
    check(where, "tribox_oriented_long", pair, axes, tribox_oriented_long(&oriented, axes), overlaps);
}

static void try_scene(const scene *s, reached *count)
{
    const origin where = {.scene = s->name, .seed = args.seed, .function = "oracle_separating"};
    random_source r = random_named(args.seed, s->name);
    static judged_batch judged;
    for (size_t pairs = 0; pairs < args.pairs; pairs += SCENE_TRIANGLES) {
        scene_draw_batch(s, &r, &judged.batch);
        for (int k = 0; k < SCENE_TRIANGLES; k++) {
            const pair_f64 pair = scene_pair(&judged.batch, k);
            judged.truth[k] = oracle_separating(&pair);
            check_oracles(&where, &pair, judged.truth[k], k % 16 == 0);
            check_integers(&where, &pair, judged.truth[k], count);
            if (k % 4 == 0) /* tests/inputs has an oracle for them */
                check_oriented(&where, &pair, 1 + (unsigned)(k / 4) % AXIS_SETS);
        }
        for (unsigned axes = 1; axes <= AXIS_SETS; axes++)
            check_settling(&where, &judged, axes, count);
    }
}

CASE(test_scenes)
{
    reached count = {0};
    int scenes = 0;
    for (size_t i = 0; i < scene_count(); i++)
        if (scene_is_called(scene_at(i), args.scenes)) {
            try_scene(scene_at(i), &count);
            scenes++;
        }
    printf("asked: double %zu certain, %zu undecided; integers %zu short, %zu long\n", count.double_certain, count.double_undecided,
           count.short_pairs, count.long_pairs);
    /* One scene need not reach them all; a family does. */
    if (scenes == 1)
        return;
    assert_true(count.double_certain && count.double_undecided && count.short_pairs);
}

static int check_name(void) { return scene_name_is_known(args.scenes) ? 0 : 2; }

PROGRAM_AFTER(check_name, RUN(test_scenes))
