/* soups.h - seeded soups, each with a box to test against. The order of the list is the order of the reports. */
#ifndef BENCH_SOUPS_H
#define BENCH_SOUPS_H

#include "timing/timing.h"

typedef struct scene {
    const char *name;
    const char *what; /* in a few words, for reports */
    timing_work work; /* one job; of rounded ties one for each of SCENE_BOXES boxes, if they are asked for */
} scene;

/* The names of those that are not made for the order of the axes alone, one after another; then NULL. */
const char *scene_usual(size_t index);

/* False, with a list of the scenes on stderr, if there is none of that name. */
bool scene_is_known(const char *name);

/* How often rounding loses a tie depends on the box: one box says little of others. Each has whole lines of triangles. */
enum { SCENE_BOXES = 125 };

/* Makes a scene; has_boxes: of rounded ties with many boxes. scene_free follows in any case. */
bool scene_make(const char *name, uint64_t seed, bool has_boxes, scene *made);

void scene_free(scene *made);

/* For scenes of other kinds: room for triangles, false with a message where there is no memory for them; */
bool scene_room(scene *made, size_t triangles);

/* and what has been written to these as its one job, against a share of each side of its bounds, about the middle. */
void scene_add(scene *made, size_t count, double share);

/* Rows of `along` squares, two triangles to each, over vertices that are drawn row after row. False if memory fails. */
typedef void draw_vertex(generator *g, size_t i, size_t j, size_t along, float u[3]);
bool draw_field(size_t along, size_t rows, draw_vertex *draw, generator *g, float (*triangles)[3][3]);

#endif
