/* zeroed.h - zeroed memory, or the end of the program with a message. */
#ifndef TRIBOX_TESTS_MEMORY_H
#define TRIBOX_TESTS_MEMORY_H

#include <stdio.h>
#include <stdlib.h>

static inline void *memory_of(size_t count, size_t size)
{
    void *const memory = calloc(count ? count : 1, size);
    if (!memory) {
        fprintf(stderr, "no memory for %zu objects of %zu bytes; the cross-check takes up to half a gigabyte\n", count, size);
        exit(1);
    }
    return memory;
}

#endif
