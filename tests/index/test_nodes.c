/*
 * test_nodes.c - counts about 64, 64^2 and 64^3, where words, nodes and levels of nodes begin: NaN and infinity in every part of
 * them, boxes with each of them wholly inside, memory of exactly that length at any alignment.
 */
#include "common/harness.h"
#include "hostile.h"
#include "forms.h"

static const size_t counts[] = {0,    1,    2,    63,   64,    65,    127,        128,    129,       4031,
                                4095, 4096, 4097, 8191, 12345, 65535, 262144 - 1, 262144, 262144 + 1};
enum { COUNTS = sizeof counts / sizeof counts[0], COUNT_MAX = 262144 + 1, BOXES = 12, BOXES_OF_MANY = 5 };

static int make_all(void) { return index_fixture_make(COUNT_MAX, 1); }

static void draw(random_source *r, size_t count, dirt kind, int shift)
{
    stored_soup_lay(count, shift);
    draw_cells(r);
    spoil_soup(r, kind);
    stored_build(names[random_int(r, kernels)]);
}

/* With all kernels and accuracies in turn, as a soup of all counts times all of them would take minutes. */
static void check(const tribox_box *box, size_t turn)
{
    const tribox_options options = {.accuracy = (tribox_accuracy)(turn % 3), .kernel = names[turn / 3 % (size_t)kernels]};
    check_forms(box, &options, "cells");
}

/* Every count, with every kind of dirt; the long ones with one kind each. */
CASE(test_counts)
{
    const size_t boxes_of_many = arguments_are_short(&args) ? 2 : BOXES_OF_MANY;
    for (size_t c = 0; c < COUNTS; c++) {
        random_source r = random_named(args.seed, "counts");
        const bool is_long = counts[c] > 2 * TRIBOX_INDEX_BLOCK;
        for (int kind = is_long ? (int)c % DIRTS : 0; kind < (is_long ? (int)c % DIRTS + 1 : DIRTS); kind++) {
            draw(&r, counts[c], (dirt)kind, kind % 2 ? STORED_AT_END : kind);
            for (size_t b = 0; b < (is_long ? boxes_of_many : BOXES); b++) {
                const tribox_box box = draw_box(&r);
                check(&box, b);
            }
        }
    }
}

/* Boxes about the whole soup, about all but its last triangles, and about one node or word of it, the last ones too. */
static void check_parts(size_t count)
{
    const size_t sizes[] = {count, count - 1, count - count % 64, count - count % TRIBOX_INDEX_BLOCK, TRIBOX_INDEX_BLOCK, 64, 1};
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
        const tribox_box box = bounds_of(0, sizes[k]), last = bounds_of(count - 1 - (count - 1) % 64, sizes[k]);
        check(&box, k);
        check(&last, k + 1);
    }
}

/* Each kind of dirt in nodes, and in nodes of nodes, that would be wholly inside without it. */
CASE(test_dirt)
{
    for (size_t kind = 0; kind < DIRTS; kind++) {
        random_source r = random_named(args.seed, "dirt");
        draw(&r, kind % 2 ? 2 * TRIBOX_INDEX_BLOCK : TRIBOX_INDEX_BLOCK + 100, (dirt)kind, STORED_AT_END);
        check_parts(stored.soup.count);
        draw(&r, kind % 2 ? COUNT_MAX : 64 * TRIBOX_INDEX_BLOCK - 64, (dirt)kind, STORED_AT_END);
        const tribox_box all = bounds_of(0, stored.soup.count), most = bounds_of(5000, 200000);
        check(&all, kind);
        check(&most, kind + 5);
    }
}

/* One triangle that is not finite, in each of the places of a word, and of the last word of a soup. */
CASE(test_dirt_in_a_word)
{
    random_source r = random_named(args.seed, "dirt in a word");
    for (size_t count = 64; count <= 200; count += 17)
        for (size_t at = 0; at < count; at += 1 + at / 64) {
            draw(&r, count, DIRT_NONE, STORED_AT_END);
            const tribox_box box = bounds_of(0, count);
            spoil_triangle(&r, at);
            stored_build(names[at % (size_t)kernels]);
            check(&box, at);
        }
}

/* The index at every place beside an aligned one, and so the streams. */
CASE(test_alignment)
{
    random_source r = random_named(args.seed, "alignment");
    for (int shift = 0; shift < STORED_SHIFTS; shift++)
        for (int k = 0; k < kernels; k++) {
            draw(&r, 5000, DIRT_ONE, shift);
            const tribox_box box = draw_box(&r);
            check(&box, (size_t)(3 * k + shift % 3));
        }
}

CASE(test_bytes)
{
    size_t last = tribox_index_bytes(0);
    assert_int_equal(last, tribox_index_bytes(1));
    assert_in_range(last, 1600, 4096);
    for (size_t count = 1; count <= 300000; count += count < 10000 ? 1 : 63) {
        const size_t bytes = tribox_index_bytes(count);
        if (bytes < last)
            fail_msg("%zu triangles take less than fewer do", count);
        if (count >= 100000 && (double)bytes > 0.012 * 36 * (double)count)
            fail_msg("%zu triangles take %zu bytes", count, bytes);
        last = bytes;
    }
    for (size_t count = 300000; count < SIZE_MAX / 2; count *= 2) {
        assert_true(tribox_index_bytes(count) >= last);
        last = tribox_index_bytes(count);
    }
    assert_true(tribox_index_bytes(SIZE_MAX) >= last);
}

PROGRAM_AFTER(make_all, RUN(test_counts), RUN(test_dirt), RUN(test_dirt_in_a_word), RUN(test_alignment), RUN(test_bytes))
