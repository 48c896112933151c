/* output.h - what the program prints on standard output: floats, JSON strings, and whether all of it arrived. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include "tribox.h"

/* Prints the shortest decimal that reads back as the very same float. */
void output_float(float number);

/* Prints three numbers. */
void output_point(const float point[3], const char *separator);

/* Prints a box as --box takes it: LX,LY,LZ,HX,HY,HZ. */
void output_box(const tribox_box *box);

/* Prints a box as a JSON object of two arrays, lo and hi. */
void output_json_box(const tribox_box *box);

/* Prints a string as JSON, with its quotes. Bytes that are not UTF-8 become U+FFFD, as JSON has no other bytes. */
void output_json_string(const char *text);

/* Prints the words of the groups of axes, each in quotes such as there are; axes: as in tribox_options. */
void output_axes(unsigned axes, const char *quote, const char *between);

/* Writes out standard output. Returns EXIT_CODE_OK, or EXIT_CODE_FAILURE when anything printed so far was lost. */
int output_flush(void);

/* Prints a text, such as a help, and writes it out. */
int output_text(const char *text);

#endif
