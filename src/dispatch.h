/* dispatch.h - the table of kernels: names, never lanes. */
#ifndef TRIBOX_DISPATCH_H
#define TRIBOX_DISPATCH_H

#include "kernel.h"

/* Every kernel in this build, widest first, the scalar one last. */
size_t tribox_kernel_count(void);
const tribox_kernel *tribox_kernel_at(size_t i);

/* Whether this processor and this operating system run kernel i, and its compiler has left its arithmetic as it is written. */
bool tribox_kernel_runs_here(size_t i);

/* The kernel of that name, or the widest one for NULL; NULL if it is unknown or does not run here. */
const tribox_kernel *tribox_kernel_find(const char *name);

/* The widest one, and one even where none is trusted: for what rounds nothing, or promises nothing of it. */
const tribox_kernel *tribox_kernel_any(void);

#endif
