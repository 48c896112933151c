/* dual.h - the planes of a grid as a scene: one huge triangle each, whose own borders no ray within mesh and grid comes near. */
#ifndef TRIBOX_TESTS_DUAL_H
#define TRIBOX_TESTS_DUAL_H

#include "embree.h"
#include "planes.h"

typedef struct dual {
    embree_scene *scene;
    int first[3]; /* the triangle that is plane 0 of an axis */
} dual;

dual dual_make(const planes *p, const shape *s);
void dual_free(dual *d);

/* The plane that a triangle of the scene is. */
int dual_axis(const dual *d, unsigned number);
int dual_plane(const dual *d, unsigned number);

#endif
