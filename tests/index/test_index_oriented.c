/*
 * test_index_oriented.c - oriented boxes asked of an index of a soup or a mesh: EXACT is the call without one bit for bit on every
 * kernel, CONSERVATIVE never misses, and what is far outside or inside is not even read.
 */
#include <math.h>

#include "common/harness.h"
#include "common/contact.h"
#include "common/fences.h"
#include "hostile.h"
#include "forms.h"
#include "oriented_scenes.h"

enum { COUNT_MAX = 2 * TRIBOX_INDEX_BLOCK, WORDS = COUNT_MAX / 64, PAIRS = 100000, ROUNDS = 5, BOXES = 6 };

static int make_all(void)
{
    stored_mesh_make(COUNT_MAX);
    return index_fixture_make(COUNT_MAX, 1);
}

CASE(test_hostile)
{
    for (size_t kind = 0; kind < soup_kind_count(); kind++) {
        random_source r = random_named(args.seed, soup_kind_at(kind)->name);
        for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
            draw_stored_form(&r, soup_kind_at(kind), random_below(&r, round % 8 ? 400 : COUNT_MAX));
            for (int b = 0; b < BOXES; b++) {
                const tribox_box about = draw_box(&r), box = box_in_place(&r, &about);
                const tribox_oriented_box turned = draw_oriented(&r, &box);
                const tribox_options options = {.accuracy = (tribox_accuracy)(random_int(&r, 6) % 4 % 3),
                                                .axes = random_int(&r, 4) ? 0 : TRIBOX_AXES_BOX,
                                                .axis_order = axis_order_at(random_int(&r, AXIS_ORDERS)),
                                                .kernel = names[random_int(&r, kernels)]};
                check_turned(&turned, &options, soup_kind_at(kind)->name);
            }
        }
    }
}

CASE(test_scenes)
{
    static oriented_batch batch;
    for (int s = 0; s < ORIENTED_SCENES; s++) {
        random_source r = random_named(args.seed, oriented_scenes[s].name);
        for (int round = 0; round < (arguments_are_short(&args) ? 1 : 4); round++) {
            oriented_draw(&oriented_scenes[s], (oriented_form)(round % 2), &r, &batch);
            stored_soup_lay((size_t)batch.count, STORED_AT_END);
            for (int t = 0; t < batch.count; t++)
                for (int k = 0; k < STORED_STREAMS; k++)
                    stored.stream[k][t] = (float)batch.u[t][k % 3][k / 3];
            stored_build(NULL);
            for (int k = 0; k < kernels; k++)
                check_turned(&batch.box, &(tribox_options){.accuracy = (tribox_accuracy)((round + k) % 2), .kernel = names[k]},
                             oriented_scenes[s].name);
        }
    }
}

/* One point all over, through which a face of a turned box goes, but for the rounding. */
CASE(test_rounding)
{
    random_source r = random_named(args.seed, "rounding");
    for (int round = 0; round < (arguments_are_short(&args) ? 100 : 500); round++) {
        tribox_oriented_box box;
        const int turned = random_int(&r, 3);
        draw_axes(&r, &box);
        float place[3];
        double along;
        do { /* which cancels: the rounding of its terms is large then */
            along = 0;
            for (int a = 0; a < 3; a++) {
                place[a] = (float)random_double(&r, -1, 1);
                box.center[a] = (float)random_double(&r, -4, 4);
                box.half[a] = 20;
                along += (double)box.axis[turned][a] * ((double)place[a] - (double)box.center[a]);
            }
        } while (fabs(along) > 0.3);
        stored_soup_lay(64, STORED_AT_END);
        for (int stream = 0; stream < STORED_STREAMS; stream++) {
            for (size_t i = 0; i < 64; i++)
                stored.stream[stream][i] = place[stream / 3];
            if (round % 2) /* bounds from here to the center */
                stored.stream[stream][0] = (float)box.center[stream / 3];
        }
        box.half[turned] = nudged(&r, (float)fabs(along), 1);
        stored_build(NULL);
        check_turned(&box, &(tribox_options){.kernel = names[round % kernels]}, "a point in a face");
    }
}

/* Boxes turned about a node, by its radius and by far more; and boxes that its words are beside, on each side of each axis. */
CASE(test_unseen)
{
    random_source r = random_named(args.seed, "unseen");
    stored_soup_lay(TRIBOX_INDEX_BLOCK, STORED_AT_END);
    for (int k = 0; k < STORED_STREAMS; k++)
        for (size_t i = 0; i < stored.soup.count; i++)
            stored.stream[k][i] = 30 + (float)random_double(&r, -1, 1);
    stored_build(NULL);
    for (int turn = 0; turn < 60; turn++)
        for (int k = 0; k < kernels; k++) {
            const tribox_options options = {.accuracy = (tribox_accuracy)(turn % 3), .kernel = names[k]};
            tribox_oriented_box around = {{30, 30, 30}, {1.75f, 1.75f, 1.75f}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
            const double c = cos(turn), s = sin(turn);
            const int a = turn % 3, b = (turn + 1) % 3, side = turn / 3 % 2 ? 4 : -4;
            around.axis[a][a] = around.axis[b][b] = (float)c;
            around.axis[a][b] = (float)s;
            around.axis[b][a] = (float)-s;
            tribox_oriented_box beside = around;
            for (int e = 0; e < 3; e++)
                beside.center[e] += (float)side * around.axis[turn / 6 % 3][e];
            assert_int_equal(count_unseen(&(tribox_region){.oriented = &around}, &options, "around"), stored.soup.count);
            assert_int_equal(count_unseen(&(tribox_region){.oriented = &beside}, &options, "beside"), 0);
        }
}

PROGRAM_AFTER(make_all, RUN(test_hostile), RUN(test_scenes), RUN(test_rounding), RUN(test_unseen))
