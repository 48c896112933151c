/* pair_list.h - pairs in either form, many triangles and one box or one triangle and many boxes, for the same test. */
#ifndef TRIBOX_TESTS_PAIR_LIST_H
#define TRIBOX_TESTS_PAIR_LIST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/window_bits.h"
#include "tribox.h"

enum { SOUP_STREAMS = 9, BOXES_STREAMS = 6 };

/* The same order of streams in both forms: by axis, then by vertex; lo, then hi. */
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

#endif
