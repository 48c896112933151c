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

/* Whether a scene answers to a name, to "doubles", or to NULL. */
bool scene_f64_is_called(const scene_f64 *s, const char *name);

/* Triangle k of a batch and its box. */
pair_f64 batch_f64_pair(const batch_f64 *batch, int k);

#endif
