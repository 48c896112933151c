/* voxelize_f64.c - a mesh into the cells of a grid in double, or of a window of it: the call. */
#include "voxelizing.h"

#include "base/environment.h"
#include "base/finite.h"
#include "grid/grid_f64.h"
#include "mesh/mesh_input.h"
#include "mesh/mesh_streams.h"
#include "mesh/positions.h"

/* Triangles have numbers of 32 bits in a part of the mesh. */
enum { PART = 1 << 30, BLOCK = 256 /* whose floats fit the nearest cache */ };

/* The window as a grid of its own, about its first planes. */
static tribox_lattice lattice_of_doubles(const tribox_window *w)
{
    tribox_lattice lattice;
    for (int a = 0; a < 3; a++) {
        const double lowest = tribox_plane_at(&w->planes, a, 0), highest = tribox_plane_at(&w->planes, a, w->size[a]);
        const double farthest = -lowest > highest ? -lowest : highest;
        lattice.origin[a] = lowest;
        lattice.per_cell[a] = 1 / w->planes.cell[a];
        /* planes: half a spacing of doubles for the first and for each; places: three roundings (PROOFS.md 7.10) */
        lattice.error[a] = 0x1.001p-52 * farthest * lattice.per_cell[a] + 0x1p-50 * ((double)w->size[a] + 4);
    }
    return lattice;
}

/*
 * Whether limits hold in double: planes are much farther apart than doubles, and cells of a size whose products neither overflow
 * nor vanish (PROOFS.md 7.10).
 */
static bool is_for_limits(const tribox_window *w)
{
    bool fits = true;
    for (int a = 0; a < 3; a++)
        fits &=
            w->size[a] <= 1 << 30 && w->planes.cell[a] >= 0x1p-700 && w->planes.cell[a] <= 0x1p700 && w->lattice.error[a] < 0.25;
    return fits;
}

/*
 * By floats relative to the window's corner. Where the plane alone is asked besides the box normals, they cannot stand for the
 * doubles: it turns with the smallest of moves.
 */
static bool is_mesh_for_float(tribox_voxels *v)
{
    const bool has_moves = v->plan.axes == TRIBOX_AXES_BOX || v->plan.axes & TRIBOX_AXES_EDGES;
    return v->plan.axes & TRIBOX_AXES_BOX && has_moves && v->window.has_limits &&
           tribox_window_make_float(&v->window, (float[3]){0, 0, 0}, (double[3]){0, 0, 0});
}

static void set_by_float(tribox_voxels *v, size_t count)
{
    const tribox_kernel *const kernel = v->plan.kernel;
    _Alignas(64) float streams[9][BLOCK] = {{0}};
    float *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    for (size_t at = 0; at < count; at += BLOCK) {
        const size_t part = count - at < BLOCK ? count - at : BLOCK;
        const tribox_soup soup = tribox_soup_of(&streams[0][0], BLOCK, part);
        v->window.first_number = (int32_t)at;
        tribox_mesh_write_soup(v->window.mesh, kernel, v->window.lattice.origin, v->window.first_triangle + at, part, to);
        kernel->cells->sort(v, &soup);
    }
    kernel->cells->finish(v);
}

/* One by one: cell by cell without the box normals, as a triangle may then overlap cells anywhere. */
static void set_by_double(tribox_voxels *v, size_t count)
{
    const bool has_box = v->plan.axes & TRIBOX_AXES_BOX;
    for (size_t i = 0; i < count; i++) {
        const tribox_triangle triangle = tribox_window_read_triangle(&v->window, (int32_t)i);
        if (has_box)
            tribox_voxels_add_triangle(v, &triangle);
        else
            tribox_voxels_wait_everywhere(v, &triangle);
    }
}

static void set_part(tribox_voxels *v, size_t count)
{
    if (is_mesh_for_float(v))
        set_by_float(v, count);
    else
        set_by_double(v, count);
    tribox_voxels_set_strips(v);
    tribox_voxels_settle_waiting(v);
}

/* FAST would save error bounds alone, which cost little here. */
void tribox_voxels_set_mesh(tribox_voxels *v, const tribox_mesh *mesh, const tribox_grid_f64 *grid, const uint32_t first[3],
                            const uint32_t size[3], uint64_t *occupied)
{
    tribox_window *const w = &v->window;
    const bool is_fast = v->plan.accuracy == TRIBOX_FAST;
    v->plan.accuracy = is_fast ? TRIBOX_CONSERVATIVE : v->plan.accuracy;
    w->grid = NULL;
    w->mesh = mesh;
    w->planes = tribox_planes_of(grid, first);
    memcpy(w->size, size, sizeof w->size);
    w->first_layer = 0;
    w->end_layer = size[2];
    w->lattice = lattice_of_doubles(w);
    w->has_limits = is_for_limits(w);
    w->roughness = TRIBOX_EVEN;
    tribox_voxels_empty_sinks(v, occupied);
    for (w->first_triangle = 0; size[0] && size[1] && size[2] && w->first_triangle < mesh->count; w->first_triangle += PART)
        set_part(v, mesh->count - w->first_triangle < PART ? mesh->count - w->first_triangle : PART);
    v->plan.accuracy = is_fast ? TRIBOX_FAST : v->plan.accuracy;
}

tribox_status tribox_voxelize_f64(const tribox_mesh *mesh, const tribox_grid_f64 *grid, const uint32_t first[3],
                                  const uint32_t size[3], const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_voxels voxels, *const v = &voxels;
    tribox_mesh strided;
    if (!grid || !occupied || !first != !size || !tribox_mesh_take(mesh, &strided))
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(options, &v->plan);
    if (status)
        return status;
    const uint32_t *const extent = size ? size : grid->size;
    const tribox_environment callers = tribox_environment_enter();
    if (!tribox_grid_f64_is_sound(grid))
        status = TRIBOX_BAD_GRID;
    else if (first && !tribox_is_window(grid->size, first, size))
        status = TRIBOX_BAD_ARGUMENT;
    else if (!tribox_fits_one_call(extent))
        status = TRIBOX_BAD_GRID;
    else if (!tribox_mesh_is_in_range(&strided, v->plan.kernel, 0, mesh->count))
        status = TRIBOX_BAD_VERTEX;
    if (!status) {
        tribox_voxels_set_mesh(v, &strided, grid, first, extent, occupied);
        tribox_plan_report(&v->plan, v->counts, report);
    }
    tribox_environment_leave(callers);
    return status;
}
