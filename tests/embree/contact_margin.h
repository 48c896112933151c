/* contact_margin.h - how far a pair is from contact, in double: what CONSERVATIVE and FAST are allowed to get wrong. */
#ifndef TRIBOX_TESTS_MARGIN_H
#define TRIBOX_TESTS_MARGIN_H

#include <stdbool.h>

#include "common/pair_f32.h"

/* The widest separation over the thirteen axes, as a length: above 0 the pair is disjoint, below it the depth. */
double margin_gap(const pair_f32 *pair);

/* The largest magnitude of a coordinate of the pair. */
double margin_largest(const pair_f32 *pair);

/*
 * Whether CONSERVATIVE may report this disjoint pair: no box normal separates, and whatever edge axis or plane separates does so by
 * no more than three times the float bound that the kernels leave for it (once for the kernel's own rounding, once for what is left
 * out of the bound, once to spare).
 */
bool margin_is_conservative(const pair_f32 *pair);

#endif
