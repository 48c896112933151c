/* pages_windows.c - large pages take a right that few have: these are the usual ones. */
#include "pages.h"

#include <windows.h>

void *pages_take(size_t bytes) { return VirtualAlloc(NULL, bytes ? bytes : 1, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE); }

void pages_free(void *room, size_t bytes)
{
    (void)bytes;
    if (room)
        VirtualFree(room, 0, MEM_RELEASE);
}
