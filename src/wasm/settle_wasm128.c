/* settle_wasm128.c - what float leaves undecided, in double with WebAssembly SIMD. */
#include "vec_wasm128_double.h"
#define KERNEL wasm128
#include "kernel/settle_text.h"
