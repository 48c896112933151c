/*
 * large_pages.h - asks Linux for pages of 2 MB where there is room for them. The first touch of each page stops the program, so a
 * fresh grid of 1024 cells a side costs more than its cells do. free() as ever; elsewhere, and for small rooms, nothing happens.
 */
#ifndef LARGE_PAGES_H
#define LARGE_PAGES_H

#include <stddef.h>
#include <stdint.h>
#if defined(__linux__)
#include <sys/mman.h> /* with _DEFAULT_SOURCE defined before the first header */
#endif

/* room: of calloc or malloc, and not touched yet; NULL does no harm. */
static inline void want_large_pages(void *room, size_t bytes)
{
    const uintptr_t page = (uintptr_t)1 << 21, start = ((uintptr_t)room + page - 1) / page * page;
    const uintptr_t end = ((uintptr_t)room + bytes) / page * page;
#if defined(MADV_HUGEPAGE)
    if (room && start < end)
        madvise((char *)room + (start - (uintptr_t)room), end - start, MADV_HUGEPAGE); /* a wish: it may fail */
#else
    (void)start, (void)end;
#endif
}

#endif
