/* trial.h - the kernels and the paper's algorithm on one scene, timed in turns and compared with the exact answer. */
#ifndef TRIAL_H
#define TRIAL_H

#include "scene.h"

enum { TRIAL_KERNELS_MAX = 5, TRIAL_ACCURACIES = 3, TRIAL_CONTESTANTS_MAX = TRIAL_ACCURACIES * TRIAL_KERNELS_MAX + 1, TRIAL_ROUNDS_MAX = 25 };

typedef struct contestant {
    const char *kernel; /* NULL: the paper's algorithm */
    tribox_accuracy accuracy;
    double seconds[TRIAL_ROUNDS_MAX];
    double median;
    size_t overlapping;
    size_t differing; /* triangles on which it disagrees with the exact answer */
} contestant;

typedef struct trial {
    contestant contestants[TRIAL_CONTESTANTS_MAX];
    int count;
    int rounds;
    uint64_t *exact; /* the mask that the scalar kernel answers, exact */
    uint64_t *mask;  /* where contestants write theirs */
} trial;

/*
 * Lets the paper's algorithm and every kernel that runs here, at each accuracy, test the scene once per round, in a fresh random
 * order each round; a first round is not counted. Returns an exit_code; on success trial_free gives the memory back.
 */
int trial_run(const scene *s, int rounds, trial *t);

void trial_free(trial *t);

#endif
