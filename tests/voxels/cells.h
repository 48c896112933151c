/*
 * cells.h - triangles of floats or of doubles and a window of a grid: which of its cells they overlap, as the oracle says of every
 * one, and as the library sets them.
 */
#ifndef TRIBOX_TESTS_CELLS_H
#define TRIBOX_TESTS_CELLS_H

#include "common/ask.h"
#include "common/grid_places.h"
#include "common/random_draws.h"
#include "common/soup_or_mesh.h"

enum { CELLS_TRIANGLES = 4096 };

/* How triangles are handed over: doubles in the last form alone, floats in any. Meshes are of any layout. */
typedef enum cells_form { SOUP, MESH, DOUBLES, FORMS } cells_form;

/* What is asked, also for the message of a failure. */
typedef struct cells_case {
    const char *scene;
    bool is_double; /* whether numbers are doubles, and not floats */
    tribox_grid grid;
    tribox_window at;
    size_t count;
    double u[CELLS_TRIANGLES][3][3]; /* by vertex and axis; the same in float as streams, by axis and vertex */
    float stream[9][CELLS_TRIANGLES];
    cells_form form;
    tribox_options options;
} cells_case;

/* Sets the window to the whole grid. */
void cells_open(cells_case *c);

/* Any part of a window, of at least one cell and at `most` so many: at either end, anywhere, or about the ends of words. */
void cells_draw_window(random_source *r, const tribox_window *in, const uint32_t most[3], tribox_window *w);

size_t cells_words(const cells_case *c);

/* The number of the triangles that is nearest to plane p of an axis, always finite. */
double cells_place(const cells_case *c, int a, double p);

/* The box of a cell of the window. */
tribox_box cells_box(const cells_case *c, const uint32_t at[3]);

/* Adds a triangle, rounded to what the numbers are; the last one has no room, and is overwritten. */
void cells_put(cells_case *c, double u[3][3]);

/* Triangles first .. first + count - 1; a mesh until the next one. */
soup_or_mesh cells_part(const cells_case *c, size_t first, size_t count);
soup_or_mesh cells_all(const cells_case *c);

/* Zeros; fails the test if there is no memory. */
uint64_t *cells_make(size_t words);

/* How many cells triangle t may touch, and one more on each side; by axes without the box normals all of the window. */
size_t cells_cost(const cells_case *c, size_t t, unsigned axes);

/* The cells that triangles first .. first + count - 1 overlap by these axes, by the oracle. Returns how many it was asked about. */
size_t cells_expect(const cells_case *c, size_t first, size_t count, unsigned axes, uint64_t *occupied);

/* The cells of the window among those of a larger one. */
void cells_cut(const cells_case *c, const tribox_window *from, const uint64_t *all, uint64_t *occupied);

/*
 * Voxelizes triangles first .. first + count - 1 into words that are as they are, or cleared before, between pages that cannot be
 * touched. What holds for every call is checked on the way: the status, the report, and that no bit is cleared, nor set past the
 * end of a row. Returns how many cells are new.
 */
size_t cells_add(const cells_case *c, size_t first, size_t count, uint64_t *occupied);
void cells_ask(const cells_case *c, size_t first, size_t count, uint64_t *occupied);

/*
 * Fails, with the cell, the grid and a triangle to blame, where a cell expected is not set; by EXACT also where another one is; for
 * floats by FAST never.
 */
void cells_check(const cells_case *c, size_t first, size_t count, const uint64_t *expected, const uint64_t *occupied);

typedef struct tally {
    size_t asked;  /* cells that EXACT sets */
    size_t missed; /* of these not set */
    size_t extra;  /* set without being overlapped */
} tally;

/*
 * Of floats: fails on a cell missed by CONSERVATIVE, and on any error outside of the band of cell_oracle.h: on each axis 2^-7 of
 * the cell, four times the spacing of floats at the farthest plane, as planes are rounded, and 2^-40 of the distance from the cell
 * to the farthest vertex.
 */
void cells_check_band(const cells_case *c, const uint64_t *exact, const uint64_t *occupied, tally *count);

#endif
