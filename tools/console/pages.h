/* pages.h - large rooms of zeros, on large pages where the system has them, so that touching them first takes little. */
#ifndef PAGES_H
#define PAGES_H

#include <stddef.h>

/*
 * Zeros, from a multiple of 64 bytes on; NULL where there is no memory. A page is taken when it is first touched, by that thread.
 */
void *pages_take(size_t bytes);

/* bytes: as they were taken. room: NULL for none. */
void pages_free(void *room, size_t bytes);

#endif
