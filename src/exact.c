/* exact.c - the stages of one pair: the numbers themselves, then double with its error bound, then integers wide enough. */
#include "exact.h"

#include <math.h>
#include <string.h>

bool tribox_triangle_is_finite(const float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            if (!isfinite(u[j][a]))
                return false;
    return true;
}

bool tribox_apart_on_box_normals(const tribox_pair *pair)
{
    const float(*const u)[3] = pair->u;
    const tribox_box *const box = &pair->box;
    for (int a = 0; a < 3; a++) {
        if (u[0][a] > box->hi[a] && u[1][a] > box->hi[a] && u[2][a] > box->hi[a])
            return true;
        if (u[0][a] < box->lo[a] && u[1][a] < box->lo[a] && u[2][a] < box->lo[a])
            return true;
    }
    return false;
}

/* A non-zero finite float as odd * 2^exponent; zero as 0 * 2^0. */
static int32_t odd_part(float number, int *exponent)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    const int field = (int)(bits >> 23 & 0xff);
    int32_t odd = (int32_t)(bits & 0x7fffff) | (field ? 0x800000 : 0);
    *exponent = 0;
    if (!odd)
        return 0;
    *exponent = (field ? field : 1) - 150;
    for (; !(odd & 1); ++*exponent)
        odd >>= 1;
    return bits >> 31 ? -odd : odd;
}

tribox_integers tribox_integers_of(const tribox_pair *pair)
{
    float number[15];
    memcpy(number, pair->u, 9 * sizeof *number);
    memcpy(number + 9, pair->box.lo, 3 * sizeof *number);
    memcpy(number + 12, pair->box.hi, 3 * sizeof *number);

    tribox_integers in;
    int unit = 128, top = -149;
    for (int k = 0; k < 15; k++) {
        in.odd[k] = odd_part(number[k], &in.shift[k]);
        if (!in.odd[k])
            continue;
        int end = in.shift[k];
        for (int32_t rest = in.odd[k]; rest; rest /= 2)
            end++;
        unit = in.shift[k] < unit ? in.shift[k] : unit;
        top = end > top ? end : top;
    }
    for (int k = 0; k < 15; k++)
        in.shift[k] = in.odd[k] ? in.shift[k] - unit : 0;
    in.bits = top > unit ? top - unit : 0;
    return in;
}

static bool overlap_in_integers(const tribox_pair *pair, unsigned axes)
{
    const tribox_integers in = tribox_integers_of(pair);
    if (in.bits <= TRIBOX_INT64_BITS)
        return tribox_exact_int64(&in, axes);
#if defined(__SIZEOF_INT128__)
    if (in.bits <= TRIBOX_INT128_BITS)
        return tribox_exact_int128(&in, axes);
#endif
    return tribox_exact_limbs(&in, axes);
}

bool tribox_exact_overlap(const tribox_pair *pair, unsigned axes)
{
    if ((axes & TRIBOX_AXES_BOX) && tribox_apart_on_box_normals(pair))
        return false;
    const tribox_verdict verdict = tribox_exact_double(pair, axes);
    return verdict == TRIBOX_UNDECIDED ? overlap_in_integers(pair, axes) : verdict == TRIBOX_OVERLAPPING;
}
