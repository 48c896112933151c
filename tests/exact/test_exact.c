/* test_exact.c - every scene, every kernel: EXACT is the oracle's answer, CONSERVATIVE never misses, FAST is counted. */
#include "common/ask.h"

#include <string.h>

#include "common/arguments.h"
#include "common/scenes.h"

/* The pair's box lies among empty ones, in any lane of a whole word or of a tail. */
enum { BOXES = SCENE_TRIANGLES };

typedef struct tally {
    size_t pairs, overlaps, contacts;
    size_t conservative_asked, conservative_false;
    size_t fast_asked, fast_missed, fast_false;
} tally;

typedef struct test_run {
    origin where;
    const scene *scene;
    random_source r;
    const char *kernels[KERNELS_MAX];
    int kernel_count;
    scene_batch batch;
    oracle_axes truth[SCENE_TRIANGLES];
    float coordinate[3][3][SCENE_TRIANGLES]; /* the batch as streams: vertex, axis, triangle */
    float bound[2][3][BOXES];                /* lo and hi, axis, box */
    tally tally;
} test_run;

static void draw_batch(test_run *t)
{
    scene_draw_batch(t->scene, &t->r, &t->batch);
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        const pair_f32 pair = scene_pair(&t->batch, k);
        t->truth[k] = oracle_separating(&pair);
        const bool overlaps = oracle_overlaps(t->truth[k], TRIBOX_AXES_ALL);
        t->tally.pairs++;
        t->tally.overlaps += overlaps;
        t->tally.contacts += overlaps && t->truth[k].touching;
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                t->coordinate[j][a][k] = pair.u[j][a];
    }
}

static void check_answer(test_run *t, int k, bool answer)
{
    const tribox_accuracy accuracy = t->where.options.accuracy;
    const bool overlaps = oracle_overlaps(t->truth[k], t->where.options.axes);
    const bool is_missed = overlaps && !answer, is_false = answer && !overlaps;
    const bool must_be_right = accuracy == TRIBOX_EXACT || (accuracy == TRIBOX_FAST && t->scene->is_exact_in_float);
    if ((must_be_right && (is_missed || is_false)) || (accuracy == TRIBOX_CONSERVATIVE && is_missed)) {
        const pair_f32 pair = scene_pair(&t->batch, k);
        fail_pair(&t->where, &pair, answer);
    }
    t->tally.conservative_asked += accuracy == TRIBOX_CONSERVATIVE;
    t->tally.conservative_false += accuracy == TRIBOX_CONSERVATIVE && is_false;
    t->tally.fast_asked += accuracy == TRIBOX_FAST;
    t->tally.fast_missed += accuracy == TRIBOX_FAST && is_missed;
    t->tally.fast_false += accuracy == TRIBOX_FAST && is_false;
}

/* The whole batch against its box, the vertices taken in any order. */
static void ask_batch(test_run *t)
{
    const int *const vertex = permutations[random_int(&t->r, ORDERS)];
    tribox_soup soup = {.count = SCENE_TRIANGLES};
    for (int j = 0; j < 3; j++) {
        soup.x[j] = t->coordinate[vertex[j]][0];
        soup.y[j] = t->coordinate[vertex[j]][1];
        soup.z[j] = t->coordinate[vertex[j]][2];
    }
    uint64_t mask[(SCENE_TRIANGLES + 63) / 64];
    t->where.function = "tribox_overlap";
    ask_soup(&soup, &t->batch.box, &t->where.options, mask);
    for (int k = 0; k < SCENE_TRIANGLES; k++)
        check_answer(t, k, bit_of(mask, (size_t)k));
}

static void put_box(test_run *t, size_t lane, const tribox_box *box)
{
    for (int a = 0; a < 3; a++) {
        t->bound[0][a][lane] = (float)box->lo[a];
        t->bound[1][a][lane] = (float)box->hi[a];
    }
}

/* The same pairs, one call each: the pair's box in any lane, the others empty. */
static void ask_batch_as_boxes(test_run *t)
{
    static const tribox_box empty = {{1, 1, 1}, {-1, -1, -1}};
    tribox_boxes boxes = {.count = BOXES};
    for (int a = 0; a < 3; a++) {
        boxes.lo[a] = t->bound[0][a];
        boxes.hi[a] = t->bound[1][a];
    }
    for (size_t lane = 0; lane < BOXES; lane++)
        put_box(t, lane, &empty);
    t->where.function = "tribox_overlap_boxes";
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        const size_t lane = (size_t)random_int(&t->r, BOXES);
        pair_f32 pair = scene_pair(&t->batch, k);
        uint64_t mask[(BOXES + 63) / 64];
        put_box(t, lane, &t->batch.box);
        ask_boxes(triangle_of(&pair), &boxes, &t->where.options, mask);
        put_box(t, lane, &empty);
        check_answer(t, k, bit_of(mask, lane));
        mask[lane / 64] &= ~(UINT64_C(1) << lane % 64);
        pair.box = empty;
        if (mask[0] || mask[1])
            fail_pair(&t->where, &pair, true);
    }
}

static void choose(test_run *t, tribox_accuracy accuracy, unsigned axes, int kernel)
{
    t->where.options = (tribox_options){
        .accuracy = accuracy, .axes = axes, .axis_order = order_digits(random_int(&t->r, ORDERS)), .kernel = t->kernels[kernel]};
}

static int any_kernel(test_run *t) { return random_int(&t->r, t->kernel_count); }

static unsigned any_axes(test_run *t) { return (unsigned)random_int_between(&t->r, 1, AXIS_SETS); }

/*
 * EXACT on all thirteen axes from every kernel, and on every set of axes from one of them; then every accuracy once more, in both
 * functions. What is not looped over is drawn afresh each time.
 */
static void try_batch(test_run *t)
{
    draw_batch(t);
    for (int kernel = 0; kernel < t->kernel_count; kernel++) {
        choose(t, TRIBOX_EXACT, TRIBOX_AXES_ALL, kernel);
        ask_batch(t);
    }
    choose(t, TRIBOX_EXACT, TRIBOX_AXES_ALL, any_kernel(t));
    ask_batch_as_boxes(t);
    for (unsigned axes = 1; axes < TRIBOX_AXES_ALL; axes++) {
        choose(t, TRIBOX_EXACT, axes, any_kernel(t));
        ask_batch(t);
    }
    for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
        choose(t, (tribox_accuracy)accuracy, any_axes(t), any_kernel(t));
        ask_batch(t);
        choose(t, (tribox_accuracy)accuracy, any_axes(t), any_kernel(t));
        ask_batch_as_boxes(t);
    }
}

static double percent(size_t part, size_t whole) { return whole ? 100 * (double)part / (double)whole : 0; }

static void print_tally(const test_run *t)
{
    const tally *const n = &t->tally;
    printf("%-20s %9zu %8.2f %9.2f %14.4f %11.4f %10.4f\n", t->scene->name, n->pairs, percent(n->overlaps, n->pairs),
           percent(n->contacts, n->pairs), percent(n->conservative_false, n->conservative_asked),
           percent(n->fast_missed, n->fast_asked), percent(n->fast_false, n->fast_asked));
    fflush(stdout);
}

static void test_scenes(void **state)
{
    const arguments *const args = *state;
    static test_run t;
    t.kernel_count = kernels_here(t.kernels);
    printf("%-20s %9s %8s %9s %14s %11s %10s\n", "scene", "pairs", "overlap%", "touching%", "conserv. false%", "fast missed%",
           "fast false%");
    for (size_t i = 0; i < scene_count(); i++) {
        if (!scene_is_called(scene_at(i), args->scenes))
            continue;
        t.scene = scene_at(i);
        t.where = (origin){.scene = t.scene->name, .seed = args->seed};
        t.r = random_named(args->seed, t.scene->name);
        t.tally = (tally){0};
        while (t.tally.pairs < args->pairs)
            try_batch(&t);
        print_tally(&t);
        /* A scene of one answer tests nothing, nor does one of contacts without any. */
        assert_in_range(t.tally.overlaps, 1, t.tally.pairs - 1);
        if (!strcmp(t.scene->family, "contact"))
            assert_true(t.tally.contacts > t.tally.pairs / 20);
    }
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    if (!scene_name_is_known(args.scenes))
        return 2;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_scenes, &args)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
