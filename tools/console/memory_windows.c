/* memory_windows.c - the least of what Windows calls available: of memory, of what it commits to, and of addresses. */
#include "memory.h"

#include <windows.h>

static uint64_t least(uint64_t a, uint64_t b) { return a < b ? a : b; }

uint64_t memory_available(void)
{
    MEMORYSTATUSEX about = {.dwLength = sizeof about};
    if (!GlobalMemoryStatusEx(&about))
        return UINT64_MAX;
    return least(about.ullAvailPhys, least(about.ullAvailPageFile, about.ullAvailVirtual));
}
