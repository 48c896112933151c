/* voxelize.c - a soup into the cells of a grid: the calls. */
#include "voxelizing.h"

#include "base/environment.h"
#include "pairs/partial_packet.h"

/* Where the lattice of the grid or window begins: one rounding of the real number. */
static double lattice_origin(const tribox_window *w, int a)
{
    return (double)w->grid->origin[a] + (double)w->first[a] * (double)w->grid->cell[a];
}

static tribox_lattice lattice_of(const tribox_window *w)
{
    tribox_lattice lattice;
    for (int a = 0; a < 3; a++) {
        const double lowest = tribox_window_plane(w, a, 0), highest = tribox_window_plane(w, a, w->size[a]);
        const double farthest = -lowest > highest ? -lowest : highest;
        lattice.origin[a] = lattice_origin(w, a);
        lattice.per_cell[a] = 1 / (double)w->grid->cell[a];
        /* planes: half a spacing of floats, and of doubles while they are made; places: three roundings in double. The
         * 0x1.001 alone would cover the other two terms, and the rounding of a window's origin (PROOFS.md 7.2). */
        lattice.error[a] = (0x1.001p-24 * farthest + 0x1p-149) * lattice.per_cell[a] + 0x1p-50 * ((double)w->size[a] + 4);
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

/* About the first planes, which are floats. Floats have to count planes, from those of the grid's origin on. */
static bool is_for_float(tribox_window *w)
{
    float origin[3];
    double off[3];
    bool has_counts = true;
    for (int a = 0; a < 3; a++) {
        origin[a] = tribox_window_plane(w, a, 0);
        off[a] = ((double)origin[a] - w->lattice.origin[a]) * w->lattice.per_cell[a];
        has_counts &= (uint64_t)w->first[a] + w->size[a] < 1 << 24;
    }
    return tribox_window_make_float(w, origin, off) && has_counts;
}

static void set_soup(tribox_voxels *v, const tribox_soup *soup)
{
    if (v->window.is_for_float && soup->count) {
        tribox_partial_packet partial;
        v->plan.kernel->cells->sort(v, tribox_pad_triangles(soup, v->plan.kernel, &partial));
    } else {
        for (size_t i = 0; i < soup->count; i++) {
            const tribox_triangle triangle = triangle_at(soup, i);
            tribox_voxels_add_triangle(v, &triangle);
        }
    }
}

/* Without the box normals a triangle may overlap cells anywhere: every cell is tested by its own box. */
static void set_soup_by_cells(tribox_voxels *v, const tribox_soup *soup)
{
    for (size_t i = 0; i < soup->count; i++) {
        const tribox_triangle triangle = triangle_at(soup, i);
        tribox_voxels_wait_everywhere(v, &triangle);
    }
}

/* By more than what ties leave undecided; but by less than half a cell, as own_planes.h needs it. */
static tribox_roughness roughness_of(const tribox_window *w)
{
    double most = 0;
    for (int a = 0; a < 3; a++)
        most = w->lattice.error[a] > most ? w->lattice.error[a] : most;
    if (!(most > 0x1p-14 && most < 0x1.fp-2))
        return TRIBOX_EVEN;
    return most > 0x1p-7 ? TRIBOX_VERY_ROUGH : TRIBOX_ROUGH;
}

void tribox_voxels_begin(tribox_voxels *v, const tribox_grid *grid, const uint32_t first[3], const uint32_t size[3],
                         uint64_t *occupied)
{
    v->window.grid = grid;
    v->window.mesh = NULL;
    v->window.first_number = 0;
    memcpy(v->window.first, first, sizeof v->window.first);
    memcpy(v->window.size, size, sizeof v->window.size);
    v->window.first_layer = 0;
    v->window.end_layer = size[2];
    v->window.lattice = lattice_of(&v->window);
    v->window.roughness = roughness_of(&v->window);
    v->window.is_for_float = is_for_float(&v->window);
    tribox_voxels_empty_sinks(v, occupied);
}

void tribox_voxels_put_soup(tribox_voxels *v, const tribox_soup *soup)
{
    if (v->plan.axes & TRIBOX_AXES_BOX)
        set_soup(v, soup);
    else
        set_soup_by_cells(v, soup);
}

void tribox_voxels_end(tribox_voxels *v)
{
    if (v->window.is_for_float)
        v->plan.kernel->cells->finish(v);
    tribox_voxels_set_strips(v);
    tribox_voxels_settle_waiting(v);
}

/* Whole layers are taken as layers of the whole grid, so that they have its bits at every accuracy (PROOFS.md 7.9). */
static void set_window(tribox_voxels *v, const tribox_soup *soup, const tribox_grid *grid, const uint32_t first[3],
                       const uint32_t size[3], uint64_t *occupied)
{
    static const uint32_t none[3] = {0, 0, 0};
    const bool has_layers = size[0] == grid->size[0] && size[1] == grid->size[1];
    tribox_voxels_begin(v, grid, has_layers ? none : first, has_layers ? grid->size : size, occupied);
    if (has_layers) {
        v->window.first_layer = first[2];
        v->window.end_layer = (int64_t)first[2] + size[2];
        tribox_voxels_empty_sinks(v, occupied);
    }
    if (size[0] && size[1] && size[2])
        tribox_voxels_put_soup(v, soup);
    tribox_voxels_end(v);
}

static tribox_status voxelize(const tribox_soup *soup, const tribox_grid *grid, const uint32_t first[3], const uint32_t size[3],
                              const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_voxels voxels, *const v = &voxels;
    if (!grid || !first || !size || !occupied || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(options, &v->plan);
    if (status)
        return status;

    const tribox_environment callers = tribox_environment_enter();
    if (!tribox_grid_is_sound(grid))
        status = TRIBOX_BAD_GRID;
    else if (!tribox_is_window(grid->size, first, size))
        status = TRIBOX_BAD_ARGUMENT;
    else if (!tribox_fits_one_call(size))
        status = TRIBOX_BAD_GRID;
    if (!status) {
        set_window(v, soup, grid, first, size, occupied);
        tribox_plan_report(&v->plan, v->counts, report);
    }
    tribox_environment_leave(callers);
    return status;
}

tribox_status tribox_voxelize_window(const tribox_soup *soup, const tribox_grid *grid, const uint32_t first[3],
                                     const uint32_t size[3], const tribox_options *options, uint64_t *occupied,
                                     tribox_report *report)
{
    return voxelize(soup, grid, first, size, options, occupied, report);
}

tribox_status tribox_voxelize_layers(const tribox_soup *soup, const tribox_grid *grid, uint32_t first, uint32_t layers,
                                     const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    const uint32_t from[3] = {0, 0, first}, size[3] = {grid ? grid->size[0] : 0, grid ? grid->size[1] : 0, layers};
    return voxelize(soup, grid, from, size, options, occupied, report);
}

tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options, uint64_t *occupied,
                              tribox_report *report)
{
    static const uint32_t from[3] = {0, 0, 0};
    return voxelize(soup, grid, from, grid ? grid->size : from, options, occupied, report);
}
