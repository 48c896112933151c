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

static inline const char *accuracy_name(tribox_accuracy accuracy)
{
    return accuracy == TRIBOX_EXACT ? "EXACT" : accuracy == TRIBOX_CONSERVATIVE ? "CONSERVATIVE" : "FAST";
}

/* The orders of axes that may be asked for, the library's own choice first. */
enum { AXIS_ORDERS = 7 };
static inline unsigned axis_order_at(int k) { return (const unsigned[AXIS_ORDERS]){0, 123, 132, 213, 231, 312, 321}[k]; }

/* Whether v_fma and v_fms of a kernel round once. */
static inline bool kernel_is_fused(const char *name)
{
    return strcmp(name, "scalar") && strcmp(name, "sse2") && strcmp(name, "wasm128");
}

#endif
