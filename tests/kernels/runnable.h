/* runnable.h - the kernels that this processor runs. */
#ifndef TRIBOX_TESTS_RUNNABLE_H
#define TRIBOX_TESTS_RUNNABLE_H

#include <string.h>

#include "dispatch.h"

enum { RUNNABLE_MOST = 8 };

/* Their names, the scalar one first: it is the reference. Returns how many there are. */
static inline size_t runnable_kernels(const char *names[RUNNABLE_MOST])
{
    size_t count = 0;
    for (size_t i = tribox_kernel_count(); i-- > 0;)
        if (tribox_kernel_runs_here(i) && count < RUNNABLE_MOST)
            names[count++] = tribox_kernel_at(i)->name;
    return count;
}

/* Whether v_fma and v_fms of a kernel round once. */
static inline bool kernel_is_fused(const char *name) { return strcmp(name, "scalar") && strcmp(name, "sse2"); }

#endif
