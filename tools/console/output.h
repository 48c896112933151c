/* output.h - what the program prints on standard output, and whether all of it was written. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include "json.h"
#include "tribox.h"

/* Prints three numbers, so that they read back as the same doubles or, if is_float, the same floats, which they then are. */
void output_point(const double point[3], bool is_float, const char *separator);

/* Prints a box as --box takes it: LX,LY,LZ,HX,HY,HZ. */
void output_box(const tribox_box *box, bool is_float);

/* How triangles were tested: a line of a summary but for its end, and members of a JSON object. */
void output_test(const tribox_options *test);
void output_json_test(json *j, const tribox_options *test);

/* What was subtracted from the mesh: a line of a summary. */
void output_shift(const double shift[3]);

/* Writes out standard output. Returns EXIT_CODE_OK, or EXIT_CODE_FAILURE when anything printed so far was lost. */
int output_flush(void);

/* Prints a text, such as a help, and writes it out. A tab is a blank, or begins a line if what follows would make it too long. */
int output_text(const char *text);

#endif
