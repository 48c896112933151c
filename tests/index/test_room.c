/* test_room.c - what is found is the same whatever room there is for it, and nothing is written beyond; boxes that find nothing. */
#include <math.h>

#include "common/harness.h"
#include "fences.h"
#include "hostile.h"
#include "index_fixture.h"

enum { TRIANGLES = 5000, WORDS = (TRIANGLES + 63) / 64, BOXES = 7, LISTED = BOXES * TRIANGLES };

static int make_all(void) { return index_fixture_make(TRIANGLES, BOXES); }

static uint32_t *numbers_of(fenced place) { return (uint32_t *)(void *)place.at; }
static uint64_t *words_of(fenced place) { return (uint64_t *)(void *)place.at; }

static void say(const char *form, const tribox_options *options, size_t room)
{
    snprintf(doing, sizeof doing, "%s: room %zu, kernel %s, accuracy %d", form, room, options->kernel, (int)options->accuracy);
}

/* Room for nothing, for one, about what is found, about multiples of a word, and for more than there is. */
enum { ROOMS = 14 };
static void rooms_about(size_t found, size_t most, size_t rooms[ROOMS])
{
    const size_t all[ROOMS] = {0, 1, 2, 63, 64, 65, 128, found / 2, found, found + 1, found - 1, found - 64, found - 65, most};
    for (size_t k = 0; k < ROOMS; k++)
        rooms[k] = all[k] <= most ? all[k] : 0;
}

static void demand_found(size_t found, size_t expected)
{
    if (found != expected)
        fail_msg("%s: found %zu, not %zu", doing, found, expected);
}

/* The part of `whole` for which there is room is written, at the end of a fence, and nothing else. */
static void demand_part(const fenced *place, const void *whole)
{
    if (memcmp(place->at, whole, place->bytes))
        fail_msg("%s: other numbers than with room for all", doing);
    assert_nothing_beside(place);
}

static size_t less(size_t one, size_t other) { return one < other ? one : other; }

/* A place at the start of a fence for so many things: what is beyond it may be touched, and so shows what was written there. */
static fenced place_for(guarded fence, size_t fits, size_t size) { return fenced_place(fence, fits * size, 0); }

static void check_words(const tribox_box *box, const tribox_options *options)
{
    static uint32_t number[WORDS];
    static uint64_t bits[WORDS], inside[WORDS];
    size_t expected = 0, rooms[ROOMS];
    assert_int_equal(
        tribox_index_words(&stored.index, &(tribox_region){.box = box}, options, WORDS, number, bits, inside, &expected, NULL),
        TRIBOX_OK);
    rooms_about(expected, WORDS, rooms);
    for (size_t k = 0; k < ROOMS; k++) {
        const size_t fits = less(rooms[k], expected);
        const fenced place[] = {place_for(fences.number, fits, sizeof number[0]), place_for(fences.bits, fits, sizeof bits[0]),
                                place_for(fences.inside, fits, sizeof inside[0])};
        size_t found = SIZE_MAX;
        tribox_report report = {0, 0};
        say("tribox_index_words", options, rooms[k]);
        assert_int_equal(tribox_index_words(&stored.index, &(tribox_region){.box = box}, options, rooms[k], numbers_of(place[0]),
                                            words_of(place[1]), words_of(place[2]), &found, &report),
                         TRIBOX_OK);
        demand_found(found, expected);
        demand_part(&place[0], number);
        demand_part(&place[1], bits);
        demand_part(&place[2], inside);
        size_t overlapping = 0;
        for (size_t w = 0; w < expected; w++)
            overlapping += (size_t)__builtin_popcountll(bits[w]);
        assert_int_equal(report.overlapping, overlapping);
    }
    size_t found = SIZE_MAX;
    assert_int_equal(tribox_index_words(&stored.index, &(tribox_region){.box = box}, options, 0, NULL, NULL, NULL, &found, NULL),
                     TRIBOX_OK);
    assert_true(options->accuracy == TRIBOX_FAST ? found <= expected : found == expected);
}

static void check_list(const tribox_box *box, const tribox_options *options, const uint32_t *ids)
{
    static uint32_t list[TRIANGLES];
    size_t expected = 0, rooms[ROOMS];
    assert_int_equal(tribox_index_list(ids ? &stored.with_ids : &stored.index, &(tribox_region){.box = box}, options, TRIANGLES,
                                       list, &expected),
                     TRIBOX_OK);
    rooms_about(expected, TRIANGLES, rooms);
    for (size_t k = 0; k < ROOMS; k++) {
        const fenced place = place_for(fences.list, less(rooms[k], expected), sizeof list[0]);
        size_t found = SIZE_MAX;
        say("tribox_index_list", options, rooms[k]);
        assert_int_equal(tribox_index_list(ids ? &stored.with_ids : &stored.index, &(tribox_region){.box = box}, options, rooms[k],
                                           rooms[k] ? numbers_of(place) : NULL, &found),
                         TRIBOX_OK);
        demand_found(found, expected);
        demand_part(&place, list);
    }
}

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

static void check_lists_rooms(const tribox_boxes *boxes, const tribox_options *options)
{
    static uint32_t list[LISTED];
    size_t begins[BOXES + 1], rooms[ROOMS];
    assert_int_equal(tribox_index_lists(&stored.with_ids, boxes, options, LISTED, list, begins), TRIBOX_OK);
    rooms_about(begins[boxes->count], LISTED, rooms);
    for (size_t k = 0; k < ROOMS + boxes->count; k++) {
        const size_t room = k < ROOMS ? rooms[k] : begins[k - ROOMS];
        const fenced place = place_for(fences.list, less(room, begins[boxes->count]), sizeof list[0]);
        const fenced start = fenced_place(fences.start, (boxes->count + 1) * sizeof(size_t), AT_END);
        say("tribox_index_lists", options, room);
        assert_int_equal(
            tribox_index_lists(&stored.with_ids, boxes, options, room, room ? numbers_of(place) : NULL, (size_t *)(void *)start.at),
            TRIBOX_OK);
        demand_part(&place, list);
        demand_part(&start, begins);
    }
}

CASE(test_rooms)
{
    static const size_t counts[] = {0, 1, 64, 100, 4096, 4097, TRIANGLES};
    random_source r = random_named(args.seed, "rooms");
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++)
        for (size_t turn = 0; turn < 3 * (size_t)kernels; turn++) {
            const tribox_options options = {.accuracy = (tribox_accuracy)(turn % 3), .kernel = names[turn / 3]};
            tribox_box box[BOXES];
            stored_soup_lay(&stored, counts[c], STORED_AT_END);
            draw_cells(&r, &stored);
            spoil_soup(&r, &stored, turn % 2 ? DIRT_ONE : DIRT_NONE);
            stored_soup_build(&stored, options.kernel);
            for (int b = 0; b < BOXES; b++) {
                box[b] = draw_box(&r, &stored);
                check_words(&box[b], &options);
                check_list(&box[b], &options, b % 2 ? stored.ids : NULL);
            }
            const tribox_boxes boxes = streams_of(box, BOXES);
            check_lists_rooms(&boxes, &options);
        }
}

/* Boxes that are empty on an axis, by much or by an ulp, flat, or a point; about triangles that other boxes there would find. */
CASE(test_thin_boxes)
{
    random_source r = random_named(args.seed, "thin boxes");
    for (int k = 0; k < kernels; k++) {
        stored_soup_lay(&stored, 4200, STORED_AT_END);
        draw_cells(&r, &stored);
        stored_soup_build(&stored, names[k]);
        const tribox_box all = bounds_of(&stored, 0, stored.soup.count);
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
                check_forms(&fences, &stored, &box, &options, "thin boxes");
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
            stored_soup_lay(&stored, 300, STORED_AT_END);
            draw_cells(&r, &stored);
            stored_soup_build(&stored, names[k]);
            for (int b = 0; b < BOXES; b++) {
                box[b] = bounds_of(&stored, 0, 300);
                double *const bound = kind < 15 ? box[b].lo : box[b].hi;
                if (random_int(&r, 2))
                    bound[kind % 3] = kind / 3 % 5 < 4 ? bad[kind / 3 % 5] : kind < 15 ? INFINITY : -INFINITY;
                if (random_int(&r, 4) == 0)
                    box[b].lo[kind % 3] = nextafterf((float)box[b].hi[kind % 3], INFINITY);
            }
            for (size_t count = 0; count <= BOXES; count++) {
                const tribox_boxes boxes = streams_of(box, count);
                check_lists(&fences, &stored, &boxes,
                            &(tribox_options){.accuracy = (tribox_accuracy)(count % 3), .kernel = names[k]}, "cells");
            }
        }
}

PROGRAM_AFTER(make_all, RUN(test_rooms), RUN(test_thin_boxes), RUN(test_boxes_without_lists))
