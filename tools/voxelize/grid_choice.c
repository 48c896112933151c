/* grid_choice.c - lays a grid around a mesh: in floats where they do, else in doubles. */
#include "grid_choice.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "console/decimal.h"
#include "console/message.h"
#include "console/numbers.h"
#include "write/voxels.h"

/* Of an axis. */
static const double cells_max = 0x1p31;

/* A grid that is being chosen. Its numbers and planes are floats if is_float. */
typedef struct draft {
    tribox_grid_f64 grid;
    bool is_float;
} draft;

static int bounds_of(const char *path, const mesh *m, tribox_box *bounds)
{
    return mesh_bounds(m, bounds) ? EXIT_CODE_OK : message_failure("%s: none of its triangles has finite coordinates", path);
}

/* As tribox_grid and tribox_grid_f64 state it; p is whole. The library rounds once, which not every libm's fma does. */
static double plane(const draft *d, int a, double p)
{
    const double origin = d->grid.origin[a], cell = d->grid.cell[a];
    const tribox_grid_f64 axis = {{origin, 0, 0}, {cell, 1, 1}, {UINT32_MAX, 1, 1}};
    return d->is_float ? (double)(float)(origin + p * cell) : tribox_grid_cell_f64(&axis, (uint32_t)p, 0, 0).lo[0];
}

static double next(const draft *d, double number)
{
    return d->is_float ? (double)nextafterf((float)number, INFINITY) : nextafter(number, INFINITY);
}

/* (to - from) / step, where the difference alone may overflow. */
static double steps(double from, double to, double step)
{
    return isfinite(to - from) ? (to - from) / step : to / step - from / step;
}

/* The least cell with which `cells` of them reach from the origin to hi. */
static double cell_reaching(const draft *d, int a, double cells, double hi)
{
    draft tried = *d;
    double *const cell = &tried.grid.cell[a];
    *cell = steps(tried.grid.origin[a], hi, cells);
    *cell = d->is_float ? (double)(float)*cell : *cell;
    while (plane(&tried, a, cells) < hi)
        *cell = next(&tried, *cell);
    return *cell;
}

static int choose_cubes(const char *path, const tribox_box *bounds, uint32_t resolution, draft *d)
{
    int longest = 0;
    double sides[3];
    for (int a = 0; a < 3; a++) {
        sides[a] = bounds->hi[a] - bounds->lo[a];
        longest = sides[a] > sides[longest] ? a : longest;
    }
    if (!(sides[longest] > 0))
        return message_failure("%s: the whole mesh lies in one point and has no longest side; give --cell in place of --resolution",
                               path);
    draft around = *d;
    memcpy(around.grid.origin, bounds->lo, sizeof around.grid.origin);
    const double cell = cell_reaching(&around, longest, resolution, bounds->hi[longest]);
    for (int a = 0; a < 3; a++)
        d->grid.cell[a] = cell;
    return EXIT_CODE_OK;
}

/* The least number of cells that reach hi, at least one; where that is too many, more than any grid has. */
static double cells_reaching(const draft *d, int a, double hi)
{
    double cells = fmax(1, floor(steps(d->grid.origin[a], hi, d->grid.cell[a])) - 1);
    while (cells < cells_max && plane(d, a, cells) < hi)
        cells++;
    return cells;
}

static int choose_size(const char *path, const tribox_box *bounds, draft *d)
{
    char end[DECIMAL_MAX], start[DECIMAL_MAX];
    for (int a = 0; a < 3; a++) {
        if (d->grid.origin[a] > bounds->hi[a])
            return message_failure("%s: the mesh ends at %c = %s, before the grid starts at %s; move --origin, or give --size",
                                   path, "xyz"[a], decimal_of_double(bounds->hi[a], end),
                                   decimal_of_double(d->grid.origin[a], start));
        const double cells = cells_reaching(d, a, bounds->hi[a]);
        if (!(cells < cells_max))
            return message_failure("the grid has more than %.0f cells along the %c axis; choose larger cells", cells_max, "xyz"[a]);
        d->grid.size[a] = (uint32_t)cells;
    }
    return EXIT_CODE_OK;
}

static bool is_served(const draft *d) { return voxels_are_served(&d->grid, d->is_float, NULL); }

/* A grid whose x axis is axis a of another, as long as there but with cells of the length `cell`; its other axes are plain. */
static draft one_axis(const draft *d, int a, double cell)
{
    const double length = plane(d, a, d->grid.size[a]) - d->grid.origin[a], cells = fmax(1, ceil(length / cell));
    return (draft){{{d->grid.origin[a], 0, 0}, {cell, 1, 1}, {cells < UINT32_MAX ? (uint32_t)cells : UINT32_MAX, 1, 1}},
                   d->is_float};
}

/* The smallest cell that double can tell apart all along the axis, to a power of two; infinite where none ends in its range. */
static double smallest_cell(const draft *d, int a)
{
    const double farthest = fmax(fabs(d->grid.origin[a]), fabs(plane(d, a, d->grid.size[a])));
    double cell = nextafter(farthest, INFINITY) - farthest;
    for (; isfinite(cell); cell *= 2) {
        const draft tried = one_axis(d, a, cell);
        if (is_served(&tried))
            break;
    }
    return cell;
}

static int refuse_axis(const draft *d, int a)
{
    char advice[64] = "", number[3][DECIMAL_MAX];
    const double start = d->grid.origin[a], end = plane(d, a, d->grid.size[a]);
    if (!isfinite(end))
        return message_failure("the grid reaches beyond what double holds on the %c axis; choose smaller or fewer cells", "xyz"[a]);
    const double smallest = smallest_cell(d, a);
    if (isfinite(smallest))
        snprintf(advice, sizeof advice, "choose cells of %s or more, or ", decimal_of_double(smallest, number[0]));
    return message_failure(
        "the grid is finer than double on the %c axis: near %s it cannot tell cells of %s apart; %smove the mesh "
        "towards 0",
        "xyz"[a], decimal_of_double(fabs(start) > fabs(end) ? start : end, number[1]),
        decimal_of_double(d->grid.cell[a], number[2]), advice);
}

/* Finds out why the library refuses the grid. */
static int refuse_grid(const draft *d)
{
    int a = 0;
    for (; a < 2; a++) {
        const draft axis = {{{d->grid.origin[a], 0, 0}, {d->grid.cell[a], 1, 1}, {d->grid.size[a], 1, 1}}, d->is_float};
        if (!is_served(&axis))
            break;
    }
    return refuse_axis(d, a);
}

/* Leaves open whether the library serves the grid. */
static int choose(const grid_choice *choice, const char *path, const tribox_box *bounds, draft *d)
{
    int code = EXIT_CODE_OK;
    memcpy(d->grid.origin, choice->has_origin ? choice->origin : bounds->lo, sizeof d->grid.origin);
    memcpy(d->grid.cell, choice->cell, sizeof d->grid.cell);
    memcpy(d->grid.size, choice->size, sizeof d->grid.size);
    if (choice->resolution)
        code = choose_cubes(path, bounds, choice->resolution, d);
    if (!code && !choice->has_size)
        code = choose_size(path, bounds, d);
    return code;
}

/* Decimals that floats give back are these floats. */
static grid_choice in_floats(const grid_choice *choice)
{
    grid_choice own = *choice;
    numbers_round(own.cell, 3, own.cell_decimals);
    numbers_round(own.origin, 3, own.origin_decimals);
    return own;
}

/* What is not given is 0. */
static bool are_floats(const grid_choice *choice)
{
    return numbers_are_floats(choice->cell, 3) && numbers_are_floats(choice->origin, 3);
}

int grid_choose(const grid_choice *choice, const char *path, const mesh *m, tribox_grid_f64 *grid, bool *is_float)
{
    const grid_choice narrow = in_floats(choice);
    draft d = {.is_float = !m->is_double && are_floats(&narrow)};
    tribox_box bounds;
    int code = bounds_of(path, m, &bounds);
    if (!code)
        code = choose(d.is_float ? &narrow : choice, path, &bounds, &d);
    if (!code && d.is_float && !is_served(&d)) {
        d.is_float = false;
        code = choose(choice, path, &bounds, &d);
    }
    *grid = d.grid;
    *is_float = d.is_float;
    return code || is_served(&d) ? code : refuse_grid(&d);
}
