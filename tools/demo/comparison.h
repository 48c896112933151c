/* comparison.h - the paper's test and every kernel on a scene of tribox demo. */
#ifndef DEMO_COMPARISON_H
#define DEMO_COMPARISON_H

#include "console/json.h"
#include "scene.h"
#include "timing/measure.h"
#include "timing/verify.h"

typedef struct comparison {
    const scene *at;
    size_t count;
    contestant list[CONTESTANTS_MAX]; /* the paper's test first */
    score scores[CONTESTANTS_MAX];
    samples taken;
} comparison;

/* Verifies everyone, then times that many rounds. Returns an exit_code. */
int comparison_make(const scene *at, size_t rounds, comparison *c);

/* Prints a table with the columns of two scenes beside each other. */
void comparison_print(const comparison c[2]);

/* Prints a scene as a value of the array that is open. */
void comparison_print_json(json *to, const comparison *c);

#endif
