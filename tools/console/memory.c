/* memory.c - sizes of memory for people to read, and lists that grow by doubling. */
#include "system.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool memory_read(const char *text, uint64_t *bytes)
{
    static const char units[] = "KkMmGgTt";
    enum { DIGITS_MOST = 18, BITS_A_UNIT = 10 };
    const size_t digits = strspn(text, "0123456789");
    uint64_t number = 0;
    if (!digits || digits > DIGITS_MOST)
        return false;
    for (size_t i = 0; i < digits; i++)
        number = 10 * number + (uint64_t)(text[i] - '0');
    const char *const unit = text[digits] ? strchr(units, text[digits]) : NULL;
    const int bits = unit ? BITS_A_UNIT * (int)((unit - units) / 2 + 1) : 0;
    *bytes = number << bits;
    const char *end = text + digits + (unit != NULL);
    end += unit && *end == 'B';
    return number && *bytes >> bits == number && !*end;
}

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

void *memory_grow(void *list, size_t needed, size_t *room, size_t size)
{
    enum { LEAST = 1024 };
    if (list && needed <= *room)
        return list;
    const size_t twice = 2 * (*room > LEAST / 2 ? *room : LEAST / 2), wanted = needed > twice ? needed : twice;
    void *const larger = wanted <= SIZE_MAX / size ? realloc(list, wanted * size) : NULL;
    if (larger)
        *room = wanted;
    return larger;
}

/* From a few small pages to a large one, and then twice as many. */
void *memory_grow_pages(void *list, size_t needed, size_t *room, size_t size)
{
    enum { SMALL = 1 << 16, LARGE = 1 << 21 };
    if (list && needed <= *room)
        return list;
    const size_t step = !*room ? SMALL / size : *room < LARGE / size ? LARGE / size : 2 * *room;
    const size_t wanted = needed > step ? needed : step;
    void *const larger = wanted <= SIZE_MAX / size ? pages_take(wanted * size) : NULL;
    if (!larger)
        return NULL;
    if (list)
        memcpy(larger, list, *room * size);
    pages_free(list, *room * size);
    *room = wanted;
    return larger;
}
