/* ask.h - what the correctness tests share: calls whose answers are checked, and a failure that prints everything. */
#ifndef TRIBOX_TESTS_ASK_H
#define TRIBOX_TESTS_ASK_H

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernels_here.h"
#include "oracle.h"
#include "tribox.h"
#include "window_bits.h"

enum { ORDERS = 6, AXIS_SETS = 7 };

/* The six orders of three things: of the groups of axes in a call (order_digits), and of vertices or coordinates. */
extern const int permutations[ORDERS][3];
unsigned order_digits(int permutation);

/* Where a wrong answer was given. */
typedef struct origin {
    const char *scene; /* or the name of the test */
    uint64_t seed;
    const char *function; /* of the library */
    tribox_options options;
} origin;

/* Fails the test at hand: prints where, the pair and its thirteen axes. */
void fail_pair(const origin *where, const pair_f64 *pair, bool answer);

/*
 * The library's answers for `count` triangles and one box, and for one triangle and `count` boxes. What holds for every call is
 * checked on the way: the status, the bits past the count and the numbers in the report.
 */
void ask_soup(const tribox_soup *soup, const tribox_box *box, const tribox_options *options, uint64_t *mask);
void ask_mesh(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options, uint64_t *mask);
void ask_boxes(const float *triangle, const tribox_boxes *boxes, const tribox_options *options, uint64_t *mask);

#endif
