/* terminal.h - how the system hands over words and streams. */
#ifndef TERMINAL_H
#define TERMINAL_H

#include <stdbool.h>
#include <stdio.h>

/*
 * Before anything else: from now on streams carry bytes as they are, text is UTF-8. Returns the words of the command line as
 * such.
 */
char **terminal_begin(int *count, char **words);

/* Leaves the console as it was. Called by itself when the program ends or is interrupted, but not when it is terminated. */
void terminal_end(void);

/* Whether a person looks on. */
bool terminal_is(FILE *stream);

#endif
