/* grid_options.c - reads which mesh and which grid, and lays the grid around the mesh. */
#include "grid_options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "console/written_number.h"
#include "console/message.h"
#include "console/numbers.h"
#include "write/voxels.h"

/* --------------------------------------------------------------------------------------------------------------------- options */

static int read_cell(const char *text, double cell[3])
{
    const bool is_one = !strpbrk(text, NUMBERS_BLANKS ",");
    if (!numbers_read(text, "--cell", "one number, or three: SX,SY,SZ", is_one ? 1 : 3, cell, NULL))
        return EXIT_CODE_USAGE;
    if (is_one)
        cell[1] = cell[2] = cell[0];
    for (int a = 0; a < 3; a++)
        if (!(cell[a] > 0))
            return message_usage("--cell: %.9g is not greater than 0", cell[a]);
    return EXIT_CODE_OK;
}

int grid_take(grid_request *r, int which, const char *value)
{
    switch (which) {
    case GRID_FORMAT:
        return triangle_format_read(value, &r->format);
    case GRID_SHIFT:
        return mesh_shift_read(value, &r->shift);
    case GRID_RESOLUTION:
        return numbers_read_whole(value, "--resolution", GRID_RESOLUTION_MAX, &r->choice.resolution);
    case GRID_CELL:
        return read_cell(value, r->choice.cell);
    case GRID_ORIGIN:
        r->choice.has_origin = true;
        return numbers_read(value, "--origin", "X,Y,Z", 3, r->choice.origin, NULL) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
    default:
        r->choice.has_size = true;
        return numbers_read_sizes(value, "--size", GRID_CELLS_MAX, r->choice.size);
    }
}

int grid_check(const grid_request *r, const options_found *found, int from)
{
    const bool has_resolution = options_has(found, from + GRID_RESOLUTION), has_cell = options_has(found, from + GRID_CELL);
    if (!r->mesh_path)
        return message_usage("no mesh file given");
    if (triangle_format_check(r->mesh_path, r->format))
        return EXIT_CODE_USAGE;
    if (has_resolution == has_cell)
        return message_usage(has_cell ? "--resolution and --cell exclude each other"
                                      : "no grid given; give --resolution or --cell");
    return EXIT_CODE_OK;
}

int grid_refuse(const grid_request *r, const options_found *found, const option_entry *table, int from)
{
    for (int which = from; which < from + GRID_END; which++)
        if (options_has(found, which))
            return message_usage(
                "%s is a folder, so a partition, which has its grid: leave out --%s; or give meshes by their names", r->mesh_path,
                table[which].name);
    return EXIT_CODE_OK;
}

/* ------------------------------------------------------------------------------------------------------------------------ grid */

/* Of an axis. */
static const double cells_max = 0x1p31;

static int bounds_of(const char *path, const mesh *m, tribox_box *bounds)
{
    return mesh_bounds(m, bounds) ? EXIT_CODE_OK : message_failure("%s: none of its triangles has finite coordinates", path);
}

/* As tribox_grid states it; p is whole. The library rounds once, which not every libm's fma does. */
static double plane(const tribox_grid *grid, int a, double p)
{
    const tribox_grid axis = {{grid->origin[a], 0, 0}, {grid->cell[a], 1, 1}, {UINT32_MAX, 1, 1}};
    return tribox_grid_cell(&axis, (uint32_t)p, 0, 0).lo[0];
}

/* (to - from) / step, where the difference alone may overflow. */
static double steps(double from, double to, double step)
{
    return isfinite(to - from) ? (to - from) / step : to / step - from / step;
}

/* The least cell with which `cells` of them reach from the origin to hi. */
static double cell_reaching(const tribox_grid *grid, int a, double cells, double hi)
{
    tribox_grid tried = *grid;
    double *const cell = &tried.cell[a];
    *cell = steps(tried.origin[a], hi, cells);
    while (plane(&tried, a, cells) < hi)
        *cell = nextafter(*cell, INFINITY);
    return *cell;
}

static int choose_cubes(const char *path, const tribox_box *bounds, uint32_t resolution, tribox_grid *grid)
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
    tribox_grid around = *grid;
    memcpy(around.origin, bounds->lo, sizeof around.origin);
    const double cell = cell_reaching(&around, longest, resolution, bounds->hi[longest]);
    for (int a = 0; a < 3; a++)
        grid->cell[a] = cell;
    return EXIT_CODE_OK;
}

/* The least number of cells that reach hi, at least one; where that is too many, more than any grid has. */
static double cells_reaching(const tribox_grid *grid, int a, double hi)
{
    double cells = fmax(1, floor(steps(grid->origin[a], hi, grid->cell[a])) - 1);
    while (cells < cells_max && plane(grid, a, cells) < hi)
        cells++;
    return cells;
}

static int choose_size(const char *path, const tribox_box *bounds, tribox_grid *grid)
{
    char end[DECIMAL_MAX], start[DECIMAL_MAX];
    for (int a = 0; a < 3; a++) {
        if (grid->origin[a] > bounds->hi[a])
            return message_failure("%s: the mesh ends at %c = %s, before the grid starts at %s; move --origin, or give --size",
                                   path, "xyz"[a], decimal_of_double(bounds->hi[a], end),
                                   decimal_of_double(grid->origin[a], start));
        const double cells = cells_reaching(grid, a, bounds->hi[a]);
        if (!(cells < cells_max))
            return message_failure("the grid has more than %.0f cells along the %c axis; choose larger cells", cells_max, "xyz"[a]);
        grid->size[a] = (uint32_t)cells;
    }
    return EXIT_CODE_OK;
}

static bool is_served(const tribox_grid *grid) { return voxels_are_served(grid, NULL); }

/* A grid whose x axis is axis a of another, as long as there but with cells of the length `cell`; its other axes are plain. */
static tribox_grid one_axis(const tribox_grid *grid, int a, double cell)
{
    const double length = plane(grid, a, grid->size[a]) - grid->origin[a], cells = fmax(1, ceil(length / cell));
    return (tribox_grid){{grid->origin[a], 0, 0}, {cell, 1, 1}, {cells < UINT32_MAX ? (uint32_t)cells : UINT32_MAX, 1, 1}};
}

/* The smallest cell that double can tell apart all along the axis, to a power of two; infinite where none ends in its range. */
static double smallest_cell(const tribox_grid *grid, int a)
{
    const double farthest = fmax(fabs(grid->origin[a]), fabs(plane(grid, a, grid->size[a])));
    double cell = nextafter(farthest, INFINITY) - farthest;
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
    const double start = grid->origin[a], end = plane(grid, a, grid->size[a]);
    if (!isfinite(end))
        return message_failure("the grid reaches beyond what double holds on the %c axis; choose smaller or fewer cells", "xyz"[a]);
    const double smallest = smallest_cell(grid, a);
    if (isfinite(smallest))
        snprintf(advice, sizeof advice, "choose cells of %s or more, or ", decimal_of_double(smallest, number[0]));
    return message_failure(
        "the grid is finer than double on the %c axis: near %s it cannot tell cells of %s apart; %smove the mesh "
        "towards 0",
        "xyz"[a], decimal_of_double(fabs(start) > fabs(end) ? start : end, number[1]), decimal_of_double(grid->cell[a], number[2]),
        advice);
}

/* Finds out why the library refuses the grid. */
static int refuse_grid(const tribox_grid *grid)
{
    int a = 0;
    for (; a < 2; a++) {
        const tribox_grid axis = {{grid->origin[a], 0, 0}, {grid->cell[a], 1, 1}, {grid->size[a], 1, 1}};
        if (!is_served(&axis))
            break;
    }
    return refuse_axis(grid, a);
}

/* Leaves open whether the library serves the grid. */
static int choose(const grid_choice *choice, const char *path, const tribox_box *bounds, tribox_grid *grid)
{
    int code = EXIT_CODE_OK;
    memcpy(grid->origin, choice->has_origin ? choice->origin : bounds->lo, sizeof grid->origin);
    memcpy(grid->cell, choice->cell, sizeof grid->cell);
    memcpy(grid->size, choice->size, sizeof grid->size);
    if (choice->resolution)
        code = choose_cubes(path, bounds, choice->resolution, grid);
    if (!code && !choice->has_size)
        code = choose_size(path, bounds, grid);
    return code;
}

bool grid_is_fixed(const grid_choice *choice) { return choice->has_origin && choice->has_size && !choice->resolution; }

int grid_choose_around(const grid_choice *choice, const char *path, const tribox_box *bounds, tribox_grid *grid)
{
    const int code = choose(choice, path, bounds, grid);
    return code || is_served(grid) ? code : refuse_grid(grid);
}

int grid_choose(const grid_choice *choice, const char *path, const mesh *m, tribox_grid *grid)
{
    tribox_box bounds;
    const int code = grid_is_fixed(choice) ? EXIT_CODE_OK : bounds_of(path, m, &bounds);
    return code ? code : grid_choose_around(choice, path, &bounds, grid);
}
