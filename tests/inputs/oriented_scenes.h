/* oriented_scenes.h - triangles about oriented boxes: a scene of an upright box, placed in a frame, moved, scaled and spoiled. */
#ifndef TRIBOX_TESTS_ORIENTED_SCENES_H
#define TRIBOX_TESTS_ORIENTED_SCENES_H

#include <stdbool.h>

#include "common/random_draws.h"
#include "tribox.h"

enum { ORIENTED_TRIANGLES = 200 }; /* two batches of scenes.h */

/* Which numbers are floats: those of triangles and box, of triangles alone, or of neither. */
typedef enum oriented_form { ORIENTED_FLOATS, ORIENTED_TRIANGLES_OF_FLOATS, ORIENTED_DOUBLES, ORIENTED_FORMS } oriented_form;

/* One box and the triangles about it. */
typedef struct oriented_batch {
    oriented_form form;
    tribox_oriented_box box;
    double u[ORIENTED_TRIANGLES][3][3];
    int count;
} oriented_batch;

/* How the numbers of a scene come about. */
typedef struct oriented_scene {
    const char *name;
    void (*draw)(random_source *r, oriented_batch *batch);
    bool is_ordinary; /* no slivers and no extremes: what rounding changes is very near contact */
    unsigned share;   /* of the batches that are drawn */
} oriented_scene;

enum { ORIENTED_SCENES = 23 };
extern const oriented_scene oriented_scenes[ORIENTED_SCENES];

/*
 * Draws a batch of 0 to ORIENTED_TRIANGLES triangles, now and then one that is not finite, and a sign for every zero. Scenes of
 * doubles reach as far as doubles do.
 */
void oriented_draw(const oriented_scene *s, oriented_form form, random_source *r, oriented_batch *batch);

#endif
