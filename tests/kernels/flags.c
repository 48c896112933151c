/* flags.c - digests of arithmetic that flags break: two-sums, floats made of doubles, whole numbers, quotients, NaN: refusals.sh */
#include <inttypes.h>
#include <stdio.h>

#include "base/rounded_box.h"
#include "scalar/vec_scalar.h"

#include "kernel/rounding.h"

enum { DRAWS = 20000 };

static uint64_t drawn = 1, digest;

static double draw(void)
{
    drawn = drawn * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return 0x1p-31 * (double)(int64_t)(drawn >> 16) * (drawn >> 63 ? -1 : 1);
}

static void put(const void *from, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++)
        digest = (digest ^ ((const unsigned char *)from)[i]) * UINT64_C(0x100000001b3);
}

static void print(const char *name)
{
    printf("%s %016" PRIx64 "\n", name, digest);
    digest = 0;
}

int main(void)
{
    if (!rounds_products()) {
        puts("products are not rounded");
        return 1;
    }
    for (int i = 0; i < DRAWS; i++) {
        const double cell = fabs(draw()) + 1;
        const tribox_grid grid = {{draw() * cell, cell, draw()}, {cell, cell / 3, cell * 3}, {UINT32_MAX, UINT32_MAX, UINT32_MAX}};
        const tribox_box box = tribox_grid_cell(&grid, (uint32_t)(drawn >> 33), (uint32_t)i / 2, (uint32_t)(drawn >> 40));
        put(&box, sizeof box);
    }
    print("cells");
    for (int i = 0; i < DRAWS; i++) {
        tribox_box box;
        tribox_rounded_box rounded;
        for (int a = 0; a < 3; a++)
            box.hi[a] = (box.lo[a] = draw()) + fabs(draw()) * 0x1p-20;
        tribox_box_round(&box, i % 2, true, &rounded);
        put(&rounded, sizeof rounded);
    }
    print("boxes");
    for (int i = 0; i < DRAWS; i++) {
        const vnum a = v_splat((float)draw()), b = v_splat((float)draw()), nan = v_splat(i % 3 ? NAN : INFINITY),
                   none = v_sub(nan, nan);
        const vnum words[] = {v_nearest(a), v_div(a, v_splat(3)), v_fma(a, b, b), v_fms(b, a, a), v_max(none, b)};
        const vmask masks[] = {v_gt(nan, a), v_gt(none, a), v_is_zero(none)};
        put(words, sizeof words);
        put(masks, sizeof masks);
    }
    print("words");
    return 0;
}
