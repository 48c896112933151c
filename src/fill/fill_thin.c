/*
 * fill_thin.c - thin surfaces: the cells that hold a crossing of the surface with a line through their middle, along x, y or z. The
 * lines are the rays of parity, and what tells the cell are its planes in place of its middle.
 */
#include "base/environment.h"
#include "fill_crossings.h"
#include "grid/triangles.h"
#include "plan.h"

/* x, y and z stand for axes `along` and those after it. */
static void start_along(tribox_crossings *c, int along, const tribox_kernel *kernel, const tribox_grid *grid,
                        const tribox_window *window, uint64_t *occupied)
{
    tribox_grid seen_grid = *grid;
    tribox_window seen_window = *window;
    for (int a = 0; a < 3; a++) {
        const int from = (along + a) % 3;
        seen_grid.origin[a] = grid->origin[from];
        seen_grid.cell[a] = grid->cell[from];
        seen_grid.size[a] = grid->size[from];
        seen_window.first[a] = window->first[from];
        seen_window.size[a] = window->size[from];
    }
    c->handlers = &tribox_exact_crossings;
    c->kernel = kernel;
    c->middles = tribox_marks_of(&seen_grid, &seen_window);
    c->rows = tribox_rows_of(seen_window.size);
    c->solid = NULL;
    c->beyond = occupied; /* nothing is written there but the cells */
    c->cells = (tribox_crossed_cells){.occupied = occupied, .row_words = tribox_words_of(window->size[0]), .along = along};
    memcpy(c->cells.size, window->size, sizeof c->cells.size);
    c->turns.count = 0;
}

static void cross_along(tribox_crossings *c, int along, const tribox_seen_along *read, size_t count)
{
    tribox_seen_along seen;
    for (int a = 0; a < 3; a++)
        memcpy(seen.number[3 * a], read->number[3 * ((along + a) % 3)], 3 * sizeof seen.number[0]);
    tribox_crossings_add(c, &seen, count);
}

/* Returns how many cells were clear before. */
static size_t set_thin(const tribox_triangles *triangles, const tribox_kernel *kernel, const tribox_grid *grid,
                       const tribox_window *window, uint64_t *occupied)
{
    tribox_crossings c[3];
    tribox_seen_along read = {0};
    size_t set = 0;
    for (int along = 0; along < 3; along++)
        start_along(&c[along], along, kernel, grid, window, occupied);
    for (size_t first = 0; first < triangles->count; first += TRIBOX_SEEN_ALONG) {
        const size_t left = triangles->count - first, count = left < TRIBOX_SEEN_ALONG ? left : TRIBOX_SEEN_ALONG;
        tribox_triangles_read(triangles, first, count, read.number[0], TRIBOX_SEEN_ALONG);
        for (int along = 0; along < 3; along++)
            cross_along(&c[along], along, &read, count);
    }
    for (int along = 0; along < 3; along++) {
        tribox_crossings_finish(&c[along]);
        set += c[along].cells.set;
    }
    return set;
}

static tribox_status check_thin(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                                const tribox_plan *plan)
{
    if (plan->accuracy != TRIBOX_EXACT || plan->axes != TRIBOX_AXES_ALL)
        return TRIBOX_BAD_OPTION;
    const tribox_status status = tribox_grid_check_window(grid, window);
    return status || tribox_triangles_have_vertices(triangles, plan->kernel) ? status : TRIBOX_BAD_VERTEX;
}

static tribox_status voxelize_thin(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                                   const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_plan plan;
    if (!grid || !occupied)
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;
    const tribox_window asked = window ? *window : tribox_whole_window(grid);
    const tribox_environment callers = tribox_environment_enter();
    status = check_thin(triangles, grid, &asked, &plan);
    if (!status) {
        const bool has_cells = asked.size[0] && asked.size[1] && asked.size[2];
        const size_t set = has_cells ? set_thin(triangles, plan.kernel, grid, &asked, occupied) : 0;
        if (report)
            *report = (tribox_report){.overlapping = set};
    }
    tribox_environment_leave(callers);
    return status;
}

tribox_status tribox_voxelize_thin(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                                   const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_triangles triangles;
    return tribox_triangles_of_soup(soup, &triangles) ? voxelize_thin(&triangles, grid, window, options, occupied, report)
                                                      : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_voxelize_thin(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_window *window,
                                        const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_triangles triangles;
    return tribox_triangles_of_mesh(mesh, &triangles) ? voxelize_thin(&triangles, grid, window, options, occupied, report)
                                                      : TRIBOX_BAD_ARGUMENT;
}
