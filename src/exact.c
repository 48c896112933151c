/* exact.c - one pair in integers that are wide enough for its numbers: the last stage, which decides everything. */
#include "exact.h"

#include <string.h>

#include "finite.h"

bool tribox_triangle_is_finite(const float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            if (!tribox_is_finite(u[j][a]))
                return false;
    return true;
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

bool tribox_exact_overlap(const tribox_pair *pair, unsigned axes)
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
