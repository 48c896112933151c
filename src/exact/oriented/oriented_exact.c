/* oriented_exact.c - one triangle and one oriented box in integers that are wide enough for their numbers, or by exact sums. */
#include "oriented.h"

#include <string.h>

#include "base/bits.h"

/*
 * The least and the greatest power of two among numbers: all are multiples of 2^least and below 2^greatest. least > greatest: all
 * zero.
 */
typedef struct power_span {
    int least, greatest;
} power_span;

static tribox_integer integer_of(double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    const int field = (int)(bits >> 52 & 0x7ff);
    uint64_t odd = (bits & UINT64_C(0xfffffffffffff)) | (field ? UINT64_C(1) << 52 : 0);
    if (!odd)
        return (tribox_integer){0, 0};
    const int zeros = (int)tribox_lowest_bit(odd);
    odd >>= zeros;
    return (tribox_integer){bits >> 63 ? -(int64_t)odd : (int64_t)odd, (field ? field : 1) - 1075 + zeros};
}

static power_span span_of(const tribox_integer *numbers, int count)
{
    power_span span = {1024, -1074};
    for (int k = 0; k < count; k++) {
        const int64_t odd = numbers[k].odd;
        const int end = numbers[k].shift + (int)tribox_bit_length((uint64_t)(odd < 0 ? -odd : odd));
        if (odd && numbers[k].shift < span.least)
            span.least = numbers[k].shift;
        if (odd && end > span.greatest)
            span.greatest = end;
    }
    return span;
}

/* Integers of doubles, and their span; then shifts from the least of it. */
static power_span read_integers(const double *from, int count, tribox_integer *to)
{
    for (int k = 0; k < count; k++)
        to[k] = integer_of(from[k]);
    return span_of(to, count);
}

static void count_from(int unit, tribox_integer *numbers, int count)
{
    for (int k = 0; k < count; k++)
        numbers[k].shift = numbers[k].odd ? numbers[k].shift - unit : 0;
}

static tribox_oriented_integers integers_of(const tribox_oriented_pair *pair)
{
    tribox_oriented_integers in;
    double position[12], axis[9];
    for (int k = 0; k < 9; k++)
        position[k] = pair->u[k % 3][k / 3];
    memcpy(position + 9, pair->box.center, 3 * sizeof *position);
    memcpy(axis, pair->box.axis, sizeof axis);
    const power_span positions = read_integers(position, 12, in.position);
    const power_span axes = read_integers(axis, 9, in.axis), halves = read_integers(pair->box.half, 3, in.half);

    /* A difference of positions takes a bit more, the sum of three products two. */
    const bool is_somewhere = positions.least <= positions.greatest && axes.least <= axes.greatest;
    const bool is_thick = halves.least <= halves.greatest;
    const int product = positions.least + axes.least, product_end = positions.greatest + axes.greatest + 3;
    const int unit = !is_somewhere || (is_thick && halves.least < product) ? halves.least : product;
    const int end = !is_somewhere || (is_thick && halves.greatest > product_end) ? halves.greatest : product_end;
    count_from(positions.least, in.position, 12);
    count_from(axes.least, in.axis, 9);
    count_from(unit, in.half, 3);
    if (!is_somewhere) { /* every product is zero, but a shift may be too long for the width that the half lengths take */
        memset(in.position, 0, sizeof in.position);
        memset(in.axis, 0, sizeof in.axis);
    }
    in.shift = is_somewhere ? product - unit : 0;
    in.bits = is_somewhere || is_thick ? end - unit : 0;
    return in;
}

bool tribox_oriented_overlap(const tribox_oriented_pair *pair, unsigned axes)
{
    const tribox_oriented_integers integers = integers_of(pair);
    if (integers.bits <= TRIBOX_INT64_BITS)
        return tribox_oriented_int64(&integers, axes);
#if defined(__SIZEOF_INT128__)
    if (integers.bits <= TRIBOX_INT128_BITS)
        return tribox_oriented_int128(&integers, axes);
#endif
    return tribox_oriented_long(pair, axes);
}
