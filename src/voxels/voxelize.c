/* voxelize.c - a soup or a mesh into the cells of a grid, or of a window of it: the calls. */
#include "base/environment.h"
#include "voxelizing.h"

static tribox_status check_window(const tribox_grid *grid, const tribox_window *window)
{
    if (!tribox_grid_is_sound(grid))
        return TRIBOX_BAD_GRID;
    if (!tribox_grid_has_window(grid, window))
        return TRIBOX_BAD_ARGUMENT;
    return tribox_fits_one_call(window->size) ? TRIBOX_OK : TRIBOX_BAD_GRID;
}

/* Whole layers are taken as layers of the whole grid, so that they have its bits at every accuracy (PROOFS.md 7.9). */
static bool has_whole_layers(const tribox_grid *grid, const tribox_window *window)
{
    return window->size[0] == grid->size[0] && window->size[1] == grid->size[1] && grid->size[2] <= 1 << 30;
}

static void set_window(tribox_voxels *v, const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                       uint64_t *occupied)
{
    if (has_whole_layers(grid, window)) {
        const tribox_window whole = tribox_whole_window(grid);
        tribox_voxels_begin(v, triangles, grid, &whole, occupied);
        tribox_voxels_limit_layers(v, window->first[2], window->size[2]);
    } else {
        tribox_voxels_begin(v, triangles, grid, window, occupied);
    }
    if (window->size[0] && window->size[1] && window->size[2])
        tribox_voxels_put_all(v, triangles);
    tribox_voxels_end(v);
}

static tribox_status voxelize(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                              const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_voxels voxels, *const v = &voxels;
    if (!grid || !occupied)
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(options, &v->plan);
    if (status)
        return status;
    const tribox_window asked = window ? *window : tribox_whole_window(grid);
    const tribox_environment callers = tribox_environment_enter();
    status = check_window(grid, &asked);
    if (!status && !tribox_triangles_have_vertices(triangles, v->plan.kernel))
        status = TRIBOX_BAD_VERTEX;
    if (!status) {
        const tribox_accuracy accuracy = v->plan.accuracy;
        set_window(v, triangles, grid, &asked, occupied);
        v->plan.accuracy = accuracy;
        tribox_plan_report(&v->plan, v->counts, report);
    }
    tribox_environment_leave(callers);
    return status;
}

tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                              const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_triangles triangles;
    return tribox_triangles_of_soup(soup, &triangles) ? voxelize(&triangles, grid, window, options, occupied, report)
                                                      : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_voxelize(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_window *window,
                                   const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_triangles triangles;
    return tribox_triangles_of_mesh(mesh, &triangles) ? voxelize(&triangles, grid, window, options, occupied, report)
                                                      : TRIBOX_BAD_ARGUMENT;
}
