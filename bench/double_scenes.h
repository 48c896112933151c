/* double_scenes.h - triangles of doubles, the same as floats, each as nine numbers and by index. */
#ifndef BENCH_DOUBLE_SCENES_H
#define BENCH_DOUBLE_SCENES_H

#include <stdbool.h>
#include <stddef.h>

#include "tribox.h"

typedef struct double_scene {
    const char *name, *what;
    size_t count;
    tribox_mesh nine, indexed;               /* of doubles */
    tribox_mesh single_nine, single_indexed; /* of floats */
    tribox_box box;
    tribox_box single_box;
    void *memory[5];
} double_scene;

enum { DOUBLE_SCENES = 7 };

/* Which scenes are too large for --quick. */
bool double_scene_is_large(size_t index);

/* Ends the program if memory fails. */
void double_scene_make(size_t index, double_scene *made);
void double_scene_free(double_scene *made);

/* Triangles, as nine doubles, against a box for which the first stage leaves what the box normals do not separate. */
typedef enum stage_scene {
    STAGE_NONE,   /* an ordinary box: none are left */
    STAGE_DOUBLE, /* a flat box */
    STAGE_ULP,    /* within units of the last place of contact */
    STAGE_SHORT,  /* numbers below 2^-200, few bits apart */
    STAGE_LONG,   /* exponents from end to end */
    STAGE_SCENES
} stage_scene;

extern const char *const stage_names[STAGE_SCENES];
void stage_scene_make(stage_scene which, double_scene *made);

#endif
