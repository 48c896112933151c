/* index_measure.h - measures all there is to know of an index over one soup. */
#ifndef BENCH_INDEX_MEASURE_H
#define BENCH_INDEX_MEASURE_H

#include "index_results.h"
#include "paper/random.h"

typedef struct index_effort {
    uint64_t rounds;
    uint64_t boxes; /* of each size */
    uint64_t many;  /* boxes of a call about many */
    uint64_t seed;
    size_t evicted; /* bytes that are read to empty the caches */
    const char *kernel;
} index_effort;

/* False, with a message, if memory fails or an answer is wrong: then nothing is worth timing. */
bool index_measure(const index_scene *scene, const index_effort *how, generator *order, scene_result *r);

#endif
