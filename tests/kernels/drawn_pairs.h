/* drawn_pairs.h - pairs, many triangles and one box or one triangle and many boxes, drawn from the scenes, and asked about. */
#ifndef TRIBOX_TESTS_DRAWN_PAIRS_H
#define TRIBOX_TESTS_DRAWN_PAIRS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/scenes.h"
#include "common/window_bits.h"
#include "tribox.h"

enum { SOUP_STREAMS = 9, BOXES_STREAMS = 6 };

/* In either form, for the same test; the same order of streams in both: by axis, then by vertex; lo, then hi. */
typedef struct pair_list {
    const float *stream[SOUP_STREAMS];
    size_t count;
    const tribox_box *box;      /* of a soup; NULL for boxes */
    const float (*triangle)[3]; /* of boxes; NULL for a soup */
} pair_list;

int pair_list_streams(const pair_list *q);

tribox_soup pair_list_soup(const pair_list *q);

/* Pair i alone. */
pair_list pair_list_at(const pair_list *q, size_t i);

tribox_status pair_list_overlap(const pair_list *q, const tribox_options *options, uint64_t *mask, tribox_report *report);

/* What is asked of what, in one line: call, kernel, accuracy, axes, order, count. */
enum { PAIR_LIST_TEXT = 160 };
const char *pair_list_text(const pair_list *q, const tribox_options *options, char text[PAIR_LIST_TEXT]);

/* Fails with the pair in hexadecimal floats: one bit is not what it should be. */
void fail_at_pair(const pair_list *q, const tribox_options *options, size_t i, bool expected);

/* Every word, bits past count included. */
void assert_masks_equal(const pair_list *q, const tribox_options *options, const uint64_t *expected, const uint64_t *mask);

/* Asks, expects TRIBOX_OK. */
void ask_ok(const pair_list *q, const tribox_options *options, uint64_t *mask, tribox_report *report);

enum { DRAWN_MAX = 10240, DRAWN_WORDS = DRAWN_MAX / 64 };

/* The numbers that a list of pairs points to. */
typedef struct drawn_numbers {
    float stream[SOUP_STREAMS][DRAWN_MAX];
    tribox_box box;
    float triangle[3][3];
} drawn_numbers;

/* The first numbers as a soup beside a box; or those for boxes, if it is NULL, beside a triangle. */
pair_list pairs_over(const drawn_numbers *numbers, size_t count, const tribox_box *box, const float (*triangle)[3]);

/* One batch of a scene: its triangles against its box, or one of its triangles against boxes made from its box. */
pair_list draw_pairs(random_source *r, const scene *s, bool is_soup, drawn_numbers *numbers);

/*
 * DRAWN_MAX pairs about the box of the paper, as different from lane to lane as can be. Zeros overlap: the box holds the origin,
 * and so does the triangle. A zero past the end of a stream therefore shows.
 */
pair_list draw_distinct_lanes(random_source *r, bool is_soup, drawn_numbers *numbers);

#endif
