/* index_canvas.h - a surface without perspective: which triangle is seen at each sample, and how far away. */
#ifndef BENCH_INDEX_CANVAS_H
#define BENCH_INDEX_CANVAS_H

#include <stdbool.h>

#include "tribox.h"

enum { CANVAS_FINE = 3 /* samples along each side of a pixel */ };

#define CANVAS_NOTHING UINT32_MAX

typedef struct canvas {
    unsigned width, height; /* in samples */
    double axis[3][3];      /* to the right, down and towards the eye, in units of a sample */
    double corner[3];       /* what is added to them */
    uint32_t *triangle;     /* of each sample, or CANVAS_NOTHING */
    float *depth;           /* greater is nearer */
} canvas;

/*
 * An empty picture of so many pixels that a soup and a box fit. from: where the eye is, so many degrees to the right of the front,
 * and above it. Returns false if memory fails.
 */
bool canvas_make(unsigned width, unsigned height, const tribox_soup *soup, const tribox_box *box, const double from[2],
                 canvas *made);

void canvas_free(canvas *made);

/* Where a point is seen: to the right, down and towards the eye. */
void canvas_place(const canvas *c, const float point[3], float at[3]);

/* Draws the triangles of a soup over what is there. */
void canvas_draw(canvas *c, const tribox_soup *soup);

#endif
