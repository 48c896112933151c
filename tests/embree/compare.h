/* compare.h - answers about the candidate pairs of a witness table, held against that table. */
#ifndef TRIBOX_TESTS_COMPARE_H
#define TRIBOX_TESTS_COMPARE_H

#include "common/pair_f32.h"
#include "witness.h"

/* Who answers: the first member of what an answerer knows besides. */
typedef struct answerer answerer;
struct answerer {
    /* One bit for each box, as tribox_overlap_boxes. */
    void (*answer)(answerer *self, size_t t, const triangle *u, const tribox_boxes *boxes, uint64_t *mask);
    /* Told of every pair that has a certain witness but is answered 'no', or has not even a possible one but is answered 'yes'. */
    void (*breach)(answerer *self, const pair_f32 *pair, bool answer);
    size_t missed, unfounded; /* how many of either */
    size_t overlapping;       /* pairs answered 'yes' */
};

/*
 * Asks them all about every candidate pair. The cells that the first one reports are set in `occupied`, as tribox_voxelize sets
 * them, unless it is NULL. Returns how many pairs there are.
 */
size_t compare(const witness *w, answerer *const *answerers, int count, uint64_t *occupied);

/* The same for one pair, even if it is not a candidate. */
void compare_pair(const witness *w, answerer *who, size_t t, const int cell[3], bool answer);

#endif
