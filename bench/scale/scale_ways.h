/* scale_ways.h - a soup into the cells of a grid: as dense bits, as bricks that are kept, or counted alone. */
#ifndef BENCH_SCALE_WAYS_H
#define BENCH_SCALE_WAYS_H

#include <stdbool.h>

#include "tribox.h"

/* Dense: from calloc, or on large pages. */
typedef enum scale_way { WAY_DENSE, WAY_LARGE, WAY_KEPT, WAY_COUNTED, WAYS } scale_way;

typedef struct scale_question {
    const tribox_soup *soup;
    tribox_grid grid;
    uint32_t tile;
    tribox_options options;
} scale_question;

/* Processor time and memory are those of the answer alone: bricks of dense bits are found when these are known. */
typedef struct scale_answer {
    double seconds, listing; /* all, and what of it lists of triangles take */
    double megabytes;        /* at the most, beyond what the process had */
    size_t pairs;            /* of triangle and tile */
    uint64_t cells, bricks;
    uint64_t sum; /* of all bricks, in any order */
} scale_answer;

/* Answers in a process of its own. False, with a line on standard error, where there is no memory, or the grid is refused. */
bool scale_answer_find(scale_way way, const scale_question *question, scale_answer *answer);

#endif
