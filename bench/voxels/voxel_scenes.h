/* voxel_scenes.h - soups to voxelize: mesh files, and three that need none. */
#ifndef BENCH_VOXEL_SCENES_H
#define BENCH_VOXEL_SCENES_H

#include "timing/work.h"

enum { VOXEL_SCENES = 3 };

/* torus: 200,000 triangles of a surface; small: as many anywhere, a hundredth of the whole long; huge: twelve across the whole. */
extern const char *const voxel_scene_names[VOXEL_SCENES];

/* One job, whose box means nothing. False, with a message, if memory fails or a file cannot be read; timing_work_free follows. */
bool voxel_scene_make(size_t which, uint64_t seed, timing_work *made);
bool voxel_scene_read(const char *path, timing_work *made);

/* The grid of `resolution` cubes along the longest side of the soup's box. */
tribox_grid voxel_scene_grid(const timing_job *at, uint32_t resolution);

#endif
