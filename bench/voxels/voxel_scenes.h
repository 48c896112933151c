/* voxel_scenes.h - soups to voxelize: mesh files, and three that need none. */
#ifndef BENCH_VOXEL_SCENES_H
#define BENCH_VOXEL_SCENES_H

#include <stdbool.h>

#include "tribox.h"

typedef struct voxel_scene {
    char name[64];
    tribox_soup soup;
    float (*triangles)[3][3]; /* the same, one after the other */
    void *storage;
} voxel_scene;

enum { VOXEL_SCENES = 3 };

/* torus: 200,000 triangles of a surface; small: as many anywhere, a hundredth of the whole long; huge: twelve across the whole. */
bool voxel_scene_make(int which, uint64_t seed, voxel_scene *made);

/* A mesh file; false, with a message on stderr, if it cannot be read. */
bool voxel_scene_read(const char *path, voxel_scene *made);

void voxel_scene_free(voxel_scene *made);

/* The grid of `resolution` cubes along the longest side of the soup's box. */
tribox_grid voxel_scene_grid(const voxel_scene *scene, uint32_t resolution);

#endif
