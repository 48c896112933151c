/*
 * test_forms.c - all forms of a question answer alike, and as the calls without an index do: hostile soups and boxes, every kernel,
 * accuracy and set of axes. --long asks a million questions.
 */
#include "common/harness.h"
#include "hostile.h"
#include "forms.h"

enum { TRIANGLES = 2000, BOXES = 20, PAIRS_A_QUESTION = 10 };

static int make_all(void) { return index_fixture_make(TRIANGLES, BOXES); }

/* Mostly some words: a question about them has all there is, but for a second level of nodes. */
static void draw_soup(random_source *r, const soup_kind *kind)
{
    const int most = random_int(r, 12) ? 300 : TRIANGLES, shift = random_int(r, 2 * STORED_SHIFTS);
    stored_soup_lay((size_t)random_int(r, most + 1), shift < STORED_SHIFTS ? shift : STORED_AT_END);
    kind->draw(r);
    spoil_soup(r, random_int(r, 2) ? DIRT_NONE : (dirt)random_int(r, DIRTS));
    const tribox_options options = any_index_options(r);
    stored_build(options.kernel);
}

/* A soup, some boxes one by one, and the same at once. */
static void check_soup(random_source *r, const soup_kind *kind)
{
    static float bound[6][BOXES];
    tribox_boxes boxes = {.count = BOXES};
    draw_soup(r, kind);
    const tribox_options options = any_index_options(r);
    for (int b = 0; b < BOXES; b++) {
        const tribox_box box = draw_box(r);
        check_forms(&box, &options, kind->name);
        for (int a = 0; a < 3; a++) {
            bound[a][b] = (float)box.lo[a];
            bound[3 + a][b] = (float)box.hi[a];
        }
    }
    for (int a = 0; a < 3; a++) {
        boxes.lo[a] = bound[a];
        boxes.hi[a] = bound[3 + a];
    }
    check_lists(&boxes, &options, kind->name);
}

CASE(test_hostile_soups)
{
    const size_t rounds = arguments_rounds(&args, soup_kind_count() * BOXES * PAIRS_A_QUESTION);
    for (size_t k = 0; k < soup_kind_count(); k++) {
        random_source r = random_named(args.seed, soup_kind_at(k)->name);
        for (size_t round = 0; round < rounds; round++)
            check_soup(&r, soup_kind_at(k));
    }
}

/* Each scene against its own box, with every option there is. */
CASE(test_scenes)
{
    for (size_t i = 0; i < scene_count(); i++) {
        scene_batch batch;
        random_source r = random_named(args.seed, scene_at(i)->name);
        scene_draw_batch(scene_at(i), &r, &batch);
        stored_soup_lay(SCENE_TRIANGLES, STORED_AT_END);
        put_batch(0, &batch);
        stored_build(names[i % (size_t)kernels]);
        for (int k = 0; k < kernels; k++)
            for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
                for (unsigned axes = TRIBOX_AXES_BOX; axes <= TRIBOX_AXES_ALL; axes += 2)
                    check_forms(&batch.box, &(tribox_options){.accuracy = accuracy, .axes = axes, .kernel = names[k]},
                                scene_at(i)->name);
    }
}

PROGRAM_AFTER(make_all, RUN(test_hostile_soups), RUN(test_scenes))
