/* embree.h - a scene of triangles and the rays that cross it. The only place that knows Embree, its version or its absence. */
#ifndef TRIBOX_TESTS_EMBREE_H
#define TRIBOX_TESTS_EMBREE_H

#include "model.h"

#include <stdbool.h>

typedef struct embree_scene embree_scene;

typedef struct embree_hit {
    unsigned triangle;
    float t; /* where on the ray, as Embree rounds it */
} embree_hit;

/* False, with a line that says why, where the cross-check has to be skipped. */
bool embree_is_usable(void);

/* The triangles are copied. */
embree_scene *embree_scene_make(const triangle *triangles, size_t count);
void embree_scene_free(embree_scene *scene);

/* All triangles that the closed ray from + t * along, 0 <= t <= far, meets, in no order. They last until the next cast. */
size_t embree_cast(embree_scene *scene, const float from[3], const float along[3], float far, const embree_hit **hits);

#endif
