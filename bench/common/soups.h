/* soups.h - seeded soups, each with a box to test against. The order of the list is the order of the reports. */
#ifndef BENCH_SOUPS_H
#define BENCH_SOUPS_H

#include "timing/timing.h"

typedef struct scene {
    const char *name;
    const char *what; /* in a few words, for reports */
    timing_work work; /* one job; of a mesh one for each cell */
} scene;

size_t scene_count(void);

/* Not made for the order of the axes alone. */
bool scene_is_usual(size_t index);

/* Finds a scene by its name. False, with a list of the scenes on stderr, if there is none of that name. */
bool scene_find(const char *name, size_t *index);

/* Makes a scene; false, with a message on stderr, if memory or the library fails. */
bool scene_make(size_t index, uint64_t seed, scene *made);

void scene_free(scene *made);

#endif
