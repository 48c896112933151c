/* written_number.h - decimals: read as the nearest float and double, and written so that they read back. */
#ifndef WRITTEN_NUMBER_H
#define WRITTEN_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

enum { DECIMAL_MAX = 32 }; /* the longest text, with its end */

/*
 * Writes the shortest decimal that reads back as the same double or, if is_float, the same float, which it then is; without an
 * exponent where 1e-5 <= |number| < 1e9: "10", "557820", "1e+10". Returns text.
 */
const char *decimal_of(double number, bool is_float, char text[DECIMAL_MAX]);

static inline const char *decimal_of_double(double number, char text[DECIMAL_MAX]) { return decimal_of(number, false, text); }

/* Three of them, with a character between. Returns text. */
const char *decimals_of(const double number[3], char between, char text[3 * DECIMAL_MAX]);

enum { DURATION_MAX = 32 }; /* the longest text, with its end */

/* "0.125 ms", "126.7 s", "1 h 05 min". Returns text. */
const char *duration_text(double seconds, char text[DURATION_MAX]);

/* "950", "9.5 thousand", "99 million". Returns text. */
const char *duration_count(double count, char text[DURATION_MAX]);

/* How well float holds a number. A greater value asks for more. */
typedef enum float_fit {
    FLOAT_FIT_EXACT,   /* it is a float, or NaN */
    FLOAT_FIT_DECIMAL, /* no float, but the nearest one, written with as many digits, gives it back: 0.1 */
    FLOAT_FIT_NONE     /* it takes a double: 557820.15 */
} float_fit;

/* Whether a double is a float. */
static inline float_fit float_fit_of(double number)
{
    return (double)(float)number == number || number != number ? FLOAT_FIT_EXACT : FLOAT_FIT_NONE;
}

/*
 * Reads the double nearest to the number that the whole of text[0 .. length) spells; what follows must not continue it. Returns
 * false where it spells none. (float)*number is the float nearest to the text unless *fit is FLOAT_FIT_NONE.
 */
bool written_number_read(const char *text, size_t length, double *number, float_fit *fit);

/*
 * The same, bit for bit, for the number that text begins with: returns where it ends. NULL where it is none, or not one of up to 19
 * digits with the point near them, which written_number_read may know. DIGITS_AHEAD bytes from its end on must be there to be
 * read. fit: raised where it was less.
 */
const char *written_number_scan(const char *text, double *number, float_fit *fit);

#endif
