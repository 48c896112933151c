/* written_number.c - reads numbers: a text is a number from its first character to its last, and rounded but once. */
#include "written_number.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "digits.h"

/* Every whole number up to 2^53 is a double, and so is every power of ten up to the 22nd; 64 bits hold any 19 digits. */
enum { DIGITS_MAX = 19, POWER_EXACT = 22, EXPONENT_MAX = 9999, SHORT = 1000000 /* of FLT_DIG digits */ };
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

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 uint128;
enum { FIVES_MAX = 27 }; /* powers of five that 64 bits hold */

static uint64_t five_to(int n)
{
    static const uint32_t low[] = {1, 5, 25, 125, 625, 3125, 15625, 78125, 390625, 1953125};
    uint64_t power = low[n % 9];
    for (; n >= 9; n -= 9)
        power *= low[9];
    return power;
}

/*
 * The top of an exact product or quotient, at least 62 bits of it, with whether there is more below: that only matters where the
 * bits shown stand halfway between two doubles, so the conversion rounds as if it saw all. Such numbers are far from the ends of
 * the range, and the scale is exact.
 */
static double round_top(uint64_t top, bool is_more, int scale) { return ldexp((double)(top | is_more), scale); }

/* digits times 5^n times 2^n */
static double round_product(uint64_t digits, int n)
{
    const uint128 product = (uint128)digits * five_to(n);
    const uint64_t high = (uint64_t)(product >> 64), low = (uint64_t)product;
    const int zeros = high ? __builtin_clzll(high) : 64 + __builtin_clzll(low);
    const uint128 whole = product << zeros;
    return round_top((uint64_t)(whole >> 64), (uint64_t)whole != 0, 64 - zeros + n);
}

/* digits by 5^n by 2^n: both are moved up to the top of 64 bits, so that the quotient has 63 or 64. */
static double round_quotient(uint64_t digits, int n)
{
    const uint64_t five = five_to(n);
    const int up = __builtin_clzll(digits), down = __builtin_clzll(five);
    const uint128 dividend = (uint128)(digits << up) << 63;
    const uint64_t divisor = five << down;
    return round_top((uint64_t)(dividend / divisor), dividend % divisor != 0, down - up - n - 63);
}

/* Digits that are no double are rounded with what they are multiplied or divided by, at once. */
static bool round_long(const decimal *d, double *number)
{
    if (d->count > DIGITS_MAX || !d->digits || d->exponent < -FIVES_MAX || d->exponent > FIVES_MAX)
        return false;
    *number = d->exponent < 0 ? round_quotient(d->digits, (int)-d->exponent) : round_product(d->digits, (int)d->exponent);
    *number = d->is_negative ? -*number : *number;
    return true;
}
#else
static bool round_long(const decimal *d, double *number)
{
    (void)d;
    (void)number;
    return false;
}
#endif

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
    if (!(is_decimal && (round_decimal(&d, number) || round_long(&d, number))) && !read_double(text, length, number))
        return false;
    *fit = is_decimal ? fit_of(&d, *number) : float_fit_of(*number);
    return true;
}

static const char *scan_exponent(const char *text, long *exponent)
{
    const bool is_negative = *text == '-';
    uint64_t number = 0;
    const char *const first = text + (*text == '-' || *text == '+'), *const end = digits_scan(first, &number);
    if (end == first || end > first + 4)
        return NULL;
    *exponent += is_negative ? -(long)number : (long)number;
    return end;
}

/* Zeros before the first digit that is none do not count: 0.00123 has three digits. */
static bool are_few(const char *c, const char *end)
{
    while (c < end && (*c == '0' || *c == '.'))
        c++;
    return end - c - (memchr(c, '.', (size_t)(end - c)) != NULL) <= DIGITS_MAX;
}

static const char *scan_decimal(const char *text, decimal *d)
{
    *d = (decimal){.is_negative = *text == '-'};
    const char *const first = text + (*text == '-' || *text == '+'), *end = digits_scan(first, &d->digits);
    const bool has_point = *end == '.';
    if (has_point) {
        const char *const point = end;
        end = digits_scan(point + 1, &d->digits);
        d->exponent = -(long)(end - point - 1);
    }
    if (end - first <= has_point || (end - first > DIGITS_MAX && !are_few(first, end)))
        return NULL;
    d->count = d->digits < SHORT ? FLT_DIG : DIGITS_MAX; /* all that fit_of asks for */
    return *end == 'e' || *end == 'E' ? scan_exponent(end + 1, &d->exponent) : end;
}

const char *written_number_scan(const char *text, double *number, float_fit *fit)
{
    decimal d;
    const char *const end = scan_decimal(text, &d);
    if (!end || !(round_decimal(&d, number) || round_long(&d, number)))
        return NULL;
    const bool is_usual = d.digits && d.digits < SHORT && d.exponent >= -POWER_EXACT && d.exponent <= POWER_EXACT;
    if (*fit == FLOAT_FIT_EXACT || (*fit == FLOAT_FIT_DECIMAL && !is_usual)) {
        const float_fit own = fit_of(&d, *number);
        *fit = own > *fit ? own : *fit;
    }
    return end;
}
