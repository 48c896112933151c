/* fill_search.h - which free cells are reached from outside, by a plain search. */
#ifndef TRIBOX_TESTS_FILL_SEARCH_H
#define TRIBOX_TESTS_FILL_SEARCH_H

#include "fill_walls.h"

/* Cell by cell, from all that lies on the border of the grid. Returns the number of cells reached. */
size_t fill_search(const walls *w, unsigned char is_reached[WALLS_CELLS]);

#endif
