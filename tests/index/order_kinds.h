/* order_kinds.h - soups to be put in order, and where that is done: streams, scratch and order, each ending at a page. */
#ifndef TRIBOX_TESTS_ORDER_KINDS_H
#define TRIBOX_TESTS_ORDER_KINDS_H

#include <stdint.h>

#include "common/guard.h"
#include "common/random_draws.h"
#include "tribox.h"

/* Half of the last kinds' triangles, or all of them, have a number that is NaN or infinite. */
typedef enum order_kind {
    KIND_RANDOM,
    KIND_SORTED,
    KIND_REVERSED,
    KIND_ORGAN_PIPE,
    KIND_SAWTOOTH,
    KIND_EQUAL,
    KIND_FEW_VALUES,
    KIND_ZEROS_OF_BOTH_SIGNS,
    KIND_SUBNORMAL,
    KIND_GREATEST,
    KIND_ALL_SCALES,
    KIND_HALF_WILD,
    KIND_ALL_WILD,
    ORDER_KINDS
} order_kind;

extern const char *const order_kind_names[ORDER_KINDS];

typedef struct order_room {
    guarded stream_fence[9], scratch_fence, order_fence;
    float *stream[9]; /* stream[3 * a + v]: axis a of vertex v */
    float *scratch;
    uint32_t *order;
    tribox_soup soup;
} order_room;

order_room order_room_make(random_source *r, order_kind kind, size_t count);
void order_room_free(order_room *room);

/* The orders that follow from what the header promises, by sorting all anew for each cut. Words are in order of number. */
void expect_order(const tribox_soup *soup, uint32_t *order);

/* Sorts each word by number, those that are not finite after the others: fails if they do not come last. */
void sort_words(const tribox_soup *soup, uint32_t *order);

#endif
