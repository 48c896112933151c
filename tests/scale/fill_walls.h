/* fill_walls.h - grids of free and occupied cells that are hard to flood: corridors of one cell, shells, combs, noise. */
#ifndef TRIBOX_TESTS_FILL_WALLS_H
#define TRIBOX_TESTS_FILL_WALLS_H

#include "common/random_draws.h"

enum { WALLS_CELLS = 40000 };

typedef struct walls {
    const char *kind;
    uint32_t size[3];
    unsigned char is_wall[WALLS_CELLS];
} walls;

static inline size_t walls_at(const walls *w, uint32_t i, uint32_t j, uint32_t k)
{
    return ((size_t)k * w->size[1] + j) * w->size[0] + i;
}

size_t walls_kinds(void);

/* Of any size, often one row, one layer or a word and a few cells; of kind `number`, or of some with a hole in it. */
void walls_draw(random_source *r, size_t number, walls *w);

/* Which free cells are reached from outside, cell by cell from all that lies on the border. Returns the number of cells reached. */
size_t walls_search(const walls *w, unsigned char is_reached[WALLS_CELLS]);

#endif
