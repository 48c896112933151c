/* grid_scenes_f64.h - named kinds of grids in double, and triangles about them. */
#ifndef TRIBOX_TESTS_GRID_SCENES_F64_H
#define TRIBOX_TESTS_GRID_SCENES_F64_H

#include "window_f64.h"

typedef struct scene_f64 {
    const char *name;
    void (*draw)(random_source *r, tribox_grid *grid); /* origin and cells */
} scene_f64;

size_t scene_f64_count(void);
const scene_f64 *scene_f64_at(size_t i);

/* A grid that is sound, of at most `cells` cells; where these are many now and then a long one, which has more. */
void draw_grid_f64(random_source *r, const scene_f64 *scene, int cells, tribox_grid *grid);

/* On planes or next to them, within cells, far away; flat, thin, small and large ones. */
void draw_triangle_f64(random_source *r, const tribox_grid *grid, triangle_f64 u);

/* A grid of the scene, and a few triangles about it or many. */
void window_f64_draw_scene(window_f64 *w, random_source *r, const scene_f64 *scene, int cells);

#endif
