/* order_sweep.h - every order and every choice of axes, on every kernel, against each other. */
#ifndef ORDER_SWEEP_H
#define ORDER_SWEEP_H

#include "timing/measure.h"
#include "timing/verify.h"

enum { SWEEP_ORDERS = 7, SWEEP_ACCURACIES = 3, SWEEP_AXES = 6, SWEEP_ROUNDS = 32 };

/* The order that tribox finds as it goes. */
enum { SWEEP_DEFAULT = 0 };

/* Contestants, what they answered, and their times. */
typedef struct sweep {
    size_t count;
    contestant list[CONTESTANTS_MAX]; /* without a kernel: the paper's test */
    score scores[CONTESTANTS_MAX];
    samples taken;
} sweep;

extern const unsigned sweep_orders[SWEEP_ORDERS];                /* the default, then the fixed ones */
extern const tribox_accuracy sweep_accuracies[SWEEP_ACCURACIES]; /* fast, conservative, exact */

/* The choices of axes that leave something out, cheapest tests first. */
extern const unsigned sweep_axes[SWEEP_AXES];

/*
 * Enters the paper's test in every fixed order and, for each kernel, all axes in every order at every accuracy, and every choice of
 * axes in the default order at EXACT. Verifies and times them. Returns NULL, or what is wrong, in a text that lasts until the next
 * call.
 */
const char *sweep_run(sweep *s, const timing_work *work, effort how, generator *turns);

/* The contestant with these options, or NULL. A kernel of NULL is the paper's test, whose accuracy is FAST and order fixed. */
const contestant *sweep_find(const sweep *s, const char *kernel, tribox_accuracy accuracy, unsigned axes, unsigned order);

const score *sweep_score(const sweep *s, const contestant *of);

/* Nanoseconds per pair: the least of the rounds, since other work on the machine only ever adds to a time. */
double sweep_time(const sweep *s, const contestant *of);

/* Whether one is faster than another beyond the spread: by 1 % in the least time, and in three quarters of the rounds. */
bool sweep_beats(const sweep *s, const contestant *one, const contestant *other);

/* The fixed order of all axes with the least time. */
const contestant *sweep_best(const sweep *s, const char *kernel, tribox_accuracy accuracy);

#endif
