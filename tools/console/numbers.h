/* numbers.h - numbers of the command line and of files, read strictly and independent of the locale. */
#ifndef NUMBERS_H
#define NUMBERS_H

#include <stdbool.h>
#include <stdint.h>

/* Blanks that may stand around numbers. */
#define NUMBERS_BLANKS " \t\r"

/*
 * Reads `count` finite numbers, separated by commas or blanks, as the nearest doubles. Returns false after a line on standard
 * error. where: what to call the text in messages, such as "--box" or "boxes.txt:7". form: how to write it, such as "X,Y,Z".
 * decimals: NULL, or receives in bit i whether number i is no float but a decimal that the nearest float gives back, as 0.1 is.
 */
bool numbers_read(const char *text, const char *where, const char *form, int count, double *numbers, unsigned *decimals);

/* Replaces these decimals by the nearest floats. */
void numbers_round(double *numbers, int count, unsigned decimals);

/* Whether all of them are floats. */
bool numbers_are_floats(const double *numbers, int count);

/* Reads a text that is one whole number from 1 to most. option: its name, for messages. Returns an exit_code. */
int numbers_read_whole(const char *text, const char *option, uint32_t most, uint32_t *number);

/* Reads what --memory has. Returns an exit_code. */
int numbers_read_memory(const char *text, uint64_t *bytes);

/* The same for NX,NY,NZ. */
int numbers_read_sizes(const char *text, const char *option, uint32_t most, uint32_t sizes[3]);

#endif
