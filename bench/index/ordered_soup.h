/* ordered_soup.h - a soup in some order, with its index, and what it took to come by them. */
#ifndef BENCH_ORDERED_SOUP_H
#define BENCH_ORDERED_SOUP_H

#include "index_scenes.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum soup_order { ORDER_FILE, ORDER_MORTON, ORDER_CUTS, ORDERS } soup_order;

/* Nanoseconds of a triangle, the least of some tries. */
typedef struct order_cost {
    double order, gather, build;
} order_cost;

typedef struct ordered_soup {
    const char *name;
    soup_room room;
    uint32_t *ids; /* the triangles' numbers in the file; NULL in the order of the file */
    void *memory;
    tribox_index index;
    order_cost cost;
} ordered_soup;

/* tries: of which the least times are kept. kernel: of the index. False, with a message, if memory or the library fails. */
bool ordered_soup_make(const index_scene *scene, soup_order order, int tries, const char *kernel, ordered_soup *made);

void ordered_soup_free(ordered_soup *made);

#ifdef __cplusplus
}
#endif

#endif
