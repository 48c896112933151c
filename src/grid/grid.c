/* grid.c - whether a grid can be served, its cells as boxes, and which cells an interval touches. */
#include "grid_cells.h"

#include <string.h>

#include "base/bits.h"
#include "base/environment.h"
#include "base/finite.h"

#define WORDS_MAX (UINT64_C(1) << 31)

size_t tribox_grid_row_words(const tribox_grid *grid) { return tribox_words_of(grid->size[0]); }

/* SIZE_MAX where the product overflows: such a grid cannot be addressed. */
size_t tribox_grid_words(const tribox_grid *grid)
{
    size_t words = tribox_words_of(grid->size[0]);
    for (int a = 1; a < 3; a++) {
        if (grid->size[a] && words > SIZE_MAX / grid->size[a])
            return SIZE_MAX;
        words *= grid->size[a];
    }
    return words;
}

tribox_box tribox_grid_cell(const tribox_grid *grid, uint32_t i, uint32_t j, uint32_t k)
{
    const uint32_t at[3] = {i, j, k};
    const tribox_environment callers = tribox_environment_enter();
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = tribox_grid_plane(grid, a, at[a]);
        box.hi[a] = tribox_grid_plane(grid, a, (uint64_t)at[a] + 1);
    }
    tribox_environment_leave(callers);
    return box;
}

/* The spacing of floats above a finite magnitude. */
static float spacing_at(float magnitude)
{
    float next;
    uint32_t bits;
    memcpy(&bits, &magnitude, sizeof bits);
    bits++;
    memcpy(&next, &bits, sizeof next);
    return next - magnitude;
}

static float magnitude(float x) { return x < 0 ? -x : x; }

/*
 * No two planes are the same float. Planes lie within half a spacing of floats of their exact places, so cells of two spacings are
 * safe. In finer grids every plane is compared with the one before: 2^25 or so at most, as two must coincide by then (PROOFS.md
 * 7.2).
 */
static bool has_rising_planes(const tribox_grid *grid, int a)
{
    const float first = tribox_grid_plane(grid, a, 0), last = tribox_grid_plane(grid, a, grid->size[a]);
    const float farthest = magnitude(first) > magnitude(last) ? magnitude(first) : magnitude(last);
    if (grid->cell[a] >= 2 * spacing_at(farthest))
        return true;
    float below = first;
    for (uint64_t p = 1; p <= grid->size[a]; p++) {
        const float plane = tribox_grid_plane(grid, a, p);
        if (plane <= below)
            return false;
        below = plane;
    }
    return true;
}

bool tribox_grid_is_sound(const tribox_grid *grid)
{
    for (int a = 0; a < 3; a++)
        if (!tribox_is_finite(grid->origin[a]) || !tribox_is_finite(grid->cell[a]) || !(grid->cell[a] > 0) || !grid->size[a] ||
            !tribox_is_finite(tribox_grid_plane(grid, a, grid->size[a])))
            return false;
    return has_rising_planes(grid, 0) && has_rising_planes(grid, 1) && has_rising_planes(grid, 2);
}

/* Three factors below 2^32, of which the first is below 2^27. */
bool tribox_fits_one_call(const uint32_t size[3])
{
    const uint64_t layer = (uint64_t)tribox_words_of(size[0]) * size[1];
    return !layer || !size[2] || layer <= WORDS_MAX / size[2];
}

/*
 * The cell of a window, -1 to size, in which a number lies, but for the rounding of planes: where the search starts. Never below
 * the first cell that the number touches: a float beyond plane p is beyond origin + p cell, and p cell, of 50 bits in a sound grid,
 * is a double (PROOFS.md 7.2, 7.3).
 */
static int64_t cell_near(const tribox_grid *grid, int a, int64_t first, int64_t size, float x)
{
    const double at = ((double)x - grid->origin[a]) / grid->cell[a];
    return at < (double)first ? -1 : at < (double)(first + size) ? (int64_t)at - first : size;
}

tribox_cells tribox_grid_cells(const tribox_grid *grid, int a, int64_t first, int64_t size, float least, float most)
{
    int64_t from = cell_near(grid, a, first, size, least), last = cell_near(grid, a, first, size, most);
    while (from >= 0 && tribox_grid_plane(grid, a, (uint64_t)(first + from)) >= least)
        from--;
    while (last < size && tribox_grid_plane(grid, a, (uint64_t)(first + last + 1)) <= most)
        last++;
    while (last >= 0 && tribox_grid_plane(grid, a, (uint64_t)(first + last)) > most)
        last--;
    return (tribox_cells){from, last};
}
