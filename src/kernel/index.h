/* index.h - the texts of a kernel about indices, in order. After: a vocabulary of float, and KERNEL, the kernel's name. */
#include "kernel_index.h"
#include "axes.h"
#include "extents.h"
#include "nodes.h"
