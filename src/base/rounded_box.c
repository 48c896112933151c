/* rounded_box.c - bounds of doubles, as floats that answer for them. */
#include "rounded_box.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The float above a number that is not the greatest, and not infinite but for -infinity. */
static float next_above(float number)
{
    int32_t bits;
    memcpy(&bits, &number, sizeof bits);
    bits = number > 0 ? bits + 1 : number < 0 ? bits - 1 : 1;
    memcpy(&number, &bits, sizeof bits);
    return number;
}

/* The least float that is not below a number: infinite if there is none. */
static float float_from(double number)
{
    const float nearest = (float)number;
    return (double)nearest < number ? next_above(nearest) : nearest;
}

static float nearest_finite(double number) { return number > FLT_MAX ? FLT_MAX : number < -FLT_MAX ? -FLT_MAX : (float)number; }

void tribox_box_round(const tribox_box *box, bool is_box_asked, tribox_rounded_box *rounded)
{
    rounded->exact = *box;
    for (int a = 0; a < 3; a++) {
        const double lo = box->lo[a], hi = box->hi[a];
        const float l = is_box_asked ? float_from(lo) : nearest_finite(lo), h = -float_from(-hi);
        rounded->lo[a] = float_from(lo);
        rounded->hi[a] = h;
        rounded->origin[a] = l;
        if ((double)l == lo && (double)h == hi) { /* of floats: rounded once */
            rounded->H[a] = rounded->C[a] = fabsf(h - l);
        } else {
            rounded->H[a] = (float)fabs(hi - lo);
            rounded->C[a] = (float)((hi - (double)l) + (lo - (double)l));
        }
    }
}
