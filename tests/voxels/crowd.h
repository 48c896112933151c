/* crowd.h - triangles that a test draws, as the streams of a soup. */
#ifndef TRIBOX_TESTS_CROWD_H
#define TRIBOX_TESTS_CROWD_H

#include <string.h>

#include "tribox.h"

enum { CROWD_MAX = 4096 };

typedef struct crowd {
    size_t count;
    float coordinate[3][3][CROWD_MAX]; /* vertex, axis, triangle */
} crowd;

/* A float[3][3] as what the library and the judge take: C has no such conversion. */
typedef const float (*const_vertices)[3];

static inline void crowd_put(crowd *c, const float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            c->coordinate[j][a][c->count] = u[j][a];
    c->count += c->count < CROWD_MAX - 1;
}

static inline void crowd_get(const crowd *c, size_t t, float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            u[j][a] = c->coordinate[j][a][t];
}

/* Triangles first .. first + count - 1, with the vertices taken in any order. */
static inline tribox_soup crowd_part(const crowd *c, size_t first, size_t count, const int vertex[3])
{
    tribox_soup soup = {.count = count};
    for (int j = 0; j < 3; j++) {
        soup.x[j] = c->coordinate[vertex[j]][0] + first;
        soup.y[j] = c->coordinate[vertex[j]][1] + first;
        soup.z[j] = c->coordinate[vertex[j]][2] + first;
    }
    return soup;
}

static inline tribox_soup crowd_soup(const crowd *c) { return crowd_part(c, 0, c->count, (const int[]){0, 1, 2}); }

#endif
