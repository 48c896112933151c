/* fill_whole.h - the cells that a surface encloses, in the words of its whole grid. */
#ifndef FILL_WHOLE_H
#define FILL_WHOLE_H

#include "read/mesh.h"

/* The words of a grid, and what is found. */
typedef struct whole_fill {
    const tribox_grid *grid;
    const uint64_t *surface;
    uint64_t *solid;
    void *scratch; /* fill_whole_bytes */
    size_t inside, odd_rows;
} whole_fill;

size_t fill_whole_bytes(const tribox_grid *grid, unsigned threads);

/* m: to fill by parity, layers by layers in threads; NULL to fill what the outside does not reach, in one. */
tribox_status fill_whole(const mesh *m, unsigned threads, whole_fill *f);

#endif
