/* plane_scene.h - the planes of a grid as a scene: a triangle each, so large that no ray within mesh and grid nears its border. */
#ifndef TRIBOX_TESTS_PLANE_SCENE_H
#define TRIBOX_TESTS_PLANE_SCENE_H

#include "embree.h"
#include "embree_planes.h"

typedef struct plane_scene {
    embree_scene *scene;
    int first[3]; /* the triangle that is plane 0 of an axis */
} plane_scene;

plane_scene plane_scene_make(const grid_planes *p, const model *s);
void plane_scene_free(plane_scene *d);

/* The plane that a triangle of the scene is. */
int plane_scene_axis(const plane_scene *d, unsigned number);
int plane_scene_plane(const plane_scene *d, unsigned number);

#endif
