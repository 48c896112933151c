/* fill_parity.c - the inside of a surface by the parity of crossings along x: the calls, and from crossings to cells. */
#include "base/environment.h"
#include "fill_crossings.h"
#include "grid/triangles.h"
#include "plan.h"
#include "tribox_threads.h"

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
    for (size_t r = 0; r < c->rows.count; r++) {
        bool is_odd;
        *inside += fill_row(&c->rows, occupied + r * c->rows.words, c->solid + r * c->rows.words, &is_odd);
        *odd_rows += is_odd != (c->beyond[r / 64] >> r % 64 & 1);
    }
}

static void start_crossings(tribox_crossings *c, const tribox_kernel *kernel, const tribox_grid *grid, const tribox_window *window,
                            uint64_t *solid, void *scratch)
{
    c->handlers = &tribox_exact_crossings;
    c->kernel = kernel;
    c->middles = tribox_middles_of(grid, window);
    c->rows = tribox_rows_of(window->size);
    c->solid = solid;
    c->beyond = tribox_fill_row_bits(scratch, &c->rows);
    c->cells = (tribox_crossed_cells){.occupied = NULL};
    c->turns.count = 0;
    memset(solid, 0, c->rows.count * c->rows.words * sizeof *solid);
}

static void cross_all(tribox_crossings *c, const tribox_triangles *triangles)
{
    tribox_seen_along seen = {0};
    for (size_t first = 0; first < triangles->count; first += TRIBOX_SEEN_ALONG) {
        const size_t left = triangles->count - first, count = left < TRIBOX_SEEN_ALONG ? left : TRIBOX_SEEN_ALONG;
        tribox_triangles_read(triangles, first, count, seen.number[0], TRIBOX_SEEN_ALONG);
        tribox_crossings_add(c, &seen, count);
    }
    tribox_crossings_finish(c);
}

static void fill_window(const tribox_triangles *triangles, const tribox_kernel *kernel, const tribox_grid *grid,
                        const tribox_window *window, const uint64_t *occupied, void *scratch, uint64_t *solid, size_t *inside,
                        size_t *odd_rows)
{
    tribox_crossings c;
    *inside = *odd_rows = 0;
    if (!window->size[0] || !window->size[1] || !window->size[2])
        return;
    start_crossings(&c, kernel, grid, window, solid, scratch);
    cross_all(&c, triangles);
    fill_rows(&c, occupied, inside, odd_rows);
}

static tribox_status fill_parity(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                                 const uint64_t *occupied, void *scratch, uint64_t *solid, size_t *inside, size_t *odd_rows)
{
    tribox_plan plan;
    size_t filled, odd;
    if (!grid || !occupied || !scratch || !solid)
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(NULL, &plan);
    if (status)
        return status;
    const tribox_window asked = window ? *window : tribox_whole_window(grid);
    const tribox_environment callers = tribox_environment_enter();
    status = tribox_grid_check_window(grid, &asked);
    if (!status && !tribox_triangles_have_vertices(triangles, plan.kernel))
        status = TRIBOX_BAD_VERTEX;
    if (!status)
        fill_window(triangles, plan.kernel, grid, &asked, occupied, scratch, solid, inside ? inside : &filled,
                    odd_rows ? odd_rows : &odd);
    tribox_environment_leave(callers);
    return status;
}

tribox_status tribox_fill_parity_window(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                                        const uint64_t *occupied, void *scratch, uint64_t *solid, size_t *inside, size_t *odd_rows)
{
    tribox_triangles triangles;
    return tribox_triangles_of_soup(soup, &triangles)
               ? fill_parity(&triangles, grid, window, occupied, scratch, solid, inside, odd_rows)
               : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_fill_parity_window(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_window *window,
                                             const uint64_t *occupied, void *scratch, uint64_t *solid, size_t *inside,
                                             size_t *odd_rows)
{
    tribox_triangles triangles;
    return tribox_triangles_of_mesh(mesh, &triangles)
               ? fill_parity(&triangles, grid, window, occupied, scratch, solid, inside, odd_rows)
               : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_fill_parity(const tribox_soup *soup, const tribox_grid *grid, const uint64_t *occupied, void *scratch,
                                 uint64_t *solid, size_t *inside, size_t *odd_rows)
{
    return tribox_fill_parity_window(soup, grid, NULL, occupied, scratch, solid, inside, odd_rows);
}

tribox_status tribox_mesh_fill_parity(const tribox_mesh *mesh, const tribox_grid *grid, const uint64_t *occupied, void *scratch,
                                      uint64_t *solid, size_t *inside, size_t *odd_rows)
{
    return tribox_mesh_fill_parity_window(mesh, grid, NULL, occupied, scratch, solid, inside, odd_rows);
}
