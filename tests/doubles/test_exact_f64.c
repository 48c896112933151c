/*
 * test_exact_f64.c - every scene of doubles, every kernel: EXACT is the oracle's answer on every set of axes and in every layout;
 * CONSERVATIVE and FAST never miss, and report too much only within the bound that they promise.
 */
#include "common/harness.h"
#include "common/ask.h"
#include "common/oracle_f64.h"
#include "common/laid_mesh.h"

#include "scenes_f64.h"

/* By default a scene takes one of twenty of the pairs that --long is a hundred times of. */
enum { SHARE = 20, PAIRS_USUAL = 100000, WORDS = (BATCH_F64 + 63) / 64 };

typedef struct tally {
    size_t pairs, overlaps, contacts, undecided, asked;
    size_t rounded, rounded_false; /* answers of CONSERVATIVE and FAST */
} tally;

typedef struct test_run {
    const scene_f64 *scene;
    uint64_t seed;
    random_source r;
    laid_fences fences;
    batch_f64 batch;
    oracle_axes truth[BATCH_F64];
    bool are_floats;
    tally tally;
} test_run;

static void draw_batch(test_run *t)
{
    t->scene->draw(&t->r, &t->batch);
    t->are_floats = true;
    /* Now and then floats, against a box of any doubles. */
    for (int k = 0, is_rounded = !random_int(&t->r, 4); is_rounded && k < 9 * BATCH_F64; k++) {
        double *const x = &t->batch.u[k / 9][k / 3 % 3][k % 3];
        *x = fabs(*x) < 0x1p127 ? (double)(float)*x : *x;
    }
    /* Now and then a number that is none. */
    for (int times = random_int(&t->r, 8) ? 0 : 5; times > 0; times--) {
        static const double none[] = {NAN, -NAN, INFINITY, -INFINITY};
        t->batch.u[random_int(&t->r, BATCH_F64)][random_int(&t->r, 3)][random_int(&t->r, 3)] = none[random_int(&t->r, 4)];
    }
    for (int k = 0; k < BATCH_F64; k++) {
        const pair_f64 pair = batch_f64_pair(&t->batch, k);
        t->truth[k] = pair_f64_is_finite(&pair) ? oracle_separating_f64(&pair) : (oracle_axes){0, 0};
        const bool overlaps = oracle_overlaps_f64(&pair, t->truth[k], TRIBOX_AXES_ALL);
        t->tally.pairs++;
        t->tally.overlaps += overlaps;
        t->tally.contacts += overlaps && t->truth[k].touching;
        for (int n = 0; n < 9; n++) {
            const double x = pair_f64_number(&pair, n);
            t->are_floats = t->are_floats && (double)(float)x == x;
        }
    }
}

static void fail_pair_f64(const test_run *t, const tribox_mesh *mesh, const tribox_options *o, int k, bool answer)
{
    static const char *const accuracy[] = {"EXACT", "CONSERVATIVE", "FAST"};
    const pair_f64 pair = batch_f64_pair(&t->batch, k);
    char text[LAID_TEXT];
    fprintf(stderr, "tribox_mesh_overlap answers '%s' and is wrong\n", answer ? "overlaps" : "does not overlap");
    fprintf(stderr, "  scene %s, seed %llu, triangle %d of %s\n", t->scene->name, (unsigned long long)t->seed, k,
            laid_mesh_text(mesh, text));
    fprintf(stderr, "  %s, axes %u, kernel %s\n", accuracy[o->accuracy], o->axes, o->kernel);
    oracle_explain_f64(stderr, &pair);
    fail_msg("wrong for a pair of scene %s", t->scene->name);
}

static void check_answer(test_run *t, const tribox_mesh *mesh, const tribox_options *o, int k, bool answer)
{
    const pair_f64 pair = batch_f64_pair(&t->batch, k);
    const bool overlaps = oracle_overlaps_f64(&pair, t->truth[k], o->axes), is_false = answer && !overlaps;
    if (o->accuracy == TRIBOX_FAST && mesh->position_bytes != sizeof(double) && mesh->axis_stride <= sizeof(float) &&
        (!mesh->axes || mesh->axes == 123))
        return; /* as of a soup: it errs either way */
    if (overlaps && !answer)
        fail_pair_f64(t, mesh, o, k, answer);
    if (is_false && (o->accuracy == TRIBOX_EXACT || !oracle_is_near_f64(&pair, t->truth[k], o->axes)))
        fail_pair_f64(t, mesh, o, k, answer);
    t->tally.rounded += o->accuracy != TRIBOX_EXACT;
    t->tally.rounded_false += is_false;
}

/* The same triangles as streams: as right, and at EXACT bit for bit the same. */
static void ask_streams(test_run *t, const tribox_options *o, const uint64_t *of_mesh)
{
    static float stream[9][BATCH_F64];
    tribox_soup soup = {.count = BATCH_F64};
    const tribox_mesh as_mesh = {.position_bytes = sizeof(float)};
    uint64_t mask[WORDS];
    for (int n = 0; n < 9; n++) {
        for (int k = 0; k < BATCH_F64; k++)
            stream[n][k] = (float)t->batch.u[k][n % 3][n / 3];
        (n < 3 ? soup.x : n < 6 ? soup.y : soup.z)[n % 3] = stream[n];
    }
    assert_int_equal(tribox_overlap(&soup, &t->batch.box, o, mask, NULL), TRIBOX_OK);
    for (int k = 0; k < BATCH_F64; k++)
        check_answer(t, &as_mesh, o, k, bit_of(mask, (size_t)k));
    if (o->accuracy == TRIBOX_EXACT)
        assert_memory_equal(mask, of_mesh, sizeof mask);
}

static void ask(test_run *t, tribox_accuracy accuracy, unsigned axes, int kernel)
{
    const mesh_form form = mesh_form_draw(&t->r, t->are_floats);
    const tribox_mesh mesh = laid_mesh_of(&t->r, &form, (const double(*)[3][3])t->batch.u, BATCH_F64,
                                          permutations[random_int(&t->r, ORDERS)], t->fences);
    const tribox_options o = {
        .accuracy = accuracy, .axes = axes, .axis_order = order_digits(random_int(&t->r, ORDERS)), .kernel = names[kernel]};
    uint64_t mask[WORDS];
    tribox_report report;
    size_t count = 0;
    snprintf(doing, sizeof doing, "scene %s, kernel %s, axes %u", t->scene->name, o.kernel, axes);
    assert_int_equal(tribox_mesh_overlap(&mesh, &t->batch.box, &o, mask, &report), TRIBOX_OK);
    if (t->are_floats)
        ask_streams(t, &o, mask);
    for (int k = 0; k < BATCH_F64; k++) {
        check_answer(t, &mesh, &o, k, bit_of(mask, (size_t)k));
        count += bit_of(mask, (size_t)k);
    }
    assert_true(mask[WORDS - 1] >> BATCH_F64 % 64 == 0);
    assert_int_equal(report.overlapping, count);
    assert_in_range(report.undecided, 0, accuracy == TRIBOX_FAST ? 0 : BATCH_F64);
    if (axes == TRIBOX_AXES_ALL) {
        t->tally.asked += BATCH_F64;
        t->tally.undecided += report.undecided;
    }
}

static int any_kernel(test_run *t) { return random_int(&t->r, kernels); }

static void try_batch(test_run *t)
{
    draw_batch(t);
    for (int kernel = 0; kernel < kernels; kernel++)
        ask(t, TRIBOX_EXACT, TRIBOX_AXES_ALL, kernel);
    for (unsigned axes = 1; axes < TRIBOX_AXES_ALL; axes++)
        ask(t, TRIBOX_EXACT, axes, any_kernel(t));
    for (int accuracy = TRIBOX_CONSERVATIVE; accuracy <= TRIBOX_FAST; accuracy++) {
        ask(t, (tribox_accuracy)accuracy, TRIBOX_AXES_ALL, any_kernel(t));
        ask(t, (tribox_accuracy)accuracy, (unsigned)random_int_between(&t->r, 1, AXIS_SETS), any_kernel(t));
    }
}

static double percent(size_t part, size_t whole) { return whole ? 100 * (double)part / (double)whole : 0; }

static void print_tally(const test_run *t)
{
    const tally *const n = &t->tally;
    printf("%-14s %9zu %9.2f %10.2f %11.3f %15.5f\n", t->scene->name, n->pairs, percent(n->overlaps, n->pairs),
           percent(n->contacts, n->pairs), percent(n->undecided, n->asked), percent(n->rounded_false, n->rounded));
    fflush(stdout);
}

static size_t pairs_of(const scene_f64 *scene)
{
    return (args.pairs > PAIRS_USUAL ? args.pairs : args.pairs / SHARE) / scene->share;
}

CASE(test_scenes)
{
    static test_run t;
    t.fences = laid_fences_make(args.seed);
    t.seed = args.seed;
    printf("%-14s %9s %9s %10s %11s %15s\n", "scene", "pairs", "overlap%", "touching%", "undecided%", "rounded false%");
    for (size_t i = 0; i < scene_f64_count(); i++) {
        t.scene = scene_f64_at(i);
        if (!scene_f64_is_called(t.scene, args.scenes))
            continue;
        t.r = random_named(args.seed, t.scene->name);
        t.tally = (tally){0};
        while (t.tally.pairs < pairs_of(t.scene))
            try_batch(&t);
        print_tally(&t);
        /* A scene of one answer tests nothing. */
        assert_in_range(t.tally.overlaps, 1, t.tally.pairs - 1);
    }
}

static int check_name(void) { return scene_f64_name_is_known(args.scenes) ? 0 : 2; }

PROGRAM_AFTER(check_name, RUN(test_scenes))
