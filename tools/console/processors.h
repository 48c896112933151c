/* processors.h - how many threads can run at once; needs _POSIX_C_SOURCE 200809L. */
#ifndef PROCESSORS_H
#define PROCESSORS_H

#include <unistd.h>

#include "voxelize/layers.h"

static inline unsigned processors_here(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count < LAYERS_THREADS_MOST ? (unsigned)count : LAYERS_THREADS_MOST;
}

#endif
