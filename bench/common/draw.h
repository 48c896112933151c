/* draw.h - one triangle of a scene at a time, from a seeded generator. */
#ifndef BENCH_DRAW_H
#define BENCH_DRAW_H

#include <stdbool.h>
#include <stddef.h>

#include "paper/random.h"

/* triangle[j][a] is axis a of vertex j. */
typedef float triangle[3][3];

typedef void draw_triangle(generator *g, triangle t);

/* Anywhere about the box. */
draw_triangle draw_paper, draw_offset, draw_sparse, draw_inside, draw_lattice, draw_tenths, draw_cad, draw_cad_tenths;

/* Touching the box [-0.5, 0.5]^3 from outside, or off it by what rounding leaves. */
draw_triangle draw_touching, draw_touching_ulp, draw_needle, draw_cap;

/* Through the box and past it. */
draw_triangle draw_thin;

#endif
