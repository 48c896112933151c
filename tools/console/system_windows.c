/* system_windows.c - what the program asks Windows about processors and memory. */
#define _WIN32_WINNT 0x0601
#include "system.h"

#include <stdio.h>
#include <windows.h>

/* ------------------------------------------------------------------------------------------------------------------- processors */

unsigned processors_here(void)
{
    const DWORD count = GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
    return count < 1 ? 1 : count < THREADS_MAX ? (unsigned)count : THREADS_MAX;
}

void processors_name(char *name, size_t size)
{
    DWORD bytes = (DWORD)size;
    if (RegGetValueA(HKEY_LOCAL_MACHINE, "HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0", "ProcessorNameString", RRF_RT_REG_SZ,
                     NULL, name, &bytes))
        snprintf(name, size, "unknown");
}

/* ----------------------------------------------------------------------------------------------------------------------- memory */

static uint64_t least(uint64_t a, uint64_t b) { return a < b ? a : b; }

uint64_t memory_available(void)
{
    MEMORYSTATUSEX about = {.dwLength = sizeof about};
    if (!GlobalMemoryStatusEx(&about))
        return UINT64_MAX;
    return least(about.ullAvailPhys, least(about.ullAvailPageFile, about.ullAvailVirtual));
}

/* ------------------------------------------------------------------------------------------------------------------------ pages */

/* Large pages take a right that few have: these are the usual ones. */
void *pages_take(size_t bytes) { return VirtualAlloc(NULL, bytes ? bytes : 1, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE); }

void pages_free(void *room, size_t bytes)
{
    (void)bytes;
    if (room)
        VirtualFree(room, 0, MEM_RELEASE);
}
