/* ordered_soup.h - a soup in order by cuts, with its index, and what it took to come by them. */
#ifndef BENCH_ORDERED_SOUP_H
#define BENCH_ORDERED_SOUP_H

#include "index_scenes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Nanoseconds of a triangle, the least of some tries. */
typedef struct order_cost {
    double order, gather, build;
} order_cost;

typedef struct ordered_soup {
    soup_room room;
    uint32_t *ids; /* the triangles' numbers in the file */
    void *memory;
    tribox_index index;
    order_cost cost;
} ordered_soup;

/* tries: of which the least times are kept. kernel: of the index. False, with a message, if memory or the library fails. */
bool ordered_soup_make(const index_scene *scene, int tries, const char *kernel, ordered_soup *made);

void ordered_soup_free(ordered_soup *made);

/* Room for the nodes of an index, touched; NULL if memory fails. */
void *index_room(size_t triangles);

#ifdef __cplusplus
}
#endif

#endif
