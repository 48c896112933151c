/* voxelize.c - a soup or a mesh into the cells of a grid, or of a window of it: the calls. */
#include "base/environment.h"
#include "voxelizing.h"

/* What is written. */
typedef struct cells_out {
    uint64_t *occupied;
    uint32_t *ids;  /* or NULL */
    uint32_t first; /* the id of triangle 0 */
} cells_out;

/* Whether that many ids can be addressed. */
static bool have_addresses(const uint32_t size[3])
{
    size_t left = PTRDIFF_MAX / sizeof(uint32_t);
    if (!size[0] || !size[1] || !size[2])
        return true;
    for (int a = 0; a < 3; a++)
        left /= size[a];
    return left;
}

static void set_window(tribox_voxels *v, const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                       const cells_out *out, bool is_counted)
{
    tribox_voxels_begin_window(v, triangles, grid, window, out->occupied);
    v->sinks.is_counted = is_counted;
    if (out->ids)
        tribox_voxels_ask_ids(v, out->ids, out->first);
    if (window->size[0] && window->size[1] && window->size[2])
        tribox_voxels_put_all(v, triangles);
    tribox_voxels_end(v);
}

static tribox_status voxelize(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                              const tribox_options *options, const cells_out *out, tribox_report *report)
{
    tribox_voxels voxels, *const v = &voxels;
    if (!grid || !out->occupied)
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(options, &v->plan);
    if (status)
        return status;
    const tribox_window whole = tribox_whole_window(grid), *const asked = window ? window : &whole;
    const tribox_environment callers = tribox_environment_enter();
    status = tribox_grid_check_window(grid, asked);
    if (!status && out->ids && !have_addresses(asked->size))
        status = TRIBOX_BAD_GRID;
    if (!status && !tribox_triangles_have_vertices(triangles, v->plan.kernel))
        status = TRIBOX_BAD_VERTEX;
    if (!status) {
        const tribox_accuracy accuracy = v->plan.accuracy;
        set_window(v, triangles, grid, asked, out, report);
        v->plan.accuracy = accuracy;
        tribox_plan_report(&v->plan, v->counts, report);
    }
    tribox_environment_leave(callers);
    return status;
}

tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                              const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    const cells_out out = {.occupied = occupied};
    tribox_triangles triangles;
    return tribox_triangles_of_soup(soup, &triangles) ? voxelize(&triangles, grid, window, options, &out, report)
                                                      : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_voxelize(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_window *window,
                                   const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    const cells_out out = {.occupied = occupied};
    tribox_triangles triangles;
    return tribox_triangles_of_mesh(mesh, &triangles) ? voxelize(&triangles, grid, window, options, &out, report)
                                                      : TRIBOX_BAD_ARGUMENT;
}

/* No triangle has the number UINT32_MAX, which stands for none. */
static tribox_status voxelize_ids(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                                  const tribox_options *options, const cells_out *out, tribox_report *report)
{
    return out->ids && triangles->count <= UINT32_MAX - out->first ? voxelize(triangles, grid, window, options, out, report)
                                                                   : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_voxelize_ids(const tribox_soup *soup, uint32_t first, const tribox_grid *grid, const tribox_window *window,
                                  const tribox_options *options, uint64_t *occupied, uint32_t *ids, tribox_report *report)
{
    const cells_out out = {occupied, ids, first};
    tribox_triangles triangles;
    return tribox_triangles_of_soup(soup, &triangles) ? voxelize_ids(&triangles, grid, window, options, &out, report)
                                                      : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_voxelize_ids(const tribox_mesh *mesh, uint32_t first, const tribox_grid *grid,
                                       const tribox_window *window, const tribox_options *options, uint64_t *occupied,
                                       uint32_t *ids, tribox_report *report)
{
    const cells_out out = {occupied, ids, first};
    tribox_triangles triangles;
    return tribox_triangles_of_mesh(mesh, &triangles) ? voxelize_ids(&triangles, grid, window, options, &out, report)
                                                      : TRIBOX_BAD_ARGUMENT;
}
