/* processors.c - asks the system how many processors there are. */
#define _POSIX_C_SOURCE 200809L
#include "processors.h"

#include <unistd.h>

unsigned processors_here(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count < THREADS_MAX ? (unsigned)count : THREADS_MAX;
}
