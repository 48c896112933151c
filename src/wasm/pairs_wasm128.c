/* pairs_wasm128.c - the kernel of WebAssembly SIMD: everything in float, and the table of what it does. */
#include "vec_wasm128.h"
#define KERNEL wasm128
#include "kernel/pairs_text.h"
