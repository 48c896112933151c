/* exact_short.c - pairs in integers of 60 bits: products in 128 bits, the height of a corner above the plane in two parts. */
#include "exact.h"

#include "kernel.h"
#include "wide.h"

typedef struct exact_points {
    const int64_t (*at)[TRIBOX_POINTS];
    tribox_wide n[3];
} exact_points;

TRIBOX_INLINE int64_t length_of(const exact_points *p, int j, int a) { return p->at[a][(j + 1) % 3] - p->at[a][j]; }

TRIBOX_INLINE int sign_of_length(const exact_points *p, int j, int a)
{
    const int64_t length = length_of(p, j, a);
    return (length > 0) - (length < 0);
}

TRIBOX_INLINE int sign_of_normal(const exact_points *p, int i) { return tribox_wide_sign(p->n[i]); }

TRIBOX_INLINE int sign_of_side(const exact_points *p, int i, int j, int k, const int X[2])
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    return tribox_wide_sign(tribox_wide_difference(tribox_wide_product(length_of(p, j, b), p->at[a][k] - p->at[a][X[0]]),
                                                   tribox_wide_product(length_of(p, j, a), p->at[b][k] - p->at[b][X[1]])));
}

/* Both parts of n, times a difference and summed, fit 128 bits (PROOFS.md 9.2). */
TRIBOX_INLINE int sign_of_height(const exact_points *p, const int X[3])
{
    tribox_wide high = tribox_wide_product(0, 0), low = high;
    int64_t rest;
    for (int i = 0; i < 3; i++) {
        const int64_t difference = p->at[i][0] - p->at[i][X[i]];
        high = tribox_wide_sum(high, tribox_wide_product(tribox_wide_split(p->n[i], &rest), difference));
        low = tribox_wide_sum(low, tribox_wide_product(rest, difference));
    }
    high = tribox_wide_sum(high, tribox_wide_product(tribox_wide_split(low, &rest), 1));
    const int sign = tribox_wide_sign(high);
    return sign ? sign : rest > 0;
}

#include "sides.h"

bool tribox_exact_short(const tribox_short_pair *pair, unsigned axes)
{
    exact_points p;
    p.at = pair->at;
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        p.n[i] = tribox_wide_difference(tribox_wide_product(length_of(&p, 0, a), length_of(&p, 1, b)),
                                        tribox_wide_product(length_of(&p, 0, b), length_of(&p, 1, a)));
    }
    return are_sides_touching(&p, axes);
}
