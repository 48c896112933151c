/* test_oracle.c - what an index finds is true: an oracle that knows neither indices nor kernels says what overlaps in scenes. */
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#include "common/arguments.h"
#include "common/kernels_here.h"
#include "common/oracle.h"
#include "hostile.h"

enum { WORDS = (SCENE_TRIANGLES + 63) / 64, PAIRS = 100000, ROUNDS = 12 };

static arguments args;
static stored_soup stored;

static int make_all(void **state)
{
    (void)state;
    stored = stored_soup_make(SCENE_TRIANGLES);
    return 0;
}

static int free_all(void **state)
{
    (void)state;
    stored_soup_free(&stored);
    return 0;
}

static void check_by_oracle(const scene_batch *batch, unsigned axes, const char *name)
{
    const char *names[KERNELS_MAX];
    const int kernels = kernels_here(names);
    uint64_t truth[WORDS] = {0}, mask[WORDS];
    for (int t = 0; t < SCENE_TRIANGLES; t++) {
        const pair_f32 pair = scene_pair(batch, t);
        truth[t / 64] |= (uint64_t)oracle_overlaps(oracle_separating(&pair), axes) << t % 64;
    }
    for (int k = 0; k < kernels; k++) {
        const tribox_options options = {.axes = axes, .kernel = names[k]};
        stored_soup_build(&stored, names[k]);
        assert_int_equal(tribox_index_overlap(&stored.index, &(tribox_region){.box = &batch->box}, &options, mask, NULL),
                         TRIBOX_OK);
        if (memcmp(mask, truth, sizeof mask))
            fail_msg("scene %s, axes %u, kernel %s: not what the oracle says", name, axes, names[k]);
    }
}

static void test_scenes(void **state)
{
    (void)state;
    catch_faults();
    for (size_t i = 0; i < scene_count(); i++) {
        random_source r = random_named(args.seed, scene_at(i)->name);
        for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
            scene_batch batch;
            scene_draw_batch(scene_at(i), &r, &batch);
            stored_soup_lay(&stored, SCENE_TRIANGLES, STORED_AT_END);
            put_batch(&stored, 0, &batch);
            check_by_oracle(&batch, TRIBOX_AXES_BOX | 2u * (unsigned)(round % 4), scene_at(i)->name);
        }
    }
}

int main(int argc, char **argv)
{
    args = arguments_parse(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_scenes)};
    return cmocka_run_group_tests(tests, make_all, free_all);
}
