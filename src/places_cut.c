/* places_cut.c - the places of a range cut in two across its longest side, by the middle on that axis and then by number. */
#include "places.h"

size_t tribox_places_before_cut(size_t count)
{
    size_t unit = 64;
    while (unit < (count + 63) / 64)
        unit *= 64;
    return count <= 64 ? 0 : (count / unit + 1) / 2 * unit;
}

static float middle_at(const tribox_places *places, int axis, size_t i)
{
    float middle;
    memcpy(&middle, tribox_places_at(places, axis, i), sizeof middle);
    return middle;
}

static uint32_t number_at(const tribox_places *places, size_t i)
{
    uint32_t number;
    memcpy(&number, tribox_places_at(places, 3, i), sizeof number);
    return number;
}

/* The place of a cut: by middle, by number among equal ones, NaN last, as one number. */
static uint64_t key_at(const tribox_places *places, int axis, size_t i)
{
    const float middle = middle_at(places, axis, i);
    uint32_t bits;
    memcpy(&bits, &middle, sizeof bits);
    bits = middle != middle ? UINT32_MAX : bits >> 31 ? ~bits : bits | UINT32_C(0x80000000);
    return (uint64_t)bits << 32 | number_at(places, i);
}

static void swap(const tribox_places *places, size_t i, size_t j)
{
    for (int k = 0; k < 4; k++) {
        uint32_t a, b;
        memcpy(&a, tribox_places_at(places, k, i), sizeof a);
        memcpy(&b, tribox_places_at(places, k, j), sizeof b);
        memcpy(tribox_places_at(places, k, i), &b, sizeof b);
        memcpy(tribox_places_at(places, k, j), &a, sizeof a);
    }
}

/* The axis on which the finite middles lie farthest apart, the first of several. */
static int longest_axis(const tribox_places *places, size_t first, size_t count)
{
    int longest = 0;
    double length[3];
    for (int a = 0; a < 3; a++) {
        float lo = INFINITY, hi = -INFINITY;
        for (size_t i = first; i < first + count; i++) {
            const float middle = middle_at(places, a, i);
            lo = middle < lo ? middle : lo;
            hi = middle > hi ? middle : hi;
        }
        length[a] = (double)hi - (double)lo;
        longest = length[a] > length[longest] ? a : longest;
    }
    return longest;
}

/* The key of which `rank` others are less, byte by byte from the highest: eight passes, whatever the keys are. */
static uint64_t key_of_rank(const tribox_places *places, int axis, size_t first, size_t count, size_t rank)
{
    uint64_t key = 0;
    for (int shift = 56; shift >= 0; shift -= 8) {
        size_t have[256] = {0}, byte = 0;
        for (size_t i = first; i < first + count; i++) {
            const uint64_t other = key_at(places, axis, i);
            have[other >> shift & 255] += shift == 56 || (other ^ key) >> (shift + 8) == 0;
        }
        for (; rank >= have[byte]; byte++)
            rank -= have[byte];
        key |= (uint64_t)byte << shift;
    }
    return key;
}

void tribox_places_cut(const tribox_places *places, size_t first, size_t count)
{
    const int axis = longest_axis(places, first, count);
    const uint64_t pivot = key_of_rank(places, axis, first, count, tribox_places_before_cut(count));
    size_t less = first;
    for (size_t i = first; i < first + count; i++)
        if (key_at(places, axis, i) < pivot)
            swap(places, i, less++);
}

void tribox_places_sort_word(const tribox_places *places, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++)
        for (size_t k = i; k > first; k--) {
            const bool is_wild = isnan(middle_at(places, 0, k)), is_other = isnan(middle_at(places, 0, k - 1));
            if (is_wild != is_other ? is_wild : number_at(places, k - 1) < number_at(places, k))
                break;
            swap(places, k - 1, k);
        }
}
