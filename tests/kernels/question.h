/* question.h - a question in either form, many triangles and one box or one triangle and many boxes, asked by the same lines. */
#ifndef TRIBOX_TESTS_QUESTION_H
#define TRIBOX_TESTS_QUESTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "tribox.h"

enum { SOUP_STREAMS = 9, BOXES_STREAMS = 6 };

/* The same order of streams in both forms: by axis, then by vertex; lo, then hi. */
typedef struct question {
    const float *stream[SOUP_STREAMS];
    size_t count;
    const tribox_box *box;      /* of a soup; NULL for boxes */
    const float (*triangle)[3]; /* of boxes; NULL for a soup */
} question;

int question_streams(const question *q);

tribox_soup question_soup(const question *q);

/* Pair i alone: a question of count 1. */
question question_at(const question *q, size_t i);

tribox_status question_ask(const question *q, const tribox_options *options, uint64_t *mask, tribox_report *report);

/* What is asked of what, in one line: call, kernel, accuracy, axes, order, count. */
enum { QUESTION_TEXT = 160 };
const char *question_text(const question *q, const tribox_options *options, char text[QUESTION_TEXT]);

/* Fails with the pair in hexadecimal floats: one bit is not what it should be. */
void fail_at_pair(const question *q, const tribox_options *options, size_t i, bool expected);

/* Every word, bits past count included. */
void assert_masks_equal(const question *q, const tribox_options *options, const uint64_t *expected, const uint64_t *mask);

/* Asks, expects TRIBOX_OK. */
void ask_ok(const question *q, const tribox_options *options, uint64_t *mask, tribox_report *report);

static inline bool mask_bit(const uint64_t *mask, size_t i) { return mask[i / 64] >> i % 64 & 1; }

size_t mask_population(const uint64_t *mask, size_t count);

#endif
