/* voxelize.c - a soup into the cells of a grid: the calls. */
#include "voxels.h"

#include "environment.h"
#include "few.h"
#include "grid_cells.h"

static tribox_lattice lattice_of(const tribox_grid *grid)
{
    tribox_lattice lattice;
    for (int a = 0; a < 3; a++) {
        const double lowest = tribox_grid_plane(grid, a, 0), highest = tribox_grid_plane(grid, a, grid->size[a]);
        const double farthest = -lowest > highest ? -lowest : highest;
        lattice.origin[a] = grid->origin[a];
        lattice.per_cell[a] = 1 / (double)grid->cell[a];
        /* planes: half a spacing of floats, and of doubles while they are made; places: three roundings in double. The
         * 0x1.001 alone would cover the other two terms (PROOFS.md 7.2). */
        lattice.error[a] = (0x1.001p-24 * farthest + 0x1p-149) * lattice.per_cell[a] + 0x1p-50 * ((double)grid->size[a] + 4);
    }
    return lattice;
}

static tribox_triangle triangle_at(const tribox_soup *soup, size_t i)
{
    tribox_triangle triangle = {.number = 0};
    for (int n = 0; n < 9; n++)
        triangle.u[n] = tribox_soup_axis(soup, n / 3)[n % 3][i];
    return triangle;
}

bool tribox_voxels_make_float(tribox_voxels *v, const float origin[3])
{
    tribox_float_lattice *const f = &v->in_float;
    bool is = true;
    for (int a = 0; a < 3; a++) {
        f->origin[a] = origin[a];
        f->per_cell[a] = (float)v->lattice.per_cell[a];
        f->size[a] = (float)v->size[a];
        f->error[a] = (float)v->lattice.error[a] * 1.001f;
        f->doubt[a] = f->error[a] + (f->size[a] + 1) * 0x1p-22f;
        is &= v->size[a] <= 1 << 20 && f->per_cell[a] >= 0x1p-100f && f->per_cell[a] <= 0x1p100f && f->doubt[a] < 0.5f;
    }
    return is;
}

static void set_soup(tribox_voxels *v, const tribox_soup *soup)
{
    if (tribox_voxels_make_float(v, v->grid->origin) && soup->count) {
        const tribox_cells_kernel *const cells = v->plan.kernel->cells;
        tribox_few few;
        cells->sort(v, tribox_few_triangles(soup, v->plan.kernel, &few));
        cells->finish(v);
    } else {
        for (size_t i = 0; i < soup->count; i++) {
            const tribox_triangle triangle = triangle_at(soup, i);
            tribox_voxels_add(v, &triangle);
        }
    }
    tribox_voxels_set_strips(v);
}

/* Without the box normals a triangle may overlap cells anywhere: every cell is tested by its own box. */
static void set_soup_by_cells(tribox_voxels *v, const tribox_soup *soup)
{
    for (size_t i = 0; i < soup->count; i++) {
        const tribox_triangle triangle = triangle_at(soup, i);
        tribox_voxels_wait_everywhere(v, &triangle);
    }
}

tribox_status tribox_voxelize_layers(const tribox_soup *soup, const tribox_grid *grid, uint32_t first, uint32_t layers,
                                     const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_voxels voxels, *const v = &voxels;
    if (!grid || !occupied || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = tribox_plan_make(options, &v->plan);
    if (status)
        return status;

    const tribox_environment callers = tribox_environment_enter();
    const bool is_sound = tribox_grid_is_sound(grid),
               has_layers = is_sound && first <= grid->size[2] && layers <= grid->size[2] - first;
    if (has_layers) {
        v->grid = grid;
        v->mesh = NULL;
        v->first_number = 0;
        memcpy(v->size, grid->size, sizeof v->size);
        v->first_layer = first;
        v->end_layer = (int64_t)first + layers;
        v->lattice = lattice_of(grid);
        tribox_voxels_start(v, occupied);
        if (layers)
            (v->plan.axes & TRIBOX_AXES_BOX ? set_soup : set_soup_by_cells)(v, soup);
        tribox_voxels_settle(v);
        tribox_plan_report(&v->plan, v->counts, report);
    }
    tribox_environment_leave(callers);
    return has_layers ? TRIBOX_OK : is_sound ? TRIBOX_BAD_ARGUMENT : TRIBOX_BAD_GRID;
}

tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options, uint64_t *occupied,
                              tribox_report *report)
{
    return tribox_voxelize_layers(soup, grid, 0, grid ? grid->size[2] : 0, options, occupied, report);
}
