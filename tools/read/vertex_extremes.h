/* vertex_extremes.h - the box around vertices, and whether triangles reach its sides, without a look at their coordinates. */
#ifndef VERTEX_EXTREMES_H
#define VERTEX_EXTREMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "tribox.h"

enum { EXTREMES = 6 };

typedef struct vertex_extremes {
    bool is_finite;         /* all coordinates are */
    bool has_negative_zero; /* one is -0 */
    float bound[EXTREMES];  /* the least x, y and z, and the greatest */
    size_t at[EXTREMES];    /* the first vertex of the lowest block that reaches it */
} vertex_extremes;

vertex_extremes vertex_extremes_none(void);

/* Adds vertices first .. first + count - 1, a block. */
void vertex_extremes_look(const float *positions, size_t first, size_t count, vertex_extremes *e);

void vertex_extremes_join(const vertex_extremes *part, vertex_extremes *all);

/* The box. False where triangles that have all vertices may have another: numbers are not finite, or the sign of a 0 is open. */
bool vertex_extremes_box(const vertex_extremes *e, tribox_box *box);

/* For each side one vertex that reaches it, of those in blocks of so many. */
void vertex_extremes_find(const vertex_extremes *e, const float *positions, size_t block, uint32_t vertex[EXTREMES]);

/* Which of these are among the corners, those left out that were met: a bit for each, in addition to `met`. */
unsigned vertex_extremes_meet(const uint32_t vertex[EXTREMES], const uint32_t *corners, size_t count, unsigned met);

#endif
