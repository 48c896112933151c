/* order_measure.h - times every order and every choice of axes against each other: interleaved, in a fresh random order each round. */
#ifndef BENCH_ORDER_MEASURE_H
#define BENCH_ORDER_MEASURE_H

#include "order_work.h"
#include "paper/random.h"

enum { SWEEP_KERNELS_MAX = 5, SWEEP_ORDERS = 6, SWEEP_ACCURACIES = 3, SWEEP_AXES = 6 };
enum {
    SWEEP_ENTRANTS_MAX = SWEEP_ORDERS + SWEEP_KERNELS_MAX * (SWEEP_ACCURACIES * SWEEP_ORDERS + SWEEP_AXES),
    SWEEP_ROUNDS_MAX = 32
};

/** One of those that are timed, and what it answered. */
typedef struct entrant {
    tribox_options options; /* without a kernel: the paper's test, order_paper.h, of which only the order counts */
    size_t overlapping;     /* pairs that it reports */
    size_t undecided;       /* as of tribox_report */
    size_t unlike;          /* pairs on which it disagrees with EXACT on all axes */
} entrant;

/** A sweep of one work: ns[e][r] is nanoseconds per pair of entrant e in round r. Pairs of a round were measured close together. */
typedef struct sweep {
    size_t entrants, rounds;
    entrant list[SWEEP_ENTRANTS_MAX];
    double ns[SWEEP_ENTRANTS_MAX][SWEEP_ROUNDS_MAX];
} sweep;

/** The words of an accuracy: "exact", "conservative", "fast". */
const char *sweep_accuracy_word(tribox_accuracy accuracy);

/** A choice of axes as its groups in the default order: "132", "13", "2", ... */
const char *sweep_axes_word(unsigned axes);

extern const unsigned sweep_orders[SWEEP_ORDERS];
extern const unsigned sweep_default_order;
extern const tribox_accuracy sweep_accuracies[SWEEP_ACCURACIES]; /* fast, conservative, exact */

/** The choices of axes that leave something out, cheapest tests first. */
extern const unsigned sweep_axes[SWEEP_AXES];

/**
 * Enters the paper's test in every order and, for each kernel, all axes in every order at every accuracy, and every choice of axes
 * in the default order at EXACT.
 */
void sweep_enter(sweep *s, const char *const *kernels, size_t count);

/**
 * Lets everyone answer once. Returns NULL, or what is wrong: EXACT has to be the same with every kernel and order, CONSERVATIVE to
 * miss nothing, and no order to change an answer of its kernel. Only what answers right is worth timing.
 */
const char *sweep_verify(sweep *s, const order_work *work);

/** Rounds for so many seconds, but `least` at least; one more is run first and not counted. Returns NULL or "out of memory". */
const char *sweep_measure(sweep *s, const order_work *work, double seconds, size_t least, generator *turns);

/** The entrant with these options, or NULL. A kernel of NULL is the paper's test, whose accuracy is FAST. */
const entrant *sweep_find(const sweep *s, const char *kernel, tribox_accuracy accuracy, unsigned axes, unsigned order);

/** Nanoseconds per pair: the least of the rounds, since other work on the machine only ever adds to a time. */
double sweep_time(const sweep *s, const entrant *of);

/** Whether one is faster than another beyond the spread: by 1 % in the least time, and in three quarters of the rounds. */
bool sweep_beats(const sweep *s, const entrant *one, const entrant *other);

/** The order of all axes with the least time. */
const entrant *sweep_best(const sweep *s, const char *kernel, tribox_accuracy accuracy);

#endif
