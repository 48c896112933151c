/* nodes_avx2.c - the nodes of an index, in float with AVX2. */
#include "vec_avx2.h"
#define KERNEL avx2
#include "kernel/nodes_text.h"
