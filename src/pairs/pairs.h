/* pairs.h - answers pairs block by block: runs the kernel, and settles what it left undecided. */
#ifndef TRIBOX_PAIRS_H
#define TRIBOX_PAIRS_H

#include "plan.h"

/* Words that a kernel answers at a time, so that what it leaves undecided is settled while its triangles are in the cache. */
enum { TRIBOX_BLOCK_WORDS = 64 };

/* The kernel's answer about words word .. word + words - 1, at most TRIBOX_BLOCK_WORDS: bits as of a walk (kernel.h). */
void tribox_pairs_walk_block(const tribox_query *p, tribox_plan *plan, size_t word, size_t words, uint64_t *hit,
                             uint64_t *undecided);

/*
 * Settles the undecided lanes of words from anywhere, whose numbers are given, and adds those that overlap to the hits. Returns how
 * many of them have finite numbers.
 */
size_t tribox_pairs_settle_words(const tribox_query *p, const tribox_plan *plan, const size_t *number, size_t words,
                                 const uint64_t *undecided, uint64_t *hit);

/* The same for words word .. word + words - 1. */
size_t tribox_pairs_settle_block(const tribox_query *p, const tribox_plan *plan, size_t word, size_t words,
                                 const uint64_t *undecided, uint64_t *hit);

/* Both: one bit for each pair that overlaps. Returns how many pairs with finite numbers the kernel left undecided. */
size_t tribox_pairs_answer_block(const tribox_query *p, tribox_plan *plan, size_t word, size_t words, uint64_t *hit);

/* No pair overlaps: clears the mask, which may be NULL. */
void tribox_pairs_write_none(size_t count, uint64_t *mask);

/* Answers all pairs, and counts. mask may be NULL. */
tribox_report tribox_pairs_answer(const tribox_query *p, tribox_plan *plan, uint64_t *mask);

#endif
