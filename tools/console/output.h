/* output.h - what the program prints on standard output, and whether all of it was written. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include "json.h"
#include "tribox.h"

/* Prints three numbers, so that they read back as the same doubles or, if is_float, the same floats, which they then are. */
void output_point(const double point[3], bool is_float, const char *separator);

/* Prints a box as --box takes it: LX,LY,LZ,HX,HY,HZ. */
void output_box(const tribox_box *box, bool is_float);

/* Prints the words of groups of axes, as --axes takes them; axes: as in tribox_options. */
void output_axes(unsigned axes);

/* The same as a member "axes", an array of words. */
void output_json_axes(json *j, unsigned axes);

/* Writes out standard output. Returns EXIT_CODE_OK, or EXIT_CODE_FAILURE when anything printed so far was lost. */
int output_flush(void);

/* Prints a text, such as a help, and writes it out. A tab is a blank, or begins a line if what follows would make it too long. */
int output_text(const char *text);

#endif
