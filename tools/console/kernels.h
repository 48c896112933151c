/* kernels.h - the kernels that the library may have, and those that this processor runs. */
#ifndef KERNELS_H
#define KERNELS_H

#include <stdbool.h>

enum { KERNELS_MAX = 5 };

/* All names that the library knows on some processor, widest first. */
extern const char *const kernels_known[KERNELS_MAX];

bool kernels_run_here(const char *name);

/* Writes the names that run here, widest first, into names[KERNELS_MAX]. Returns how many. */
int kernels_here(const char **names);

#endif
