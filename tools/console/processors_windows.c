/* processors_windows.c - asks Windows how many processors there are, and the registry for their name. */
#define _WIN32_WINNT 0x0601
#include "processors.h"

#include <stdio.h>
#include <windows.h>

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
