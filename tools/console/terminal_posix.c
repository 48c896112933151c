/* terminal_posix.c - nothing to do: bytes are bytes. */
#define _POSIX_C_SOURCE 200809L
#include "terminal.h"

#include <unistd.h>

char **terminal_begin(int *count, char **words)
{
    (void)count;
    return words;
}

void terminal_end(void) {}

bool terminal_is(FILE *stream) { return isatty(fileno(stream)); }
