/*
 * test_exact.c - every scene, of floats and of doubles, every kernel: EXACT is the oracle's answer on every set of axes, of soups,
 * boxes and meshes of any layout. CONSERVATIVE never misses, nor does FAST about doubles, and of these both report too much only
 * within the bound that they promise; FAST about floats is counted.
 */
#include "common/ask.h"
#include "common/harness.h"
#include "common/laid_mesh.h"
#include "common/scenes.h"
#include "common/soup_or_mesh.h"
#include "doubles/scenes_f64.h"

/* Of boxes, the pair's lies among empty ones, in any lane of a word or a tail. A scene of doubles takes one of SHARE pairs. */
enum { COUNT = SCENE_TRIANGLES, WORDS = (COUNT + 63) / 64, SHARE = 20, PAIRS_USUAL = 100000 };

_Static_assert((int)COUNT == (int)BATCH_F64, "one batch holds either");

typedef struct tally {
    size_t pairs, overlaps, contacts, asked[3], missed[3], too_many[3]; /* the last three by accuracy */
} tally;

static struct {
    origin where;
    const scene *floats; /* or else */
    const scene_f64 *doubles;
    random_source r;
    laid_fences fences;
    batch_f64 batch;
    bool are_floats; /* all numbers of the triangles */
    oracle_axes truth[COUNT];
    float stream[9][COUNT], corner[COUNT][9]; /* the same as floats */
    tally tally;
} t;

static void draw_floats(void)
{
    scene_batch batch;
    scene_draw_batch(t.floats, &t.r, &batch);
    t.batch.box = batch.box;
    for (int n = 0; n < 9 * COUNT; n++)
        t.batch.u[n / 9][n / 3 % 3][n % 3] = (double)batch.u[n / 9][n / 3 % 3][n % 3];
}

static void draw_doubles(void)
{
    t.doubles->draw(&t.r, &t.batch);
    /* Now and then floats, against a box of any doubles. */
    for (int k = 0, is_rounded = !random_int(&t.r, 4); is_rounded && k < 9 * COUNT; k++) {
        double *const x = &t.batch.u[k / 9][k / 3 % 3][k % 3];
        *x = fabs(*x) < 0x1p127 ? (double)(float)*x : *x;
    }
    /* Now and then a number that is none. */
    for (int times = random_int(&t.r, 8) ? 0 : 5; times > 0; times--) {
        static const double none[] = {NAN, -NAN, INFINITY, -INFINITY};
        t.batch.u[random_int(&t.r, COUNT)][random_int(&t.r, 3)][random_int(&t.r, 3)] = none[random_int(&t.r, 4)];
    }
}

static void draw_batch(void)
{
    if (t.floats)
        draw_floats();
    else
        draw_doubles();
    t.are_floats = true;
    for (int k = 0; k < COUNT; k++) {
        const pair_f64 pair = batch_f64_pair(&t.batch, k);
        t.truth[k] = pair_f64_is_finite(&pair) ? oracle_separating(&pair) : (oracle_axes){0, 0};
        const bool overlaps = oracle_pair_overlaps(&pair, t.truth[k], TRIBOX_AXES_ALL);
        t.tally.pairs++;
        t.tally.overlaps += overlaps;
        t.tally.contacts += overlaps && t.truth[k].touching;
        for (int n = 0; n < 9; n++) {
            const double x = pair_f64_number(&pair, n);
            t.corner[k][n] = t.stream[3 * (n % 3) + n / 3][k] = (float)x;
            t.are_floats = t.are_floats && (double)(float)x == x;
        }
    }
}

/* may_miss: of floats in rows or streams, about which FAST errs either way. */
static void check_answer(int k, bool answer, bool may_miss)
{
    const tribox_accuracy accuracy = t.where.options.accuracy;
    const pair_f64 pair = batch_f64_pair(&t.batch, k);
    const bool overlaps = oracle_pair_overlaps(&pair, t.truth[k], t.where.options.axes);
    const bool is_missed = overlaps && !answer, is_false = answer && !overlaps, errs = accuracy == TRIBOX_FAST && may_miss;
    const bool must_be_right = accuracy == TRIBOX_EXACT || (accuracy == TRIBOX_FAST && t.floats && t.floats->is_exact_in_float);
    if (must_be_right ? is_missed || is_false
                      : !errs && (is_missed || (is_false && t.doubles &&
                                                !oracle_is_near(&pair, t.truth[k], t.where.options.axes, ORACLE_NEAR_BITS))))
        fail_pair(&t.where, &pair, answer);
    t.tally.asked[accuracy]++;
    t.tally.missed[accuracy] += is_missed;
    t.tally.too_many[accuracy] += is_false;
}

/* The whole batch against its box, as streams, the vertices taken in any order. */
static void ask_streams(void)
{
    const int *const vertex = permutations[random_int(&t.r, ORDERS)];
    tribox_soup soup = {.count = COUNT};
    for (int j = 0; j < 3; j++) {
        soup.x[j] = t.stream[vertex[j]];
        soup.y[j] = t.stream[3 + vertex[j]];
        soup.z[j] = t.stream[6 + vertex[j]];
    }
    uint64_t mask[WORDS];
    t.where.function = "tribox_overlap";
    ask_soup(&soup, &t.batch.box, &t.where.options, mask);
    for (int k = 0; k < COUNT; k++)
        check_answer(k, bit_of(mask, (size_t)k), true);
}

static void ask_laid(void)
{
    const mesh_form form = mesh_form_draw(&t.r, t.are_floats);
    const tribox_mesh mesh =
        laid_mesh_of(&t.r, &form, (const double(*)[3][3])t.batch.u, COUNT, permutations[random_int(&t.r, ORDERS)], t.fences);
    const bool are_rows = mesh.position_bytes != 8 && mesh.axis_stride <= sizeof(float) && (!mesh.axes || mesh.axes == 123);
    char text[LAID_TEXT];
    uint64_t mask[WORDS];
    t.where.function = laid_mesh_text(&mesh, text);
    ask_mesh(&mesh, &t.batch.box, &t.where.options, mask);
    for (int k = 0; k < COUNT; k++)
        check_answer(k, bit_of(mask, (size_t)k), are_rows);
}

static void ask(void)
{
    if (t.doubles)
        ask_laid();
    if (t.are_floats)
        ask_streams();
}

/* The same pairs of floats, one call each: the pair's box in any lane, the others empty. */
static void ask_boxes_of_pairs(void)
{
    static float bound[6][COUNT];
    const tribox_boxes boxes = {{bound[0], bound[1], bound[2]}, {bound[3], bound[4], bound[5]}, COUNT};
    for (int n = 0; n < 6 * COUNT; n++)
        bound[n / COUNT][n % COUNT] = n < 3 * COUNT ? 1 : -1;
    t.where.function = "tribox_overlap_boxes";
    for (int k = 0; k < COUNT; k++) {
        const int lane = random_int(&t.r, COUNT);
        uint64_t mask[WORDS];
        for (int n = 0; n < 6; n++)
            bound[n][lane] = (float)(n < 3 ? t.batch.box.lo[n] : t.batch.box.hi[n - 3]);
        ask_boxes(t.corner[k], &boxes, &t.where.options, mask);
        for (int n = 0; n < 6; n++)
            bound[n][lane] = n < 3 ? 1 : -1;
        check_answer(k, bit_of(mask, (size_t)lane), true);
        mask[lane / 64] &= ~(UINT64_C(1) << lane % 64);
        const pair_f64 empty = pair_of_floats(t.corner[k], &(tribox_box){{1, 1, 1}, {-1, -1, -1}});
        if (mask[0] || mask[1])
            fail_pair(&t.where, &empty, true);
    }
}

static void choose(tribox_accuracy accuracy, unsigned axes, int kernel)
{
    t.where.options = (tribox_options){
        .accuracy = accuracy, .axes = axes, .axis_order = order_digits(random_int(&t.r, ORDERS)), .kernel = names[kernel]};
}

static int any_kernel(void) { return random_int(&t.r, kernels); }

static unsigned any_axes(void) { return (unsigned)random_int_between(&t.r, 1, AXIS_SETS); }

static void ask_either_way(bool as_boxes)
{
    if (t.floats && as_boxes)
        ask_boxes_of_pairs();
    else
        ask();
}

/*
 * EXACT on all thirteen axes from every kernel, and on every set of axes from one of them; then every accuracy once more, of floats
 * in both functions. What is not looped over is drawn afresh each time.
 */
static void try_batch(void)
{
    draw_batch();
    for (int kernel = 0; kernel < kernels; kernel++) {
        choose(TRIBOX_EXACT, TRIBOX_AXES_ALL, kernel);
        ask();
    }
    for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
        choose(TRIBOX_EXACT, axes, any_kernel());
        ask_either_way(axes == TRIBOX_AXES_ALL);
    }
    for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
        choose(accuracy, any_axes(), any_kernel());
        ask();
        choose(accuracy, t.floats ? any_axes() : TRIBOX_AXES_ALL, any_kernel());
        ask_either_way(true);
    }
}

static double percent(size_t part, size_t whole) { return whole ? 100 * (double)part / (double)whole : 0; }

static void try_scene(const char *name, const char *family, size_t pairs)
{
    const tally *const n = &t.tally;
    t.where = (origin){.scene = name, .seed = args.seed};
    t.r = random_named(args.seed, name);
    t.tally = (tally){0};
    while (n->pairs < pairs)
        try_batch();
    printf("%-20s %9zu %8.2f %9.2f %14.4f %11.4f %10.4f\n", name, n->pairs, percent(n->overlaps, n->pairs),
           percent(n->contacts, n->pairs), percent(n->too_many[TRIBOX_CONSERVATIVE], n->asked[TRIBOX_CONSERVATIVE]),
           percent(n->missed[TRIBOX_FAST], n->asked[TRIBOX_FAST]), percent(n->too_many[TRIBOX_FAST], n->asked[TRIBOX_FAST]));
    fflush(stdout);
    /* A scene of one answer tests nothing, nor does one of contacts without any. */
    assert_in_range(n->overlaps, 1, n->pairs - 1);
    if (!strcmp(family, "contact"))
        assert_true(n->contacts > n->pairs / 20);
}

CASE(test_scenes)
{
    t.fences = laid_fences_make(args.seed);
    printf("%-20s %9s %8s %9s %14s %11s %10s\n", "scene", "pairs", "overlap%", "touching%", "conserv. false%", "fast missed%",
           "fast false%");
    for (size_t i = 0; i < scene_count(); i++)
        if (scene_is_called(t.floats = scene_at(i), args.scenes))
            try_scene(t.floats->name, t.floats->family, args.pairs);
    t.floats = NULL;
    for (size_t i = 0; i < scene_f64_count(); i++)
        if (scene_f64_is_called(t.doubles = scene_f64_at(i), args.scenes))
            try_scene(t.doubles->name, "doubles", (args.pairs > PAIRS_USUAL ? args.pairs : args.pairs / SHARE) / t.doubles->share);
}

static int check_name(void) { return scene_name_is_known(args.scenes) ? 0 : 2; }

PROGRAM_AFTER(check_name, RUN(test_scenes))
