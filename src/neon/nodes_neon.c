/* nodes_neon.c - the nodes of an index, in float with NEON. */
#include "vec_neon.h"
#define KERNEL neon
#include "kernel/nodes_text.h"
