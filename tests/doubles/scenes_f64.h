/* scenes_f64.h - named kinds of pairs of doubles, each made to reach one way of being wrong. */
#ifndef TRIBOX_TESTS_SCENES_F64_H
#define TRIBOX_TESTS_SCENES_F64_H

#include <stdbool.h>
#include <stddef.h>

#include "common/pair_f64.h"
#include "common/random_draws.h"

/* A whole word of triangles and a tail. */
enum { BATCH_F64 = 100 };

/* One box and the triangles about it; all numbers are finite. */
typedef struct batch_f64 {
    tribox_box box;
    double u[BATCH_F64][3][3];
} batch_f64;

typedef void scene_f64_draw(random_source *r, batch_f64 *batch);

typedef struct scene_f64 {
    const char *name;
    scene_f64_draw *draw;
    size_t share; /* of the pairs of an ordinary scene one in so many: the oracle is slow where exponents are far apart */
} scene_f64;

size_t scene_f64_count(void);
const scene_f64 *scene_f64_at(size_t i);

/* Whether a scene answers to a name, or to NULL; and whether any does: if not, prints the known names. */
bool scene_f64_is_called(const scene_f64 *s, const char *name);
bool scene_f64_name_is_known(const char *name);

/* Triangle k of a batch and its box. */
pair_f64 batch_f64_pair(const batch_f64 *batch, int k);

/* As they come, or nearly: scenes_f64_plain.c. */
scene_f64_draw draw_f64_paper, draw_f64_offset, draw_f64_nanometres, draw_f64_sparse, draw_f64_lattice, draw_f64_far_lattice,
    draw_f64_tenths, draw_f64_widened, draw_f64_northings, draw_f64_degenerate;

/* Touching, and within rounding of it: scenes_f64_contact.c. */
scene_f64_draw draw_f64_touching, draw_f64_touching_ulp, draw_f64_float_ulp, draw_f64_needles, draw_f64_scaled, draw_f64_rotated,
    draw_f64_corners, draw_f64_big_triangles, draw_f64_big_boxes;

/* What floats are not for: boxes flat, thin, tiny and huge, and numbers on faces and next to them: scenes_f64_guards.c. */
scene_f64_draw draw_f64_flat, draw_f64_thin, draw_f64_thin_faces, draw_f64_sides, draw_f64_faces, draw_f64_zero_faces,
    draw_f64_beside_faces, draw_f64_standing, draw_f64_wild;

/* The ends of the range of doubles: scenes_f64_range.c. */
scene_f64_draw draw_f64_range, draw_f64_subnormal, draw_f64_near_max, draw_f64_overflow, draw_f64_units, draw_f64_stage_ends,
    draw_f64_nasty, draw_f64_bits;

/* Triangles of floats about boxes of doubles: scenes_f64_floats.c. */
scene_f64_draw draw_f64_float_planes, draw_f64_float_edges, draw_f64_float_faces;

#endif
