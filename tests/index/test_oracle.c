/* test_oracle.c - what an index finds is true: an oracle that knows neither indices nor kernels says what overlaps in scenes. */
#include "common/harness.h"
#include "common/oracle.h"
#include "hostile.h"

enum { WORDS = (SCENE_TRIANGLES + 63) / 64, PAIRS = 100000, ROUNDS = 12 };

static stored_soup stored;

static int make_all(void)
{
    stored = stored_soup_make(SCENE_TRIANGLES);
    return 0;
}

static void check_by_oracle(const scene_batch *batch, unsigned axes, const char *name)
{
    uint64_t truth[WORDS] = {0}, mask[WORDS];
    for (int t = 0; t < SCENE_TRIANGLES; t++) {
        const pair_f64 pair = scene_pair(batch, t);
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

CASE(test_scenes)
{
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

PROGRAM_AFTER(make_all, RUN(test_scenes))
