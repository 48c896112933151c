/*
 * window_f64.h - a mesh of doubles and a window of a grid in double: what the oracle says of every cell, and what the library
 * sets.
 */
#ifndef TRIBOX_TESTS_WINDOW_F64_H
#define TRIBOX_TESTS_WINDOW_F64_H

#include "common/ask.h"
#include "common/random_draws.h"

enum { WINDOW_TRIANGLES = 200, WINDOW_CELLS = 4096 /* of a grid, and words of it */ };

typedef double triangle_f64[3][3]; /* [j][a]: axis a of vertex j */

/* What is asked, for the message of a failure. */
typedef struct window_f64 {
    const char *scene;
    uint64_t seed;
    tribox_grid grid;
    tribox_window at;
    triangle_f64 triangle[WINDOW_TRIANGLES];
    size_t count;
    tribox_options options;
} window_f64;

/* The whole grid. */
void window_f64_open(window_f64 *w);

/* Any part of it, of at least one cell. */
void window_f64_draw(window_f64 *w, random_source *r);

size_t window_f64_words(const window_f64 *w);

/* Plane p of axis a, as C's fma says. */
double window_f64_plane(const tribox_grid *grid, int a, double p);

/*
 * The cells that triangles first .. first + count - 1 overlap by these axes, by the oracle. Returns how many pairs it was asked
 * about.
 */
size_t window_f64_expect(const window_f64 *w, size_t first, size_t count, unsigned axes, uint64_t *occupied);

/* What the library sets, with what holds for every call checked on the way. */
void window_f64_ask(const window_f64 *w, size_t first, size_t count, uint64_t *occupied);

/* Fails, with the cell and a triangle, where words differ; or where a cell of `expected` is not set. */
void window_f64_check(const window_f64 *w, size_t first, size_t count, const uint64_t *expected, const uint64_t *occupied,
                      bool is_exact);

#endif
