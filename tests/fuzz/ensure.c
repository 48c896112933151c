#include "ensure.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void ensure(bool holds, const char *format, ...)
{
    if (holds)
        return;
    va_list values;
    va_start(values, format);
    fputs("broken: ", stderr);
    vfprintf(stderr, format, values);
    fputc('\n', stderr);
    va_end(values);
    abort();
}
