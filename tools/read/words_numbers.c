/* words_numbers.c - reads numbers: a word is a number from its first character to its last, and rounded but once. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "words.h"

/* Every integer of 15 digits is a double, and so is every power of ten up to the 22nd. */
enum { DIGITS_EXACT = 15, POWER_EXACT = 22, EXPONENT_MAX = 9999 };
static const double powers[POWER_EXACT + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                               1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* A number as it is written: digits times a power of ten. */
typedef struct decimal {
    uint64_t digits; /* of no use where there are more than DIGITS_EXACT */
    int count;       /* of the digits from the first that is not 0 */
    long exponent;
    bool is_negative;
} decimal;

/* Returns false where the word is something else, such as nan or 0x1p4. */
static bool read_decimal(const words *w, decimal *d)
{
    const char *c = w->word, *const end = w->word + w->length;
    bool has_point = false, has_digit = false;
    *d = (decimal){.is_negative = w->length && *c == '-'};
    c += w->length && (*c == '-' || *c == '+');
    for (; c < end && ((*c >= '0' && *c <= '9') || (*c == '.' && !has_point)); c++) {
        if (*c == '.') {
            has_point = true;
            continue;
        }
        has_digit = true;
        d->digits = 10 * d->digits + (uint64_t)(*c - '0');
        d->count += d->count || *c != '0';
        d->exponent -= has_point;
    }
    if (c < end && (*c == 'e' || *c == 'E')) {
        char *rest;
        const long exponent = strtol(c + 1, &rest, 10);
        if (exponent < -EXPONENT_MAX || exponent > EXPONENT_MAX)
            return false;
        d->exponent += exponent;
        c = rest > c + 1 ? rest : c;
    }
    return has_digit && c == end;
}

/* One operation on doubles that are exact, so that the result is the double nearest to the decimal; false where it takes more. */
static bool round_decimal(const decimal *d, double *number)
{
    if (d->count > DIGITS_EXACT || d->exponent < -POWER_EXACT || d->exponent > POWER_EXACT)
        return false;
    const double digits = (double)d->digits;
    *number = d->exponent < 0 ? digits / powers[-d->exponent] : digits * powers[d->exponent];
    *number = d->is_negative ? -*number : *number;
    return true;
}

/* Whether rounding to double and then to float may give another float than rounding at once. */
static bool may_round_twice(double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    const bool is_halfway = (bits & 0x1FFFFFFF) == 0x10000000;
    return is_halfway || (number != 0 && !(fabs(number) >= (double)FLT_MIN && fabs(number) <= (double)FLT_MAX));
}

static bool read_double(const words *w, double *number)
{
    char *end;
    *number = strtod(w->word, &end);
    return w->length && end == w->word + w->length;
}

bool words_number(const words *w, double *number)
{
    decimal d;
    return (read_decimal(w, &d) && round_decimal(&d, number)) || read_double(w, number);
}

bool words_coordinate(const words *w, float *number, double *moved)
{
    decimal d;
    double exact;
    const bool is_decimal = read_decimal(w, &d), is_rounded = is_decimal && round_decimal(&d, &exact);
    *moved = 0;
    if (!is_rounded && !read_double(w, &exact))
        return false;
    *number = is_rounded && !may_round_twice(exact) ? (float)exact : strtof(w->word, NULL);
    /* Numbers of FLT_DIG digits all come back. A little more than half a last place, since what is compared is rounded, too. */
    if (is_decimal && d.count > FLT_DIG && isfinite(*number)) {
        const double distance = fabs(exact - (double)*number);
        *moved = distance > 0.501 * pow(10, (double)d.exponent) ? distance : 0;
    }
    return true;
}
