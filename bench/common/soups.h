/* soups.h - seeded soups, each with a box to test against. The order of the list is the order of the reports. */
#ifndef BENCH_SCENES_H
#define BENCH_SCENES_H

#include <stdbool.h>

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A soup twice over, as tribox and as the baseline want it, and one box twice over: a cube. */
typedef struct scene {
    const char *name;
    const char *what; /* in a few words, for reports */
    tribox_box box;
    float center[3], half[3];       /* of the box, rounded to float */
    tribox_soup soup;               /* the nine streams, one after the other, each on a cache line of its own */
    const float (*triangles)[3][3]; /* the same triangles, in the same order: triangles[i][j][a] is axis a of vertex j */
    void *storage[2];
} scene;

size_t scene_count(void);
const char *scene_name(size_t index);
const char *scene_what(size_t index);

/** Makes a scene; false, with a message on stderr, if memory or the library fails. */
bool scene_make(size_t index, uint64_t seed, scene *made);

void scene_free(scene *made);

#ifdef __cplusplus
}
#endif

#endif
