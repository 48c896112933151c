/* test_room.c - what is found is the same whatever room there is for it, and nothing is written beyond; boxes that find nothing. */
#include <math.h>

#include "common/harness.h"
#include "hostile.h"
#include "forms.h"

enum { TRIANGLES = 5000, BOXES = 7 };

static int make_all(void) { return index_fixture_make(TRIANGLES, BOXES); }

/* Boxes as streams, valid until the next. */
static tribox_boxes streams_of(const tribox_box *box, size_t count)
{
    static float bound[6][BOXES];
    tribox_boxes boxes = {.count = count};
    for (int k = 0; k < 6; k++) {
        for (size_t b = 0; b < count; b++)
            bound[k][b] = (float)(k < 3 ? box[b].lo[k] : box[b].hi[k - 3]);
        (k < 3 ? boxes.lo : boxes.hi)[k % 3] = bound[k];
    }
    return boxes;
}

/* Often enough to have had every room that the forms take in turn. */
CASE(test_rooms)
{
    static const size_t counts[] = {0, 1, 64, 100, 4096, 4097, TRIANGLES};
    random_source r = random_named(args.seed, "rooms");
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++)
        for (size_t turn = 0; turn < 3 * (size_t)kernels; turn++) {
            const tribox_options options = {.accuracy = (tribox_accuracy)(turn % 3), .kernel = names[turn / 3]};
            tribox_box box[BOXES];
            stored_soup_lay(counts[c], STORED_AT_END);
            draw_cells(&r);
            spoil_soup(&r, turn % 2 ? DIRT_ONE : DIRT_NONE);
            stored_build(options.kernel);
            for (int b = 0; b < 2 * BOXES; b++) {
                box[b % BOXES] = b < BOXES ? draw_box(&r) : box[b % BOXES];
                check_forms(&box[b % BOXES], &options, "cells");
            }
            const tribox_boxes boxes = streams_of(box, BOXES);
            for (int n = 0; n < 10; n++)
                check_lists(&boxes, &options, "cells");
        }
}

/* Boxes that are empty on an axis, by much or by an ulp, flat, or a point; about triangles that other boxes there would find. */
CASE(test_thin_boxes)
{
    random_source r = random_named(args.seed, "thin boxes");
    for (int k = 0; k < kernels; k++) {
        stored_soup_lay(4200, STORED_AT_END);
        draw_cells(&r);
        stored_build(names[k]);
        const tribox_box all = bounds_of(0, stored.soup.count);
        for (int turn = 0; turn < 60; turn++) {
            const size_t i = random_below(&r, stored.soup.count);
            const int a = turn % 3, v = random_int(&r, 3);
            tribox_box box = all;
            double *const lo = &box.lo[a], *const hi = &box.hi[a];
            *lo = *hi = stored.stream[3 * a + v][i];
            if (turn % 4 == 0)
                *lo = nextafterf((float)*lo, INFINITY);
            if (turn % 4 == 1) {
                *lo = all.hi[a];
                *hi = all.lo[a];
            }
            if (turn % 4 == 2)
                for (int b = 0; b < 3; b++)
                    box.lo[b] = box.hi[b] = stored.stream[3 * b + v][i];
            const tribox_options options = {.accuracy = (tribox_accuracy)(turn / 4 % 3), .kernel = names[k]};
            if (isfinite(*lo))
                check_forms(&box, &options, "thin boxes");
        }
    }
}

/* A bound that is NaN or infinite makes an empty list in between, and so does an empty box. */
CASE(test_boxes_without_lists)
{
    static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    random_source r = random_named(args.seed, "boxes without lists");
    for (int k = 0; k < kernels; k++)
        for (int kind = 0; kind < 5 * 6; kind++) {
            tribox_box box[BOXES];
            stored_soup_lay(300, STORED_AT_END);
            draw_cells(&r);
            stored_build(names[k]);
            for (int b = 0; b < BOXES; b++) {
                box[b] = bounds_of(0, 300);
                double *const bound = kind < 15 ? box[b].lo : box[b].hi;
                if (random_int(&r, 2))
                    bound[kind % 3] = kind / 3 % 5 < 4 ? bad[kind / 3 % 5] : kind < 15 ? INFINITY : -INFINITY;
                if (random_int(&r, 4) == 0)
                    box[b].lo[kind % 3] = nextafterf((float)box[b].hi[kind % 3], INFINITY);
            }
            for (size_t count = 0; count <= BOXES; count++) {
                const tribox_boxes boxes = streams_of(box, count);
                check_lists(&boxes, &(tribox_options){.accuracy = (tribox_accuracy)(count % 3), .kernel = names[k]}, "cells");
            }
        }
}

PROGRAM_AFTER(make_all, RUN(test_rooms), RUN(test_thin_boxes), RUN(test_boxes_without_lists))
