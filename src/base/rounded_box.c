/* rounded_box.c - bounds of doubles, as floats that answer for them. */
#include "rounded_box.h"

#include <math.h>

#include "floats.h"

float tribox_float_from(double number)
{
    const float nearest = tribox_float_nearest(number);
    return (double)nearest < number ? tribox_float_above(nearest) : nearest;
}

void tribox_box_round(const tribox_box *box, bool is_box_asked, tribox_rounded_box *rounded)
{
    rounded->exact = *box;
    for (int a = 0; a < 3; a++) {
        const double lo = box->lo[a], hi = box->hi[a];
        const float l = tribox_float_from(lo), h = -tribox_float_from(-hi), origin = is_box_asked ? l : (float)lo;
        rounded->lo[a] = l;
        rounded->hi[a] = h;
        rounded->origin[a] = origin;
        if ((double)l == lo && (double)h == hi) { /* of floats: rounded once */
            rounded->H[a] = rounded->C[a] = fabsf(h - l);
        } else {
            rounded->H[a] = (float)fabs(hi - lo);
            rounded->C[a] = (float)((hi - (double)origin) + (lo - (double)origin));
        }
    }
}
