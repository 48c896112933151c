/* memory.c - sizes of memory for people to read. */
#include "memory.h"

#include <stdio.h>

const char *memory_text(uint64_t bytes, char text[16])
{
    static const char *const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    int unit = 0;
    double size = (double)bytes;
    for (; size >= 1024; unit++)
        size /= 1024;
    snprintf(text, 16, unit && size < 100 ? "%.1f %s" : "%.0f %s", size, units[unit]);
    return text;
}
