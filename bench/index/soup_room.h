/* soup_room.h - memory for the nine streams of a soup. */
#ifndef BENCH_SOUP_ROOM_H
#define BENCH_SOUP_ROOM_H

#include <stdbool.h>

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct soup_room {
    tribox_soup soup;          /* the streams, to be read */
    float *x[3], *y[3], *z[3]; /* the same, to be written */
    void *storage;
} soup_room;

/* Streams that begin on cache lines, no two of them at the same place of a page. False, with a message, if memory fails. */
bool soup_room_make(size_t count, soup_room *made);

void soup_room_free(soup_room *made);

/* Triangle i as vertices: u[v][a] is axis a of vertex v. */
void soup_room_put(soup_room *to, size_t i, const float u[3][3]);
void soup_triangle(const tribox_soup *soup, size_t i, float u[3][3]);

#ifdef __cplusplus
}
#endif

#endif
