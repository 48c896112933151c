/* nodes_scalar.c - the nodes of an index, in float with one lane. */
#include "vec_scalar.h"
#define KERNEL scalar
#include "kernel/nodes_text.h"
