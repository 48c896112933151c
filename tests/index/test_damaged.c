/*
 * test_damaged.c - an index of random bytes, with flipped bits, or of another soup of as many triangles: nothing is read outside,
 * and answers may be wrong but are answers. A copy anywhere answers as the index does.
 */
#include "common/harness.h"
#include "common/fences.h"
#include "hostile.h"
#include "forms.h"

enum { COUNT_MAX = 9000, WORDS = (COUNT_MAX + 63) / 64, BOXES = 4, PAIRS = 100000, ROUNDS = 300 };

static bool is_lattice; /* oriented boxes about others take long */

static int make_all(void) { return index_fixture_make(COUNT_MAX, BOXES); }

static void say(const char *form, const tribox_options *options)
{
    snprintf(doing, sizeof doing, "%s: damaged index of %zu triangles, kernel %s, accuracy %d", form, stored.soup.count,
             options->kernel, (int)options->accuracy);
}

static void demand(bool holds, const char *what)
{
    if (!holds)
        fail_msg("%s: %s", doing, what);
}

static size_t population(const uint64_t *mask, size_t words)
{
    size_t bits = 0;
    for (size_t w = 0; w < words; w++)
        bits += (size_t)__builtin_popcountll(mask[w]);
    return bits;
}

static bool has_bits_past_count(uint64_t bits, size_t word)
{
    const size_t left = stored.soup.count - 64 * word;
    return left < 64 && bits >> left;
}

static void check_mask(const tribox_box *box, const tribox_options *options)
{
    const size_t words = tribox_mask_words(stored.soup.count);
    const fenced place = fenced_place(fences.mask, words * sizeof(uint64_t), AT_END);
    const uint64_t *const mask = (const uint64_t *)(const void *)place.at;
    tribox_report report = {SIZE_MAX, SIZE_MAX}, again = report;
    say("tribox_index_overlap", options);
    demand(!tribox_index_overlap(&stored.index, &(tribox_region){.box = box}, options, (uint64_t *)(void *)place.at, &report),
           "refused");
    demand(report.overlapping == population(mask, words) && report.undecided <= stored.soup.count, "another report");
    demand(!words || !has_bits_past_count(mask[words - 1], words - 1), "bits past the count");
    assert_nothing_beside(&place);
    demand(!tribox_index_overlap(&stored.index, &(tribox_region){.box = box}, options, NULL, &again), "refused");
    demand(again.overlapping == report.overlapping, "counts otherwise than it marks");
}

static void check_words(const tribox_box *box, const tribox_options *options, size_t room)
{
    static uint32_t number[WORDS];
    static uint64_t bits[WORDS], inside[WORDS];
    const size_t words = tribox_mask_words(stored.soup.count);
    size_t found = SIZE_MAX;
    say("tribox_index_words", options);
    demand(!tribox_index_words(&stored.index, &(tribox_region){.box = box}, options, room, number, bits, inside, &found, NULL),
           "refused");
    demand(found <= words, "more words than there are");
    for (size_t k = 0; k < (found < room ? found : room); k++) {
        demand(number[k] < words && (!k || number[k] > number[k - 1]), "numbers of words that are none, or not in order");
        demand(bits[k] && !(inside[k] & ~bits[k]) && !has_bits_past_count(bits[k], number[k]), "bits that cannot be");
    }
}

static void check_list(const tribox_box *box, const tribox_options *options, size_t room)
{
    static uint32_t list[COUNT_MAX], with_ids[COUNT_MAX];
    size_t found = SIZE_MAX, again = SIZE_MAX;
    say("tribox_index_list", options);
    demand(!tribox_index_list(&stored.index, &(tribox_region){.box = box}, options, room, list, &found), "refused");
    demand(!tribox_index_list(&stored.with_ids, &(tribox_region){.box = box}, options, room, with_ids, &again), "refused");
    demand(found == again && found <= stored.soup.count, "more triangles than there are");
    for (size_t k = 0; k < (found < room ? found : room); k++) {
        demand(list[k] < stored.soup.count && (!k || list[k] > list[k - 1]), "triangles that are none, or not in order");
        demand(with_ids[k] == stored.ids[list[k]], "numbers of other triangles");
    }
}

static void check_any(const tribox_box *box, const tribox_options *options)
{
    size_t triangle = SIZE_MAX;
    say("tribox_index_any", options);
    demand(!tribox_index_any(&stored.index, &(tribox_region){.box = box}, options, &triangle), "refused");
    demand(triangle <= stored.soup.count, "a triangle that is none");
}

static void check_oriented(const tribox_box *box, tribox_options options)
{
    static uint32_t list[COUNT_MAX];
    tribox_oriented_box oriented = {{0, 0, 0}, {0, 0, 0}, {{1, 0.25f, 0}, {-0.25f, 1, 0}, {0, 0, 1}}};
    for (int a = 0; a < 3; a++) {
        oriented.center[a] = (float)box->lo[a] / 2 + (float)box->hi[a] / 2;
        oriented.half[a] = (float)box->hi[a] / 2 - (float)box->lo[a] / 2;
    }
    options.axes = 0;
    options.accuracy = TRIBOX_FAST;
    tribox_report report = {SIZE_MAX, SIZE_MAX};
    size_t found = SIZE_MAX;
    say("tribox_index_list_oriented", &options);
    demand(!tribox_index_overlap(&stored.index, &(tribox_region){.oriented = &oriented}, &options, NULL, &report), "refused");
    demand(!tribox_index_list(&stored.index, &(tribox_region){.oriented = &oriented}, &options, COUNT_MAX, list, &found),
           "refused");
    demand(found <= stored.soup.count && found == report.overlapping, "more triangles than there are");
    for (size_t k = 0; k < found; k++)
        demand(list[k] < stored.soup.count && (!k || list[k] > list[k - 1]), "triangles that are none, or not in order");
}

static void check_all(random_source *r)
{
    for (int b = 0; b < BOXES; b++) {
        const tribox_box box = draw_box(r, &stored);
        const tribox_options options = any_index_options(r);
        check_mask(&box, &options);
        check_words(&box, &options, random_int(r, 2) ? WORDS : random_below(r, WORDS));
        check_list(&box, &options, random_int(r, 2) ? COUNT_MAX : random_below(r, COUNT_MAX));
        check_any(&box, &options);
        if (is_lattice)
            check_oriented(&box, options);
    }
}

static void draw(random_source *r)
{
    static const int most[] = {1, 64, 300, 4096, 4200, COUNT_MAX};
    const size_t count = (size_t)random_int(r, 1 + most[random_int(r, sizeof most / sizeof most[0])]);
    stored_soup_lay(&stored, count, random_int(r, 2) ? STORED_AT_END : random_int(r, STORED_SHIFTS));
    const size_t kind = random_below(r, soup_kind_count());
    is_lattice = kind == 0;
    soup_kind_at(kind)->draw(r, &stored);
    spoil_soup(r, &stored, random_int(r, 2) ? DIRT_NONE : (dirt)random_int(r, DIRTS));
    stored_soup_build(&stored, any_index_options(r).kernel);
}

CASE(test_random_bytes)
{
    random_source r = random_named(args.seed, "random bytes");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw(&r);
        const int kind = random_int(&r, 4);
        for (size_t k = 0; k < stored_index_bytes(&stored); k++)
            stored.nodes[k] = kind == 0 ? 0xff : kind == 1 ? 0 : (unsigned char)random_int(&r, 256);
        check_all(&r);
    }
}

CASE(test_flipped_bits)
{
    random_source r = random_named(args.seed, "flipped bits");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw(&r);
        for (int times = 1 << random_int(&r, 12); times > 0; times--)
            stored.nodes[random_below(&r, stored_index_bytes(&stored))] ^= (unsigned char)(1 << random_int(&r, 8));
        check_all(&r);
    }
}

/* Every child is said to be everywhere and whole: nodes and words past the last are still not there. */
CASE(test_all_inside)
{
    enum { BOUNDS = 6 * 64, NODE = BOUNDS * sizeof(float) + 64 };
    random_source r = random_named(args.seed, "all inside");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw(&r);
        const float bounds[2] = {random_int(&r, 2) ? 0 : -1, random_int(&r, 2) ? 0 : 1};
        for (size_t node = 0; node < stored_index_bytes(&stored) / NODE; node++) {
            for (size_t k = 0; k < BOUNDS; k++)
                memcpy(stored.nodes + node * NODE + k * sizeof(float), &bounds[k >= BOUNDS / 2], sizeof(float));
            memset(stored.nodes + node * NODE + BOUNDS * sizeof(float), random_int(&r, 3) ? 0xff : 0, sizeof(uint64_t));
        }
        for (int k = 0; k < 9; k++)
            for (size_t i = 0; i < stored.soup.count; i++)
                stored.stream[k][i] = (float)(i % 3) - 1;
        is_lattice = true;
        check_all(&r);
    }
}

CASE(test_another_soup)
{
    random_source r = random_named(args.seed, "another soup");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw(&r);
        const size_t kind = random_below(&r, soup_kind_count());
        is_lattice = kind == 0;
        soup_kind_at(kind)->draw(&r, &stored);
        check_all(&r);
    }
}

/* The original is gone when the copy is asked. */
CASE(test_copies)
{
    random_source r = random_named(args.seed, "copies");
    const guarded elsewhere = guarded_make(tribox_index_bytes(COUNT_MAX) + STORED_SHIFTS);
    for (int shift = 0; shift < STORED_SHIFTS; shift++) {
        draw(&r);
        const size_t bytes = stored_index_bytes(&stored);
        stored.index.nodes = stored.with_ids.nodes =
            memcpy(shift % 3 ? elsewhere.first + shift : guarded_tail(elsewhere, bytes), stored.nodes, bytes);
        memset(stored.nodes, 0, bytes);
        guarded_read_only(elsewhere, true);
        for (int b = 0; b < 3 * BOXES; b++) {
            const tribox_box box = draw_box(&r, &stored);
            const tribox_options options = any_index_options(&r);
            check_forms(&fences, &stored, &box, &options, "a copy");
        }
        guarded_read_only(elsewhere, false);
    }
    guarded_free(elsewhere);
}

PROGRAM_AFTER(make_all, RUN(test_random_bytes), RUN(test_flipped_bits), RUN(test_all_inside), RUN(test_another_soup),
              RUN(test_copies))
