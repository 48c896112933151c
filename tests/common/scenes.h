/* scenes.h - named kinds of pairs, each made to reach one way of being wrong. */
#ifndef TRIBOX_TESTS_SCENES_H
#define TRIBOX_TESTS_SCENES_H

#include <stdbool.h>
#include <stddef.h>

#include "pair_f64.h"
#include "random_draws.h"
#include "tribox.h"

/* A whole word of triangles and a tail. */
enum { SCENE_TRIANGLES = 100 };

/* One box and the triangles about it. */
typedef struct scene_batch {
    tribox_box box;
    float u[SCENE_TRIANGLES][3][3];
} scene_batch;

typedef void scene_draw(random_source *r, scene_batch *batch);

typedef struct scene {
    const char *name;
    const char *family;
    scene_draw *draw;
    bool is_exact_in_float; /* a lattice so small that FAST is never wrong */
} scene;

size_t scene_count(void);
const scene *scene_at(size_t i);

/* Draws a batch, and a sign for every zero in it. */
void scene_draw_batch(const scene *s, random_source *r, scene_batch *batch);

/* Triangle k of a batch and its box. */
pair_f64 scene_pair(const scene_batch *batch, int k);

/* Whether a scene answers to a name: its own, its family's, or NULL. */
bool scene_is_called(const scene *s, const char *name);

/* Whether any scene does, of floats or of doubles; if not, prints the known names. */
bool scene_name_is_known(const char *name);

/* Ordinary geometry: scenes_ordinary.c. */
scene_draw draw_paper, draw_eighths, draw_points, draw_segments, draw_offset, draw_big_triangles, draw_small_triangles, draw_cad,
    draw_sphere, draw_flat_boxes;

/* Touching, and within a few ulp of it: scenes_contact.c. */
scene_draw draw_touching, draw_touching_ulp, draw_near_contact, draw_needles, draw_caps, draw_edge_on, draw_flat_triangles;

/* The ends of the float range, one scale for all: scenes_range.c. */
scene_draw draw_offset_huge, draw_near_contact_scaled, draw_scaled, draw_subnormal, draw_near_max;

/* Numbers of very different size in one pair: scenes_scales.c. */
scene_draw draw_random_bits, draw_own_scale, draw_own_scale_touching, draw_tiny_at_corner, draw_lost_normal, draw_tiny_and_huge;

#endif
