/* triangle_list.h - triangles that a test draws, as the streams of a soup. */
#ifndef TRIBOX_TESTS_TRIANGLE_LIST_H
#define TRIBOX_TESTS_TRIANGLE_LIST_H

#include <string.h>

#include "tribox.h"

enum { TRIANGLE_LIST_MAX = 4096 };

typedef struct triangle_list {
    size_t count;
    float coordinate[3][3][TRIANGLE_LIST_MAX]; /* vertex, axis, triangle */
} triangle_list;

/* A float[3][3] as what the library and the oracle take: C has no such conversion. */
typedef const float (*const_vertices)[3];

static inline void triangle_list_put(triangle_list *c, const float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            c->coordinate[j][a][c->count] = u[j][a];
    c->count += c->count < TRIANGLE_LIST_MAX - 1;
}

static inline void triangle_list_get(const triangle_list *c, size_t t, float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            u[j][a] = c->coordinate[j][a][t];
}

/* Triangles first .. first + count - 1, with the vertices taken in any order. */
static inline tribox_soup triangle_list_part(const triangle_list *c, size_t first, size_t count, const int vertex[3])
{
    tribox_soup soup = {.count = count};
    for (int j = 0; j < 3; j++) {
        soup.x[j] = c->coordinate[vertex[j]][0] + first;
        soup.y[j] = c->coordinate[vertex[j]][1] + first;
        soup.z[j] = c->coordinate[vertex[j]][2] + first;
    }
    return soup;
}

static inline tribox_soup triangle_list_soup(const triangle_list *c)
{
    return triangle_list_part(c, 0, c->count, (const int[]){0, 1, 2});
}

#endif
