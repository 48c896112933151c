/* own_words.h - cells that each thread sets apart from the others, put together at the end: for grids of few words. */
#ifndef OWN_WORDS_H
#define OWN_WORDS_H

#include <stddef.h>
#include <stdint.h>

#include "console/processors.h"

/* Words of one's own up to these are put together faster than triangles are looked at twice. */
enum { OWN_WORDS_BYTES = 1 << 21 };

typedef struct own_words {
    size_t count;
    uint64_t *all;              /* where they go in the end: those of thread 0 */
    uint64_t *own[THREADS_MAX]; /* of the others; NULL: not taken yet */
} own_words;

/* The words of a thread, which it alone asks for; NULL where there is no memory. */
uint64_t *own_words_of(own_words *w, unsigned thread);

/*
 * Puts a strip of the words together, of which there are so many. Returns how many cells the other threads add to those of thread
 * 0.
 */
size_t own_words_strips(const own_words *w);
size_t own_words_join(const own_words *w, size_t strip);

/* Gives back what own_words_of has taken. */
void own_words_free(own_words *w);

#endif
