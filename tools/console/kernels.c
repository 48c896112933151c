/* kernels.c - asks the library for each kernel by its name. */
#include "kernels.h"

#include <stddef.h>

#include "tribox.h"

const char *const kernels_known[KERNELS_MAX] = {"avx512", "avx2", "sse2", "neon", "scalar"};

bool kernels_run_here(const char *name) { return tribox_kernel_name(&(tribox_options){.kernel = name}) != NULL; }

int kernels_here(const char **names)
{
    int count = 0;
    for (int i = 0; i < KERNELS_MAX; i++)
        if (kernels_run_here(kernels_known[i]))
            names[count++] = kernels_known[i];
    return count;
}
