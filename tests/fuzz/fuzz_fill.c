/* fuzz_fill.c - filling, both ways: a soup and a small grid, and any walls. */
#include <math.h>
#include <string.h>

#include "ensure.h"
#include "input.h"
#include "scale/crossing_oracle.h"
#include "target.h"
#include "tight_memory.h"

enum {
    TRIANGLES_MAX = 6,
    WORDS_MAX = 64,
    CELLS_MAX = 130 * 16,
    FLOAT_BITS = 151 /* of means of planes, which are sums of multiples of floats */
};

static crossing_case at;
static bool is_inside[ORACLE_CELLS], is_odd[ORACLE_CELLS];

static double plane(const tribox_grid *grid, int a, uint32_t p) { return fma(p, grid->cell[a], grid->origin[a]); }

static tribox_grid draw_grid(input *in)
{
    static const uint32_t rows[] = {1, 2, 3, 8, 17, 63, 64, 65, 127, 128, 129};
    tribox_grid grid;
    input_doubles(in, grid.origin);
    input_doubles(in, grid.cell);
    grid.size[0] = rows[input_below(in, sizeof rows / sizeof rows[0])];
    grid.size[1] = 1 + input_below(in, 4);
    grid.size[2] = 1 + input_below(in, 4);
    for (int a = 0; a < 3; a++) {
        grid.cell[a] = fabs(grid.cell[a]);
        input_remember(in, (float)(grid.origin[a] + 0.5 * grid.cell[a]));
    }
    return grid;
}

static bool is_sound(const tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        if (!isfinite(grid->origin[a]) || !isfinite(grid->cell[a]) || !(grid->cell[a] > 0))
            return false;
        for (uint32_t p = 0; p < grid->size[a]; p++)
            if (!(plane(grid, a, p) < plane(grid, a, p + 1)) || !isfinite(plane(grid, a, p + 1)))
                return false;
    }
    return true;
}

static bool bit(const uint64_t *words, size_t row, uint32_t i)
{
    return words[row * ((at.size[0] + 63) / 64) + i / 64] >> i % 64 & 1;
}

static void check_parity(const tribox_grid *grid, const tribox_soup *soup, const uint64_t *occupied)
{
    const size_t words = tribox_window_words(grid->size);
    uint64_t *const solid = tight_memory(words * sizeof *solid, 0);
    void *const scratch = tight_memory(tribox_fill_bytes(grid->size), 1);
    size_t inside = 0, odd_rows = 0, expected_inside = 0, expected_odd = 0;
    const tribox_status status = tribox_fill_parity(soup, grid, occupied, scratch, solid, &inside, &odd_rows);
    if (!is_sound(grid)) {
        ensure(status == TRIBOX_BAD_GRID && is_poisoned(solid, words * sizeof *solid), "status %d of a grid that is none", status);
        return;
    }
    ensure(status == TRIBOX_OK, "status %d", status);
    crossing_oracle(&at, is_inside, is_odd);
    for (size_t row = 0; row < (size_t)at.size[1] * at.size[2]; row++) {
        expected_odd += is_odd[row];
        for (uint32_t i = 0; i < (at.size[0] + 63) / 64 * 64; i++) {
            const bool is_cell = i < at.size[0], is_wall = is_cell && bit(occupied, row, i);
            const bool is_filled = is_cell && !is_wall && is_inside[row * at.size[0] + i];
            expected_inside += is_filled;
            ensure(bit(solid, row, i) == (is_wall || is_filled), "cell %u of row %zu", i, row);
        }
    }
    ensure(inside == expected_inside && odd_rows == expected_odd, "%zu inside, %zu odd rows", inside, odd_rows);
}

/* Reached cells take free ones beside them until none is left: on the border of the grid all is beside the outside. */
static size_t spread(const uint64_t *occupied, bool *is_reached)
{
    size_t reached = 0;
    for (bool is_new = true; is_new;) {
        is_new = false;
        for (size_t n = 0; n < (size_t)at.size[0] * at.size[1] * at.size[2]; n++) {
            const size_t row = n / at.size[0], place[3] = {n % at.size[0], row % at.size[1], row / at.size[1]};
            size_t step = 1;
            bool is_beside = false;
            for (int a = 0; a < 3; step *= at.size[a++])
                is_beside = is_beside || !place[a] || place[a] + 1 == at.size[a] || is_reached[n - step] || is_reached[n + step];
            if (is_beside && !is_reached[n] && !bit(occupied, row, (uint32_t)place[0])) {
                is_reached[n] = is_new = true;
                reached++;
            }
        }
    }
    return reached;
}

static void check_outside(const uint64_t *occupied)
{
    static bool is_reached[ORACLE_CELLS];
    const size_t rows = (size_t)at.size[1] * at.size[2], words = rows * ((at.size[0] + 63) / 64);
    uint64_t *const solid = tight_memory(words * sizeof *solid, 0);
    size_t inside = 0, expected = rows * at.size[0];
    memset(is_reached, 0, sizeof is_reached);
    expected -= spread(occupied, is_reached);
    const tribox_status status =
        tribox_fill_outside(at.size, occupied, tight_memory(tribox_fill_bytes(at.size), 3), solid, &inside);
    ensure(status == TRIBOX_OK, "status %d", status);
    for (size_t row = 0; row < rows; row++)
        for (uint32_t i = 0; i < (at.size[0] + 63) / 64 * 64; i++) {
            const bool is_cell = i < at.size[0];
            expected -= is_cell && bit(occupied, row, i);
            ensure(bit(solid, row, i) == (is_cell && !is_reached[row * at.size[0] + i]), "outside: cell %u of row %zu", i, row);
        }
    ensure(inside == expected, "outside: %zu inside, not %zu", inside, expected);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    const tribox_grid grid = draw_grid(&in);
    float u[TRIANGLES_MAX][3][3], streams[9][TRIANGLES_MAX];
    uint64_t *const occupied = tight_memory(tribox_window_words(grid.size) * sizeof *occupied, 0);
    for (size_t w = 0; w < tribox_window_words(grid.size); w++)
        occupied[w] = input_byte(&in) * UINT64_C(0x0102040810204081) * (input_byte(&in) | 1);
    at.count = 0;
    do
        input_triangle(&in, u[at.count++]);
    while (!input_is_over(&in) && at.count < TRIANGLES_MAX);
    tribox_soup soup = {.count = (size_t)at.count};
    for (int t = 0; t < at.count; t++)
        for (int n = 0; n < 9; n++) {
            at.u[t][n / 3][n % 3] = u[t][n / 3][n % 3];
            streams[n][t] = u[t][n / 3][n % 3];
        }
    for (int v = 0; v < 3; v++) {
        soup.x[v] = streams[3 * v];
        soup.y[v] = streams[3 * v + 1];
        soup.z[v] = streams[3 * v + 2];
    }
    memcpy(at.size, grid.size, sizeof at.size);
    at.bits = FLOAT_BITS;
    for (int a = 0; a < 3; a++)
        for (uint32_t n = 0; n < at.size[a]; n++)
            at.middle[a][n] = (plane(&grid, a, n) + plane(&grid, a, n + 1)) / 2;
    check_parity(&grid, &soup, occupied);
    check_outside(occupied);
    tight_memory_free_all();
    return 0;
}
