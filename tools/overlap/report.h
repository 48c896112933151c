/* report.h - prints the answer about one box: for people, as a list, or as JSON. */
#ifndef REPORT_H
#define REPORT_H

#include "found_words.h"
#include "overlap.h"

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
