/* pages_posix.c - rooms are mapped on the border of a large page, and the system is asked for such, but for small rooms. */
#define _DEFAULT_SOURCE
#include "pages.h"

#include <stdint.h>
#include <sys/mman.h>

/* To take a large page costs as much as 32 small ones do, and many threads that take small ones wait for each other. */
enum { LARGE_PAGE = 1 << 21, SMALL_PAGE = 1 << 12, SMALL_ROOM = 32 * SMALL_PAGE };

static size_t whole_pages(size_t bytes)
{
    const size_t page = bytes < SMALL_ROOM ? SMALL_PAGE : LARGE_PAGE;
    return bytes ? (bytes + page - 1) / page * page : page;
}

static void *map(size_t bytes)
{
    void *const room = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return room == MAP_FAILED ? NULL : room;
}

/*
 * The system maps where it likes: what stands before the border and after the end is given back, or not asked for where it is
 * scarce.
 */
static void *map_on_border(size_t bytes)
{
    unsigned char *const start = map(bytes + LARGE_PAGE);
    if (!start)
        return map(bytes);
    const size_t before = (LARGE_PAGE - (uintptr_t)start % LARGE_PAGE) % LARGE_PAGE;
    if (before)
        munmap(start, before);
    munmap(start + before + bytes, LARGE_PAGE - before);
#ifdef MADV_HUGEPAGE
    madvise(start + before, bytes, MADV_HUGEPAGE); /* a wish: without them it is slower and no other */
#endif
    return start + before;
}

void *pages_take(size_t bytes)
{
    if (bytes > SIZE_MAX / 2)
        return NULL;
    const size_t whole = whole_pages(bytes);
    return bytes < SMALL_ROOM ? map(whole) : map_on_border(whole);
}

void pages_free(void *room, size_t bytes)
{
    if (room)
        munmap(room, whole_pages(bytes));
}
