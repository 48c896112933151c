/* scene.h - the generated scenes of tribox demo: a soup and a box that are the same on every machine. */
#ifndef SCENE_H
#define SCENE_H

#include "timing/work.h"

enum { SCENE_SEED = 2001 };

typedef struct scene {
    const char *title;
    timing_work work; /* one job */
} scene;

/* Each returns an exit_code; on success timing_work_free gives the memory back. */
int scene_make_random(scene *s); /* the paper's: vertices uniform in a cube */
int scene_make_knot(scene *s);   /* a mesh: a tube along a trefoil knot, cut by the box */

#endif
