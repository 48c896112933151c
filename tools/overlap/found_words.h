/* found_words.h - what an index finds: the words of a mask that are not zero, in ascending order. */
#ifndef FOUND_WORDS_H
#define FOUND_WORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct found_words {
    size_t room;       /* the words of the whole mask */
    size_t count;      /* those that are there */
    uint32_t *number;  /* bit b of bits[k] is triangle 64 * number[k] + b */
    uint64_t *bits;    /* what all others point into */
    uint64_t *mask;    /* a whole mask and */
    uint64_t *touched; /* a bit for each of its words: zero between calls */
} found_words;

/* Room for the words of so many triangles. Returns false if memory fails; else found_words_free gives it back. */
bool found_words_make(found_words *w, size_t triangles);

/* Triangle i becomes triangle order[i]. Takes time for those found and a 4096th part of all. */
void found_words_renumber(found_words *w, const uint32_t *order);

void found_words_free(found_words *w);

#endif
