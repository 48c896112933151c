/* hostile.h - soups and boxes made to be hard for an index: ties in every bound, clusters, duplicates, ends of the float range. */
#ifndef TRIBOX_TESTS_HOSTILE_H
#define TRIBOX_TESTS_HOSTILE_H

#include "common/scenes.h"
#include "stored.h"

typedef struct soup_kind {
    const char *name;
    void (*draw)(random_source *r);
} soup_kind;

size_t soup_kind_count(void);
const soup_kind *soup_kind_at(size_t i);

/*
 * Words and nodes that lie in cells of their own, one beside the other: a box that follows a lattice has words, nodes and nodes of
 * nodes wholly inside. The first of the kinds.
 */
void draw_cells(random_source *r);

/*
 * A soup of a kind, anywhere between its fences, often with what is NaN or infinite in it; and an index of it by any kernel. In
 * every other case as a mesh, if it may be one.
 */
void draw_stored(random_source *r, const soup_kind *kind, size_t count);
void draw_stored_form(random_source *r, const soup_kind *kind, size_t count);

/* Writes a scene's triangles from the first one on, as far as the soup goes. */
void put_batch(size_t first, const scene_batch *batch);

/* What is NaN or infinite. */
typedef enum dirt {
    DIRT_NONE,
    DIRT_ONE,
    DIRT_ONE_IN_A_WORD, /* one in every word */
    DIRT_A_WORD,
    DIRT_A_NODE,
    DIRT_A_THIRD,
    DIRT_TAIL, /* in the last word alone */
    DIRT_ALL_BUT_ONE,
    DIRT_ALL,
    DIRTS
} dirt;

/* One of a triangle's numbers, or several. */
void spoil_triangle(random_source *r, size_t i);
void spoil_soup(random_source *r, dirt kind);

/* Lower and upper bounds of the finite triangles of a range; an empty box if there are none. */
tribox_box bounds_of(size_t first, size_t count);

/* About the middle of a box, mostly with its half lengths: turned about an axis of the world, scaled, sheared, or flat. */
tribox_oriented_box draw_oriented(random_source *r, const tribox_box *about);
void draw_axes(random_source *r, tribox_oriented_box *box);

/* A finite box whose bounds are numbers of the soup, or an ulp next to them; empty, flat and point ones among them. */
tribox_box draw_box(random_source *r);

#endif
