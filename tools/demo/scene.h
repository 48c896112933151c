/* scene.h - generated scenes: a soup and a box that are the same wherever the seed is the same. */
#ifndef SCENE_H
#define SCENE_H

#include "tribox.h"

enum { SCENE_SEED = 2001 };

/* A soup twice over, as the kernels and as the paper's algorithm want it, and a box twice over. */
typedef struct scene {
    const char *title;
    tribox_box box;
    float center[3], half[3];
    tribox_soup soup;
    float (*triangles)[3][3]; /* the same triangles: triangles[i][v][a] is axis a of vertex v */
    float *coordinates;       /* what the streams point into */
} scene;

/* Each returns an exit_code; on success scene_free gives the memory back. */
int scene_make_random(scene *s); /* the paper's: vertices uniform in a cube */
int scene_make_knot(scene *s);   /* a mesh: a tube along a trefoil knot, cut by the box */

void scene_free(scene *s);

#endif
