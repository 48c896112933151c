/* written_number.c - reads numbers: a text is a number from its first character to its last, and rounded but once. */
#include "written_number.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* Every whole number up to 2^53 is a double, and so is every power of ten up to the 22nd; 64 bits hold any 19 digits. */
enum { DIGITS_MAX = 19, POWER_EXACT = 22, EXPONENT_MAX = 9999 };
static const uint64_t whole_exact = UINT64_C(1) << 53;
static const double powers[POWER_EXACT + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                               1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* A number as it is written: digits times a power of ten. */
typedef struct decimal {
    uint64_t digits; /* of no use where there are more than DIGITS_MAX */
    int count;       /* of the digits from the first that is not 0 */
    long exponent;
    bool is_negative;
} decimal;

/* Returns false where the text is something else, such as nan or 0x1p4. */
static bool read_decimal(const char *text, size_t length, decimal *d)
{
    const char *c = text, *const end = text + length;
    bool has_point = false, has_digit = false;
    *d = (decimal){.is_negative = length && *c == '-'};
    c += length && (*c == '-' || *c == '+');
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
    if (d->count > DIGITS_MAX || d->digits > whole_exact || d->exponent < -POWER_EXACT || d->exponent > POWER_EXACT)
        return false;
    const double digits = (double)d->digits;
    *number = d->exponent < 0 ? digits / powers[-d->exponent] : digits * powers[d->exponent];
    *number = d->is_negative ? -*number : *number;
    return true;
}

static bool read_double(const char *text, size_t length, double *number)
{
    char *end;
    *number = strtod(text, &end);
    return length && end == text + length;
}

static double in_last_places(const decimal *d, double distance)
{
    return d->exponent < -POWER_EXACT || d->exponent > POWER_EXACT ? distance / pow(10, (double)d->exponent)
           : d->exponent < 0                                       ? distance * powers[-d->exponent]
                                                                   : distance / powers[d->exponent];
}

/* Normal floats give back every decimal of FLT_DIG digits. */
static float_fit fit_of(const decimal *d, double number)
{
    const float nearest = (float)number;
    if (float_fit_of(number) == FLOAT_FIT_EXACT)
        return FLOAT_FIT_EXACT;
    if (!isfinite(nearest))
        return FLOAT_FIT_NONE;
    if (d->count <= FLT_DIG && fabsf(nearest) >= FLT_MIN)
        return FLOAT_FIT_DECIMAL;
    /* A little more than half a last place, since what is compared is rounded, too. */
    return in_last_places(d, fabs(number - (double)nearest)) <= 0.501 ? FLOAT_FIT_DECIMAL : FLOAT_FIT_NONE;
}

bool written_number_read(const char *text, size_t length, double *number, float_fit *fit)
{
    decimal d;
    const bool is_decimal = read_decimal(text, length, &d);
    if (!(is_decimal && round_decimal(&d, number)) && !read_double(text, length, number))
        return false;
    *fit = is_decimal ? fit_of(&d, *number) : float_fit_of(*number);
    return true;
}
