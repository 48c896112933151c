/* report.h - prints the answer about one box: for people, as a list, or as JSON. */
#ifndef REPORT_H
#define REPORT_H

#include "overlap.h"

/* What an index finds: the words of a mask that are not zero, in ascending order. */
typedef struct found_words {
    size_t room;       /* the words of the whole mask */
    size_t count;      /* those that are there */
    uint32_t *number;  /* bit b of bits[k] is triangle 64 * number[k] + b */
    uint64_t *bits;    /* what all others point into */
    uint64_t *mask;    /* a whole mask and */
    uint64_t *touched; /* a bit for each of its words: zero between calls */
} found_words;

/*
 * Continues the list of an answer, or starts it where first is 0, with the numbers of the triangles first .. first + count - 1
 * whose bits are set. Returns an exit_code.
 */
int report_list(const request *r, answer *a, uint64_t first, const uint64_t *mask, size_t count);

/* The whole list of an answer, from the words that are not zero. Returns an exit_code. */
int report_words(const request *r, answer *a, const found_words *words);

/* Prints the rest of the answer, or all of it where no list is wanted, and flushes the output. Returns an exit_code. */
int report_end(const request *r, answer *a);

#endif
