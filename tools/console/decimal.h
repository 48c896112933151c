/* decimal.h - floats and doubles as decimals, for people and for programs that read them back. */
#ifndef DECIMAL_H
#define DECIMAL_H

enum { DECIMAL_MAX = 32 }; /* the longest text, with its end */

/*
 * Writes the shortest decimal that reads back as the same float, without an exponent where 1e-5 <= |number| < 1e9: "10", "557820",
 * "1e+10". Returns text.
 */
const char *decimal_of(float number, char text[DECIMAL_MAX]);

/* The same for a double. */
const char *decimal_of_double(double number, char text[DECIMAL_MAX]);

#endif
