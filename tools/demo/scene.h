/* scene.h - the generated scenes of tribox demo: a soup and a box each, the same on every machine. */
#ifndef SCENE_H
#define SCENE_H

#include "timing/work.h"

enum { SCENE_SEED = 2001 };

/* One job each. Return an exit_code; timing_work_free gives the memory back. */
int scene_make_random(timing_work *work); /* the paper's: vertices uniform in a cube */
int scene_make_knot(timing_work *work);   /* a mesh: a tube along a trefoil knot, cut by the box */

#endif
