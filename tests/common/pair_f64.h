/* pair_f64.h - one triangle and one box, in double. */
#ifndef TRIBOX_TESTS_PAIR_F64_H
#define TRIBOX_TESTS_PAIR_F64_H

#include <math.h>
#include <stdbool.h>

#include "tribox.h"

typedef struct pair_f64 {
    double u[3][3]; /* u[j][a]: axis a of vertex j */
    tribox_box box;
} pair_f64;

/* Number k of fifteen: nine of the triangle by vertex, three of lo, three of hi. */
static inline double pair_f64_number(const pair_f64 *pair, int k)
{
    return k < 9 ? pair->u[k / 3][k % 3] : k < 12 ? pair->box.lo[k - 9] : pair->box.hi[k - 12];
}

static inline bool are_finite(const double *numbers, int count)
{
    bool are = true;
    for (int k = 0; k < count; k++)
        are = are && isfinite(numbers[k]);
    return are;
}

static inline bool box_is_finite(const tribox_box *box) { return are_finite(box->lo, 3) && are_finite(box->hi, 3); }

static inline bool pair_f64_is_finite(const pair_f64 *pair) { return are_finite(&pair->u[0][0], 9) && box_is_finite(&pair->box); }

static inline bool box_is_empty(const tribox_box *box)
{
    return box->lo[0] > box->hi[0] || box->lo[1] > box->hi[1] || box->lo[2] > box->hi[2];
}

/* By comparison of every coordinate with the bounds: not of a NaN, and of no triangle where the box is empty. */
static inline bool triangle_is_inside(const double (*u)[3], const tribox_box *box)
{
    bool is = true;
    for (int k = 0; k < 9; k++)
        is = is && u[k / 3][k % 3] >= box->lo[k % 3] && u[k / 3][k % 3] <= box->hi[k % 3];
    return is;
}

/* Of nine floats. */
static inline pair_f64 pair_of_floats(const float *nine, const tribox_box *box)
{
    pair_f64 pair = {.box = *box};
    for (int k = 0; k < 9; k++)
        pair.u[k / 3][k % 3] = (double)nine[k];
    return pair;
}

#endif
