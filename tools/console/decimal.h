/* decimal.h - floats and doubles as decimals, for programs that read them back; times and counts as people read them. */
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

enum { DURATION_MAX = 32 }; /* the longest text, with its end */

/* "0.125 ms", "126.7 s", "1 h 05 min". Returns text. */
const char *duration_text(double seconds, char text[DURATION_MAX]);

/* "950", "9.5 thousand", "99 million". Returns text. */
const char *duration_count(double count, char text[DURATION_MAX]);

#endif
