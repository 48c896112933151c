#include "claim.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void claim(bool holds, const char *format, ...)
{
    if (holds)
        return;
    va_list values;
    va_start(values, format);
    fputs("claim broken: ", stderr);
    vfprintf(stderr, format, values);
    fputc('\n', stderr);
    va_end(values);
    abort();
}
