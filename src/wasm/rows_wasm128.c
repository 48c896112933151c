/* rows_wasm128.c - cells of grids, in double with WebAssembly SIMD. */
#include "vec_wasm128_double.h"
#define KERNEL wasm128
#include "kernel/rows_text.h"
