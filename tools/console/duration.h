/* duration.h - times and counts as people read them. */
#ifndef DURATION_H
#define DURATION_H

enum { DURATION_MAX = 32 }; /* the longest text, with its end */

/* "0.125 ms", "126.7 s", "1 h 05 min". Returns text. */
const char *duration_text(double seconds, char text[DURATION_MAX]);

/* "950", "9.5 thousand", "99 million". Returns text. */
const char *duration_count(double count, char text[DURATION_MAX]);

#endif
