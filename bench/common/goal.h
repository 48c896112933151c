/* goal.h - what a benchmark set out to reach, against what this run did. */
#ifndef BENCH_GOAL_H
#define BENCH_GOAL_H

#include <stdbool.h>

typedef struct goal {
    const char *what;
    bool is_most; /* the goal is the most that it may be, not the least that it should be */
    double goal, reached;
} goal;

bool goal_is_reached(const goal *g);

/* A line of a table. */
void goal_print(const goal *g);

#endif
