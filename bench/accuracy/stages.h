/* stages.h - EXACT and CONSERVATIVE in stages: float walks, then double, then integers. Who settles how much, and at what cost? */
#ifndef BENCH_STAGES_H
#define BENCH_STAGES_H

#include "common/measure.h"

enum { WIDTH_INT64, WIDTH_INT128, WIDTH_LIMBS, WIDTHS };

/** Times are the least in nanoseconds, NAN where nothing comes so far, or too little to be timed. */
typedef struct stages {
    size_t pairs;          /* triangles against boxes: those in whole words of the soup */
    size_t left_by_float;  /* of them, what the walk leaves to the double stage */
    size_t left_by_double; /* of these, what it leaves: integers decide them, or CONSERVATIVE reports them */
    double walk;           /* for a triangle: the walk alone */
    double settle;         /* for a pair that the walk leaves: to gather it, decide it in double, put its bit */
    double in_double;      /* for such a pair: the decision alone, gathered already */
    double integers;       /* for a pair that double leaves, in the narrowest integers that hold its numbers */
    double width[WIDTHS];  /* the same in integers of each width, of the pairs that fit into it */
} stages;

/**
 * Takes a kernel apart, on scenes that share a soup. `options` name the kernel, the accuracy (not FAST) and the axes.
 * False, with a message on stderr, if memory fails.
 */
bool stages_measure(const tribox_options *options, const scene *at, size_t scenes, size_t rounds, generator *g, stages *found);

#endif
