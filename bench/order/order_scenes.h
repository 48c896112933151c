/* order_scenes.h - the scenes of the order sweep: seeded, of any number of triangles. */
#ifndef BENCH_ORDER_SCENES_H
#define BENCH_ORDER_SCENES_H

#include "timing/work.h"

size_t order_scene_count(void);
const char *order_scene_name(size_t index);
const char *order_scene_what(size_t index);

/* Makes a scene of `count` pairs, nearly so for an octree; false, with a message on stderr, if that fails. */
bool order_scene_make(size_t index, size_t count, uint64_t seed, timing_work *work);

/* The leaves of an octree of a mesh file, a part of them with `count` pairs; false, with a message on stderr, if that fails. */
bool order_scene_of_mesh(const char *path, size_t count, timing_work *work);

#endif
