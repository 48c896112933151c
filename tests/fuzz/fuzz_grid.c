/* fuzz_grid.c - how tribox voxelize lays a grid around a mesh. */
#include <math.h>
#include <string.h>

#include "answers.h"
#include "ensure.h"
#include "voxelize/grid_choice.h"
#include "lines.h"
#include "tight_memory.h"
#include "target.h"

static float plane(const tribox_grid *grid, int a, uint32_t p)
{
    return (float)((double)grid->origin[a] + p * (double)grid->cell[a]);
}

/* As the command line can say it: sizes and resolutions are not 0, cells are positive and all numbers finite. */
static grid_choice draw_choice(input *in)
{
    grid_choice choice = {.has_origin = input_byte(in) & 1, .has_size = input_byte(in) & 1};
    if (input_byte(in) & 1)
        choice.resolution = 1 + input_byte(in) + 256 * input_byte(in);
    else
        input_numbers(in, choice.cell, 3);
    if (choice.has_origin)
        input_numbers(in, choice.origin, 3);
    for (int a = 0; a < 3; a++) {
        choice.cell[a] = isfinite(choice.cell[a]) && choice.cell[a] != 0 ? fabsf(choice.cell[a]) : 1;
        choice.origin[a] = isfinite(choice.origin[a]) ? choice.origin[a] : 0;
        choice.size[a] = 1 + input_byte(in);
    }
    return choice;
}

/* A side that the choice leaves open holds the mesh. */
static void check_holds(const grid_choice *choice, const tribox_grid *grid, const asked *a)
{
    for (unsigned i = 0; i < a->drawn; i++) {
        const const_triangle u = triangle_of(&a->pair[i]);
        for (int k = 0; triangle_is_finite(u) && k < 9; k++) {
            const int axis = k % 3;
            const float x = u[k / 3][axis];
            ensure(choice->has_origin || x >= grid->origin[axis], "%a lies below the grid, which begins at %a on axis %d",
                   (double)x, (double)grid->origin[axis], axis);
            ensure(choice->has_size || x <= plane(grid, axis, grid->size[axis]),
                   "%a lies above the grid, which ends at %a on axis %d", (double)x, (double)plane(grid, axis, grid->size[axis]),
                   axis);
        }
    }
}

static bool is_as_chosen(const grid_choice *choice, const tribox_grid *grid)
{
    return (!choice->has_origin || !memcmp(grid->origin, choice->origin, sizeof grid->origin)) &&
           (!choice->has_size || !memcmp(grid->size, choice->size, sizeof grid->size)) &&
           (choice->resolution || !memcmp(grid->cell, choice->cell, sizeof grid->cell));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    const grid_choice choice = draw_choice(&in);
    asked a = {.call = "grid_choose"};
    do
        input_triangle(&in, a.pair[a.drawn++].u);
    while (!input_is_over(&in) && a.drawn < PAIRS_DRAWN);
    a.count = a.drawn;
    const tribox_soup soup = asked_soup(&a, 0), nothing = {.count = 0};
    tribox_grid grid;
    uint64_t none;
    lines_forget();
    const int code = grid_choose(&choice, "a.ply", &soup, &grid);
    lines_fit("grid_choose", code);
    if (!code) {
        status_fits("tribox_voxelize_layers", 0, tribox_voxelize_layers(&nothing, &grid, 0, 0, NULL, &none, NULL));
        ensure(is_as_chosen(&choice, &grid), "the grid is not the one that was asked for");
        check_holds(&choice, &grid, &a);
    }
    tight_memory_free_all();
    return 0;
}
