/* fill_parity.c - the inside of a surface by the parity of crossings along x: the calls, and from crossings to cells. */
#include "base/environment.h"
#include "fill_crossings.h"
#include "grid/grid_cells.h"
#include "grid/grid_f64.h"
#include "mesh/mesh_input.h"
#include "plan.h"
#include "mesh/positions.h"

/* Every bit that has an odd number of bits at and below it. */
static uint64_t parity_below(uint64_t word)
{
    for (int step = 1; step < 64; step *= 2)
        word ^= word << step;
    return word;
}

/* A row of crossings becomes a row of cells. Returns how many are inside; *is_odd becomes the parity of all. */
static size_t fill_row(const tribox_rows *rows, const uint64_t *occupied, uint64_t *solid, bool *is_odd)
{
    size_t inside = 0;
    uint64_t odd = 0;
    for (size_t w = 0; w < rows->words; w++) {
        const uint64_t parity = (solid[w] ? parity_below(solid[w]) : 0) ^ odd, mask = tribox_row_mask(rows, w);
        const uint64_t surface = occupied[w] & mask, filled = parity & ~surface & mask;
        odd = parity >> 63 ? ~UINT64_C(0) : 0;
        solid[w] = surface | filled;
        inside += tribox_count_most(filled);
    }
    *is_odd = odd;
    return inside;
}

static void fill_rows(const tribox_crossings *c, const uint64_t *occupied, size_t *inside, size_t *odd_rows)
{
    size_t filled = 0, odd = 0;
    for (size_t r = 0; r < c->rows.count; r++) {
        bool is_odd;
        filled += fill_row(&c->rows, occupied + r * c->rows.words, c->solid + r * c->rows.words, &is_odd);
        odd += is_odd != (c->beyond[r / 64] >> r % 64 & 1);
    }
    if (inside)
        *inside = filled;
    if (odd_rows)
        *odd_rows = odd;
}

static void start_crossings(tribox_crossings *c, const tribox_kernel *kernel, const uint32_t size[3], uint64_t *solid,
                            void *scratch)
{
    c->handlers = &tribox_exact_crossings;
    c->kernel = kernel;
    c->rows = tribox_rows_of(size);
    c->solid = solid;
    c->beyond = tribox_fill_row_bits(scratch, &c->rows);
    c->turns.count = 0;
    memset(solid, 0, c->rows.count * c->rows.words * sizeof *solid);
}

static void add_soup(tribox_crossings *c, const tribox_soup *soup)
{
    tribox_seen_along seen = {0};
    for (size_t first = 0; first < soup->count; first += TRIBOX_SEEN_ALONG) {
        const size_t count = soup->count - first < TRIBOX_SEEN_ALONG ? soup->count - first : TRIBOX_SEEN_ALONG;
        for (int n = 0; n < 9; n++) {
            const float *const from = tribox_soup_axis(soup, n / 3)[n % 3] + first;
            for (size_t i = 0; i < count; i++)
                seen.number[n][i] = from[i];
        }
        tribox_crossings_add(c, &seen, count);
    }
}

tribox_status tribox_fill_parity(const tribox_soup *soup, const tribox_grid *grid, const uint64_t *occupied, uint64_t *solid,
                                 void *scratch, size_t *inside, size_t *odd_rows)
{
    tribox_plan plan;
    if (!grid || !occupied || !solid || !scratch || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = tribox_plan_make(NULL, &plan);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    const bool is_served = tribox_fill_is_served(grid->size) && tribox_grid_is_sound(grid);
    if (is_served) {
        tribox_crossings c;
        start_crossings(&c, plan.kernel, grid->size, solid, scratch);
        c.middles = tribox_middles_of(grid, NULL);
        add_soup(&c, soup);
        tribox_crossings_finish(&c);
        fill_rows(&c, occupied, inside, odd_rows);
    }
    tribox_environment_leave(callers);
    return is_served ? TRIBOX_OK : TRIBOX_BAD_GRID;
}

static void add_mesh(tribox_crossings *c, const tribox_mesh *mesh)
{
    tribox_seen_along seen = {0};
    double corner[3 * TRIBOX_SEEN_ALONG][3];
    for (size_t first = 0; first < mesh->count; first += TRIBOX_SEEN_ALONG) {
        const size_t count = mesh->count - first < TRIBOX_SEEN_ALONG ? mesh->count - first : TRIBOX_SEEN_ALONG;
        tribox_mesh_read_corners(mesh, 3 * first, 3 * count, corner);
        for (size_t i = 0; i < 3 * count; i++)
            for (size_t a = 0; a < 3; a++)
                seen.number[3 * a + i % 3][i / 3] = corner[i][a];
        tribox_crossings_add(c, &seen, count);
    }
}

tribox_status tribox_fill_parity_f64(const tribox_mesh *mesh, const tribox_grid_f64 *grid, const uint64_t *occupied,
                                     uint64_t *solid, void *scratch, size_t *inside, size_t *odd_rows)
{
    tribox_plan plan;
    tribox_mesh strided;
    if (!grid || !occupied || !solid || !scratch || !tribox_mesh_take(mesh, &strided))
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(NULL, &plan);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    if (!tribox_fill_is_served(grid->size) || !tribox_grid_f64_is_sound(grid))
        status = TRIBOX_BAD_GRID;
    else if (!tribox_mesh_is_in_range(&strided, plan.kernel, 0, mesh->count))
        status = TRIBOX_BAD_VERTEX;
    if (!status) {
        tribox_crossings c;
        start_crossings(&c, plan.kernel, grid->size, solid, scratch);
        c.middles = tribox_middles_of(NULL, grid);
        add_mesh(&c, &strided);
        tribox_crossings_finish(&c);
        fill_rows(&c, occupied, inside, odd_rows);
    }
    tribox_environment_leave(callers);
    return status;
}
