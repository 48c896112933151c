/* nodes_avx512.c - the nodes of an index, in float with AVX-512F. */
#include "vec_avx512.h"
#define KERNEL avx512
#include "kernel/nodes_text.h"
