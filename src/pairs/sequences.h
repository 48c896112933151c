/* sequences.h - the orders in which groups of axes are tested. */
#ifndef TRIBOX_SEQUENCES_H
#define TRIBOX_SEQUENCES_H

#include <stdbool.h>

#include "base/compiler.h"

/*
 * A sequence is the groups of axes in the order in which they are tested, one decimal digit each, by the number of the paper's
 * bullet: 1 the box normals, 2 the plane, 3 the edges. 213 and 312 test one group alone, and then of the packets that it leaves
 * everything, as 132 does. So each has an instance of what is tested; a set of groups has one, but for all of them (plan.c). The
 * second word says how: group by group, edges and plane together, or one group alone.
 */
#define TRIBOX_FOR_EACH_SEQUENCE(X) \
    X(1, apart) \
    X(2, apart) X(3, apart) X(12, apart) X(13, apart) X(32, joint) X(123, apart) X(132, joint) X(213, alone) X(312, alone)

enum {
#define TRIBOX_SEQUENCE_INDEX(sequence, how) TRIBOX_SEQUENCE_##sequence,
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

#endif
