/* unbranched.h - the paper's test as C would have it for streams: no branches, for the compiler to vectorize, in float. */
#ifndef BENCH_UNBRANCHED_H
#define BENCH_UNBRANCHED_H

#include "tribox.h"

/* Bit i % 64 of mask[i / 64] is set if triangle i overlaps the box, but for rounding. center, half: of the box. */
void unbranched_overlap(const tribox_soup *soup, const float center[3], const float half[3], uint64_t *mask);

#endif
