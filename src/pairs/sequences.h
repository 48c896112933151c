/* sequences.h - the orders in which groups of axes are tested. */
#ifndef TRIBOX_SEQUENCES_H
#define TRIBOX_SEQUENCES_H

#include <stdbool.h>

#include "base/compiler.h"

/*
 * A sequence is the groups of axes in the order in which they are tested, one decimal digit each, by the number of the paper's
 * bullet: 1 the box normals, 2 the plane, 3 the edges. 213 and 312 test one group alone, and then of the packets that it leaves
 * everything, as 132 does. So each has an instance of what is tested; a set of groups has one, but for all of them (plan.c).
 */
#define TRIBOX_FOR_EACH_SEQUENCE(X) X(1) X(2) X(3) X(12) X(13) X(32) X(123) X(132) X(213) X(312)

enum {
#define TRIBOX_SEQUENCE_INDEX(sequence) TRIBOX_SEQUENCE_##sequence,
    TRIBOX_FOR_EACH_SEQUENCE(TRIBOX_SEQUENCE_INDEX)
#undef TRIBOX_SEQUENCE_INDEX
        TRIBOX_SEQUENCES
};

/* The k-th group of a sequence, 0 past its end. Without a loop, which compilers fold late. */
TRIBOX_INLINE unsigned group_at(unsigned sequence, int k)
{
    const int places = sequence > 99 ? 2 - k : sequence > 9 ? 1 - k : -k; /* after it */
    return places == 2 ? sequence / 100 : places == 1 ? sequence / 10 % 10 : places == 0 ? sequence % 10 : 0;
}

TRIBOX_INLINE bool sequence_has(unsigned sequence, unsigned group)
{
    return group_at(sequence, 0) == group || group_at(sequence, 1) == group || group_at(sequence, 2) == group;
}

/* The group that is tested alone before all others; 0 for none. */
TRIBOX_INLINE unsigned group_alone(unsigned sequence) { return sequence > 200 ? sequence / 100 : 0; }

/* Whether edges and plane are tested together. */
TRIBOX_INLINE bool is_joint(unsigned sequence) { return sequence == 32 || sequence == 132; }

#endif
