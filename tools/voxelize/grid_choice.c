/* grid_choice.c - lays a grid around a mesh. */
#include "grid_choice.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "console/decimal.h"
#include "console/memory.h"
#include "console/message.h"

/* The library serves up to 2^31 words. */
static const double words_max = 0x1p31;

static int bounds_of(const char *path, const tribox_soup *soup, tribox_box *bounds)
{
    *bounds = (tribox_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    for (size_t t = 0; t < soup->count; t++) {
        bool is_finite = true;
        for (int c = 0; c < 9; c++)
            is_finite &= isfinite(streams[c / 3][c % 3][t]) != 0;
        for (int c = 0; is_finite && c < 9; c++) {
            const float x = streams[c / 3][c % 3][t];
            bounds->lo[c / 3] = fminf(bounds->lo[c / 3], x);
            bounds->hi[c / 3] = fmaxf(bounds->hi[c / 3], x);
        }
    }
    return bounds->lo[0] <= bounds->hi[0] ? EXIT_CODE_OK
                                          : message_failure("%s: none of its triangles has finite coordinates", path);
}

/* As tribox_grid states it. */
static float plane(const tribox_grid *grid, int a, double p)
{
    return (float)((double)grid->origin[a] + p * (double)grid->cell[a]);
}

/* The least float with which `cells` of them reach from the origin to hi. */
static float cell_reaching(const tribox_grid *grid, int a, double cells, float hi)
{
    tribox_grid tried = *grid;
    tried.cell[a] = (float)(((double)hi - (double)grid->origin[a]) / cells);
    while (plane(&tried, a, cells) < hi)
        tried.cell[a] = nextafterf(tried.cell[a], INFINITY);
    return tried.cell[a];
}

static int choose_cubes(const char *path, const tribox_box *bounds, uint32_t resolution, tribox_grid *grid)
{
    int longest = 0;
    double sides[3];
    for (int a = 0; a < 3; a++) {
        sides[a] = (double)bounds->hi[a] - (double)bounds->lo[a];
        longest = sides[a] > sides[longest] ? a : longest;
    }
    if (!(sides[longest] > 0))
        return message_failure("%s: the whole mesh lies in one point and has no longest side; give --cell in place of --resolution",
                               path);
    tribox_grid around = *grid;
    memcpy(around.origin, bounds->lo, sizeof around.origin);
    const float cell = cell_reaching(&around, longest, resolution, bounds->hi[longest]);
    for (int a = 0; a < 3; a++)
        grid->cell[a] = cell;
    return EXIT_CODE_OK;
}

/* The least number of cells that reach hi, at least one; where that is too many, more than any grid has. */
static double cells_reaching(const tribox_grid *grid, int a, float hi)
{
    double cells = fmax(1, floor(((double)hi - (double)grid->origin[a]) / (double)grid->cell[a]) - 1);
    while (cells < words_max && plane(grid, a, cells) < hi)
        cells++;
    return cells;
}

static int choose_size(const char *path, const tribox_box *bounds, tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        if (grid->origin[a] > bounds->hi[a])
            return message_failure("%s: the mesh ends at %c = %.9g, before the grid starts at %.9g; move --origin, or give --size",
                                   path, "xyz"[a], (double)bounds -> hi[a], (double)grid -> origin[a]);
        const double cells = cells_reaching(grid, a, bounds->hi[a]);
        grid->size[a] = cells < UINT32_MAX ? (uint32_t)cells : UINT32_MAX;
    }
    return EXIT_CODE_OK;
}

static bool is_served(const tribox_grid *grid)
{
    const tribox_soup nothing = {.count = 0};
    uint64_t none;
    return !tribox_voxelize_layers(&nothing, grid, 0, 0, NULL, &none, NULL);
}

/* A grid whose x axis is axis a of another, as long as there but with cells of the length `cell`; its other axes are plain. */
static tribox_grid one_axis(const tribox_grid *grid, int a, float cell)
{
    const double length = (double)plane(grid, a, grid->size[a]) - (double)grid->origin[a];
    return (tribox_grid){{grid->origin[a], 0, 0}, {cell, 1, 1}, {(uint32_t)fmax(1, ceil(length / (double)cell)), 1, 1}};
}

/* The smallest cell that float can tell apart all along the axis, to a power of two; infinite where none ends below FLT_MAX. */
static float smallest_cell(const tribox_grid *grid, int a)
{
    const float farthest = fmaxf(fabsf(grid->origin[a]), fabsf(plane(grid, a, grid->size[a])));
    float cell = nextafterf(farthest, INFINITY) - farthest;
    for (; isfinite(cell); cell *= 2) {
        const tribox_grid tried = one_axis(grid, a, cell);
        if (is_served(&tried))
            break;
    }
    return cell;
}

static int refuse_axis(const tribox_grid *grid, int a)
{
    char advice[64] = "", number[3][DECIMAL_MAX];
    const float start = grid->origin[a], end = plane(grid, a, grid->size[a]);
    if (!isfinite(end))
        return message_failure("the grid reaches beyond what float holds on the %c axis; choose smaller or fewer cells", "xyz"[a]);
    const float smallest = smallest_cell(grid, a);
    if (isfinite(smallest))
        snprintf(advice, sizeof advice, "choose cells of %s or more, or ", decimal_of(smallest, number[0]));
    return message_failure("the grid is finer than float on the %c axis: near %s it cannot tell cells of %s apart; %smove the mesh "
                           "towards 0",
                           "xyz"[a], decimal_of(fabsf(start) > fabsf(end) ? start : end, number[1]),
                           decimal_of(grid->cell[a], number[2]), advice);
}

/* Finds out why the library refuses the grid. */
static int refuse_floats(const tribox_grid *grid)
{
    int a = 0;
    for (; a < 2; a++) {
        const tribox_grid axis = {{grid->origin[a], 0, 0}, {grid->cell[a], 1, 1}, {grid->size[a], 1, 1}};
        if (!is_served(&axis))
            break;
    }
    return refuse_axis(grid, a);
}

static int check_grid(const tribox_grid *grid)
{
    char bytes[16];
    const double words = ceil(grid->size[0] / 64.0) * grid->size[1] * grid->size[2];
    if (words > words_max)
        return message_failure("a grid of %u x %u x %u cells takes %s, a bit per cell; the most is 16.0 GiB: choose fewer cells",
                               grid->size[0], grid->size[1], grid->size[2],
                               memory_text(words < 0x1p60 ? (uint64_t)(8 * words) : UINT64_MAX, bytes));
    return is_served(grid) ? EXIT_CODE_OK : refuse_floats(grid);
}

int grid_choose(const grid_choice *choice, const char *path, const tribox_soup *soup, tribox_grid *grid)
{
    tribox_box bounds;
    int code = bounds_of(path, soup, &bounds);
    memcpy(grid->origin, choice->has_origin ? choice->origin : bounds.lo, sizeof grid->origin);
    memcpy(grid->cell, choice->cell, sizeof grid->cell);
    memcpy(grid->size, choice->size, sizeof grid->size);
    if (!code && choice->resolution)
        code = choose_cubes(path, &bounds, choice->resolution, grid);
    if (!code && !choice->has_size)
        code = choose_size(path, &bounds, grid);
    return code ? code : check_grid(grid);
}
