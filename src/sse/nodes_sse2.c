/* nodes_sse2.c - the nodes of an index, in float with SSE2. */
#include "vec_sse2.h"
#define KERNEL sse2
#include "kernel/nodes_text.h"
