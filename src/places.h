/*
 * places.h - where triangles or boxes lie: the middle of each bounding box and its number, as four streams in memory of the caller's.
 *
 * The streams x, y, z (float) and number (uint32_t) follow one another, at any alignment. Where a coordinate is not finite, all three
 * middles are NaN.
 */
#ifndef TRIBOX_PLACES_H
#define TRIBOX_PLACES_H

#include <string.h>

#include "kernel.h"

enum { TRIBOX_PLACE_BYTES = 16 };

typedef struct tribox_places {
    unsigned char *memory;
    size_t count;
} tribox_places;

/* Number i of stream k: 0 to 2 the middles, 3 the numbers. */
static inline unsigned char *tribox_places_at(const tribox_places *places, int k, size_t i)
{
    return places->memory + 4 * ((size_t)k * places->count + i);
}

/* The places of triangles or boxes first .. first + count - 1. The caller has checked them. */
void tribox_places_of_soup(const tribox_places *places, const tribox_soup *soup, size_t first, size_t count);
void tribox_places_of_boxes(const tribox_places *places, const tribox_boxes *boxes, size_t first, size_t count);
void tribox_places_of_mesh(const tribox_places *places, const tribox_mesh *mesh, const tribox_kernel *kernel, size_t first,
                           size_t count);

/* How many of `count` places come before the cut: 0 for no cut, where they are one word. */
size_t tribox_places_before_cut(size_t count);

/* Puts the places that come before the cut before the others. */
void tribox_places_cut(const tribox_places *places, size_t first, size_t count);

/* Puts the places of a word in order: by number, those that are not finite last. */
void tribox_places_sort_word(const tribox_places *places, size_t first, size_t count);

#endif
