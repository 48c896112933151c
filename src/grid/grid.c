/* grid.c - whether a grid can be served, its cells as boxes, and which cells an interval touches. */
#include "grid_cells.h"

#include "base/bits.h"
#include "base/environment.h"
#include "base/finite.h"

#define WORDS_MAX (UINT64_C(1) << 31)

/* SIZE_MAX where the product overflows: such a window cannot be addressed. */
size_t tribox_window_words(const uint32_t size[3])
{
    size_t words = tribox_words_of(size[0]);
    for (int a = 1; a < 3; a++) {
        if (size[a] && words > SIZE_MAX / size[a])
            return SIZE_MAX;
        words *= size[a];
    }
    return words;
}

/* Three factors below 2^32, of which the first is below 2^27. */
bool tribox_fits_one_call(const uint32_t size[3])
{
    const uint64_t layer = (uint64_t)tribox_words_of(size[0]) * size[1];
    return !layer || !size[2] || layer <= WORDS_MAX / size[2];
}

bool tribox_grid_has_window(const tribox_grid *grid, const tribox_window *window)
{
    bool is_inside = true;
    for (int a = 0; a < 3; a++)
        is_inside &= window->first[a] <= grid->size[a] && window->size[a] <= grid->size[a] - window->first[a];
    return is_inside;
}

tribox_window tribox_whole_window(const tribox_grid *grid)
{
    return (tribox_window){.size = {grid->size[0], grid->size[1], grid->size[2]}};
}

tribox_planes tribox_planes_of(const tribox_grid *grid, const uint32_t first[3])
{
    tribox_planes planes;
    for (int a = 0; a < 3; a++) {
        planes.origin[a] = grid->origin[a];
        planes.cell[a] = grid->cell[a];
        planes.first[a] = first ? first[a] : 0;
    }
    return planes;
}

tribox_box tribox_grid_cell(const tribox_grid *grid, uint32_t i, uint32_t j, uint32_t k)
{
    const uint32_t at[3] = {i, j, k};
    const tribox_environment callers = tribox_environment_enter();
    const tribox_planes planes = tribox_planes_of(grid, NULL);
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = tribox_plane_at(&planes, a, at[a]);
        box.hi[a] = tribox_plane_at(&planes, a, (int64_t)at[a] + 1);
    }
    tribox_environment_leave(callers);
    return box;
}

static double size_of(double x) { return x < 0 ? -x : x; }

/* The power of two at or below a magnitude, and the spacing of doubles from there to the next power. */
typedef struct binade {
    double from, spacing;
} binade;

static binade binade_of(double size)
{
    binade b;
    double next;
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    bits &= UINT64_C(0x7ff) << 52;
    memcpy(&b.from, &bits, sizeof b.from);
    bits++;
    memcpy(&next, &bits, sizeof next);
    b.spacing = next - b.from;
    return b;
}

/*
 * Planes first to last lie in one binade, and cells are no longer than its spacing: each step is 0 or 1 spacing, so that the two
 * ends tell whether any repeats. Where cell and spacing are one number a step may be 2 after a 0, among the first three (PROOFS.md
 * 7.10).
 */
static bool is_run_rising(const tribox_planes *planes, int a, int64_t first, int64_t last, double spacing)
{
    if (planes->cell[a] > spacing)
        return true;
    for (int64_t p = first; p < last && p < first + 2; p++)
        if (!(tribox_plane_at(planes, a, p + 1) > tribox_plane_at(planes, a, p)))
            return false;
    return (tribox_plane_at(planes, a, last) - tribox_plane_at(planes, a, first)) / spacing >= (double)(last - first);
}

/*
 * No two planes are the same double: if cells are longer than the spacing of doubles at the farthest plane. Otherwise the planes
 * lie in two binades at most, and the first of the binade further up parts them.
 */
static bool has_rising_planes(const tribox_planes *planes, int a, int64_t size)
{
    const double first = tribox_plane_at(planes, a, 0), last = tribox_plane_at(planes, a, size);
    const bool is_falling = first < 0; /* away from zero */
    const binade top = binade_of(is_falling && -first > last ? -first : last);
    if (planes->cell[a] > top.spacing)
        return true;
    int64_t low = -1, high = size + 1; /* planes below and above the parting, where they rise away from zero */
    while (high - low > 1) {
        const int64_t middle = low + (high - low) / 2;
        const bool is_top = size_of(tribox_plane_at(planes, a, middle)) >= top.from;
        *(is_top == is_falling ? &low : &high) = middle;
    }
    const double below = is_falling ? top.spacing : top.spacing / 2, above = is_falling ? top.spacing / 2 : top.spacing;
    return (low < 0 || is_run_rising(planes, a, 0, low, below)) && (high > size || is_run_rising(planes, a, high, size, above));
}

/*
 * Whether axes of ordinary grids are certainly sound, without asking planes: no plane is farther off than `farthest`, but for
 * rounding, where doubles are spaced by 2^-52 of it at most.
 */
static bool is_plainly_sound(const tribox_grid *grid)
{
    bool is_sound = true;
    for (int a = 0; a < 3; a++) {
        const double farthest = size_of(grid->origin[a]) + grid->size[a] * grid->cell[a];
        is_sound &= grid->size[a] && grid->cell[a] >= 0x1p-900 && farthest <= 0x1p900 && grid->cell[a] > farthest * 0x1p-50;
    }
    return is_sound;
}

/* The last plane is finite only if the origin and the cell are. */
bool tribox_grid_is_sound(const tribox_grid *grid)
{
    if (is_plainly_sound(grid))
        return true;
    const tribox_planes planes = tribox_planes_of(grid, NULL);
    for (int a = 0; a < 3; a++)
        if (!(grid->cell[a] > 0) || !grid->size[a] || !tribox_is_finite_double(tribox_plane_at(&planes, a, grid->size[a])) ||
            !has_rising_planes(&planes, a, grid->size[a]))
            return false;
    return true;
}

tribox_status tribox_grid_check_window(const tribox_grid *grid, const tribox_window *window)
{
    if (!tribox_grid_is_sound(grid))
        return TRIBOX_BAD_GRID;
    if (!tribox_grid_has_window(grid, window))
        return TRIBOX_BAD_ARGUMENT;
    return tribox_fits_one_call(window->size) ? TRIBOX_OK : TRIBOX_BAD_GRID;
}

/* How many of planes 0 to size lie below x, or at it where `is_closed`: nearly always as many as the place of x says. */
static int64_t planes_below(const tribox_planes *planes, int a, int64_t size, double x, bool is_closed)
{
    const double place = (x - planes->origin[a]) / planes->cell[a] - planes->first[a];
    int64_t low = -1, high = size + 1, step = 1;
    int64_t at = place > 0 ? place < (double)size ? (int64_t)place : size : 0; /* 0 of a NaN */
    while (high - low > 1) {
        const double plane = tribox_plane_at(planes, a, at);
        const bool is_below = plane < x || (is_closed && plane <= x);
        *(is_below ? &low : &high) = at;
        at = is_below ? low + step : high - step;
        if (at <= low || at >= high)
            at = low + (high - low) / 2;
        step = step <= size ? 2 * step : step;
    }
    return high;
}

tribox_cells tribox_planes_cells(const tribox_planes *planes, int a, int64_t size, double least, double most)
{
    const int64_t last = planes_below(planes, a, size, most, true) - 1, below = planes_below(planes, a, size, least, false) - 1;
    return (tribox_cells){below, last};
}
