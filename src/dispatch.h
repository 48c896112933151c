/* dispatch.h - the table of kernels: names, never lanes. */
#ifndef TRIBOX_DISPATCH_H
#define TRIBOX_DISPATCH_H

#include "kernel.h"

/* Every kernel in this build, widest first, the scalar one last. */
size_t tribox_kernel_count(void);
const tribox_kernel *tribox_kernel_at(size_t i);

/* Whether this processor and this operating system run kernel i. */
bool tribox_kernel_runs_here(size_t i);

/* The kernel of that name, or the widest one for NULL; NULL if it is unknown or cannot run here. */
const tribox_kernel *tribox_kernel_find(const char *name);

#endif
