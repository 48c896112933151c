/* rounded_box.c - bounds of doubles, as floats that answer for them. */
#include "rounded_box.h"

#include <math.h>

#include "floats.h"

float tribox_float_from(double number)
{
    const float nearest = tribox_float_nearest(number);
    return (double)nearest < number ? tribox_float_above(nearest) : nearest;
}

static void round_for_signs(const tribox_rounded_box *rounded, tribox_box_floats *fast)
{
    *fast = rounded->of;
    for (int a = 0; a < 3; a++) {
        const double lo = rounded->exact.lo[a], hi = rounded->exact.hi[a];
        const float middle = (float)((lo + hi) / 2), below = (float)(lo - (double)middle), above = (float)(hi - (double)middle);
        if ((double)below == lo - (double)middle && (double)above == hi - (double)middle) {
            fast->origin[a] = middle;
            fast->C[a] = below + above;
        }
        fast->H[a] += fast->H[a] * 0x1p-24f;
    }
}

/* Bounds on axis a that are not both floats. */
TRIBOX_NOINLINE void round_axis_bounds(const tribox_box *box, int a, bool is_box_asked, tribox_rounded_box *rounded)
{
    const double lo = box->lo[a], hi = box->hi[a];
    const float l = tribox_float_from(lo), origin = is_box_asked ? l : (float)lo;
    rounded->lo[a] = l;
    rounded->hi[a] = -tribox_float_from(-hi);
    rounded->of.origin[a] = origin;
    rounded->of.H[a] = (float)fabs(hi - lo);
    rounded->of.C[a] = (float)((hi - (double)origin) + (lo - (double)origin));
}

bool tribox_box_round(const tribox_box *box, bool is_box_asked, bool is_fast, tribox_rounded_box *rounded)
{
    tribox_box_floats *const of = &rounded->of;
    rounded->exact = *box;
    bool are_floats = true;
    for (int a = 0; a < 3; a++) {
        const float l = tribox_float_nearest(box->lo[a]), h = tribox_float_nearest(box->hi[a]);
        rounded->lo[a] = of->origin[a] = l;
        rounded->hi[a] = h;
        of->H[a] = of->C[a] = fabsf(h - l); /* of floats: rounded once */
        if ((double)l != box->lo[a] || (double)h != box->hi[a]) {
            are_floats = false;
            round_axis_bounds(box, a, is_box_asked, rounded);
        }
    }
    if (is_fast)
        round_for_signs(rounded, &rounded->fast);
    return are_floats;
}
