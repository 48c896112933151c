/* sequences.h - the orders in which groups of axes are tested. */
#ifndef TRIBOX_SEQUENCES_H
#define TRIBOX_SEQUENCES_H

#include <stdbool.h>

#include "base/compiler.h"

/*
 * A sequence is the groups of axes in the order in which they are tested, one decimal digit each, by the number of the paper's
 * bullet: 1 the box normals, 2 the plane, 3 the edges. 312 tests the edges first; 13 leaves the plane out.
 */
#define TRIBOX_FOR_EACH_SEQUENCE(X) X(1) X(2) X(3) X(12) X(13) X(21) X(23) X(31) X(32) X(123) X(132) X(213) X(231) X(312) X(321)

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

#endif
