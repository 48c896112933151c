/* test_distrust.c - kernels that fuse products and sums never run, nor does any where the scalar one does: test_distrust [all] */
#include "dispatch.c"

#include <stdio.h>

#if TRIBOX_ON_X86
enum { HAS_SSE2 = 1 };
#else
enum { HAS_SSE2 = 0 };
#endif

static bool is_scalar_right;

static bool is_right(void) { return true; }
static bool is_fused(void) { return false; }
static bool is_scalar(void) { return is_scalar_right; }

/* The table of kernels is the library's, the kernels are not. */
const tribox_kernel tribox_kernel_scalar = {.name = "scalar", .rounds_products = is_scalar},
                    tribox_kernel_sse2 = {.name = "sse2", .rounds_products = is_right},
                    tribox_kernel_avx2 = {.name = "avx2", .rounds_products = is_fused},
                    tribox_kernel_avx512 = {.name = "avx512", .rounds_products = is_fused},
                    tribox_kernel_neon = {.name = "neon", .rounds_products = is_fused},
                    tribox_kernel_wasm128 = {.name = "wasm128", .rounds_products = is_fused};

#define EXPECT(is) ((is) ? 0 : (printf("%s: it is not so that %s\n", argc == 1 ? "some" : "all", #is), 1))

int main(int argc, char **argv)
{
    (void)argv;
    is_scalar_right = argc == 1;
    const tribox_kernel *const best = argc > 1 ? NULL : HAS_SSE2 ? &tribox_kernel_sse2 : &tribox_kernel_scalar;
    return EXPECT(tribox_kernel_find(NULL) == best) |
           EXPECT(tribox_kernel_find("scalar") == (best ? &tribox_kernel_scalar : NULL)) |
           EXPECT(!tribox_kernel_find("avx2") && !tribox_kernel_find("neon") && !tribox_kernel_find("wasm128")) |
           EXPECT(tribox_kernel_any() == (best ? best : &tribox_kernel_scalar)) |
           EXPECT(best ? is_name(tribox_kernel_list(0), best->name) : !tribox_kernel_list(0)) |
           EXPECT(tribox_kernel_runs_here(tribox_kernel_count() - 1) == (best != NULL));
}
