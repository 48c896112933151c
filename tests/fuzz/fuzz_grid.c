/* fuzz_grid.c - how tribox voxelize lays a grid around a mesh. */
#include <math.h>
#include <string.h>

#include "things.h"
#include "read/mesh.h"
#include "voxelize/grid_options.h"
#include "lines.h"
#include "write/voxels.h"

/* Floats, or doubles close to them. */
static void draw_numbers(input *in, double numbers[3])
{
    input_numbers(in, numbers, 3);
    const unsigned steps = input_byte(in);
    for (int a = 0; a < 3; a++) {
        numbers[a] = isfinite(numbers[a]) ? numbers[a] : 0;
        move_up(&numbers[a], 1, steps >> 2 * a & 3);
    }
}

/* As the command line can say it: sizes and resolutions are not 0, cells are positive and all numbers finite. */
static grid_choice draw_choice(input *in)
{
    grid_choice choice = {.has_origin = input_byte(in) & 1, .has_size = input_byte(in) & 1};
    if (input_byte(in) & 1)
        choice.resolution = 1 + input_byte(in) + 256 * input_byte(in);
    else
        draw_numbers(in, choice.cell);
    if (choice.has_origin)
        draw_numbers(in, choice.origin);
    for (int a = 0; a < 3; a++) {
        choice.cell[a] = choice.cell[a] != 0 ? fabs(choice.cell[a]) : 1;
        choice.size[a] = 1 + input_byte(in);
    }
    return choice;
}

/* A side that the choice leaves open holds the mesh. */
static void check_holds(const grid_choice *choice, const tribox_grid *grid, const things *t)
{
    for (unsigned i = 0; i < t->drawn; i++) {
        const corners u = things_triangle(t, i);
        for (int k = 0; are_finite(u[0], 9) && k < 9; k++) {
            const int axis = k % 3;
            const double x = u[k / 3][axis], end = plane_of(grid, axis, grid->size[axis]);
            ensure(choice->has_origin || x >= grid->origin[axis], "%a lies below the grid, which begins at %a on axis %d", x,
                   grid->origin[axis], axis);
            ensure(choice->has_size || x <= end, "%a lies above the grid, which ends at %a on axis %d", x, end, axis);
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
    things t = {.run = 1};
    do
        input_triangle(&in, t.u[t.drawn++]);
    while (!input_is_over(&in) && t.drawn < DRAWN_MAX);
    t.count = t.drawn;
    things_lay_soup(&t, 0);
    mesh m = {.soup = t.soup, .triangles = t.count};
    mesh_look_all(NULL, 1, &m);
    tribox_grid grid;
    lines_forget();
    const int code = grid_choose(&choice, "a.ply", &m, &grid);
    lines_fit("grid_choose", code);
    if (!code) {
        ensure(voxels_are_served(&grid, NULL), "the library refuses the grid");
        ensure(is_as_chosen(&choice, &grid), "the grid is not the one that was asked for");
        check_holds(&choice, &grid, &t);
    }
    tight_memory_free_all();
    return 0;
}
