/* kernels_here.h - the kernels that this processor runs. */
#ifndef TRIBOX_TESTS_KERNELS_HERE_H
#define TRIBOX_TESTS_KERNELS_HERE_H

#include <assert.h>
#include <stdbool.h>
#include <string.h>

#include "tribox.h"

enum { KERNELS_MAX = 8 };

/* Their names, the scalar one first: it is the reference. Returns how many there are. */
static inline int kernels_here(const char *names[KERNELS_MAX])
{
    int count = 0;
    while (tribox_kernel_list((size_t)count))
        count++;
    assert(0 < count && count <= KERNELS_MAX);
    for (int k = 0; k < count; k++)
        names[k] = tribox_kernel_list((size_t)(count - 1 - k));
    return count;
}

/* Whether v_fma and v_fms of a kernel round once. */
static inline bool kernel_is_fused(const char *name)
{
    return strcmp(name, "scalar") && strcmp(name, "sse2") && strcmp(name, "wasm128");
}

#endif
