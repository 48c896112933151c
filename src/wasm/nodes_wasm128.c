/* nodes_wasm128.c - the nodes of an index, in float with WebAssembly SIMD. */
#include "vec_wasm128.h"
#define KERNEL wasm128
#include "kernel/nodes_text.h"
