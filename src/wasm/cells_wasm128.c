/* cells_wasm128.c - cells of grids, in float with WebAssembly SIMD. */
#include "vec_wasm128.h"
#define KERNEL wasm128
#include "kernel/cells_text.h"
