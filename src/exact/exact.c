/* exact.c - one pair in integers that are wide enough for its numbers: the last stage, which decides everything. */
#include "exact.h"

#include <string.h>

#include "bits.h"

tribox_integer tribox_integer_of(float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    const int field = (int)(bits >> 23 & 0xff);
    int32_t odd = (int32_t)(bits & 0x7fffff) | (field ? 0x800000 : 0);
    if (!odd)
        return (tribox_integer){0, 0};
    const int zeros = (int)tribox_lowest_bit((uint64_t)odd);
    odd >>= zeros;
    return (tribox_integer){bits >> 31 ? -odd : odd, (field ? field : 1) - 150 + zeros};
}

tribox_span tribox_span_of(const tribox_integer *numbers, int count)
{
    tribox_span span = {128, -149};
    for (int k = 0; k < count; k++) {
        const int32_t odd = numbers[k].odd;
        const int end = numbers[k].shift + (int)tribox_bit_length((uint64_t)(odd < 0 ? -odd : odd));
        if (odd && numbers[k].shift < span.least)
            span.least = numbers[k].shift;
        if (odd && end > span.greatest)
            span.greatest = end;
    }
    return span;
}

tribox_integers tribox_integers_of(const tribox_pair *pair)
{
    tribox_integers in;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            in.number[3 * a + j] = tribox_integer_of(pair->u[j][a]);
        in.number[9 + a] = tribox_integer_of(pair->box.lo[a]);
        in.number[12 + a] = tribox_integer_of(pair->box.hi[a]);
    }
    const tribox_span span = tribox_span_of(in.number, 15);
    for (int k = 0; k < 15; k++)
        in.number[k].shift = in.number[k].odd ? in.number[k].shift - span.least : 0;
    in.bits = span.greatest > span.least ? span.greatest - span.least : 0;
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
