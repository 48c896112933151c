/* voxelize_f64.c - a mesh into the cells of a grid in double, or of a window of it: the call. */
#include "voxels.h"

#include "base/environment.h"
#include "base/finite.h"
#include "grid/grid_f64.h"
#include "mesh/mesh_input.h"
#include "mesh/mesh_streams.h"
#include "mesh/positions.h"

/* Triangles have numbers of 32 bits in a part of the mesh. */
enum { PART = 1 << 30, BLOCK = 256 /* whose floats fit the nearest cache */ };

tribox_triangle tribox_voxels_numbered(const tribox_voxels *v, int32_t number)
{
    tribox_triangle triangle = {.number = number};
    const size_t corner = 3 * (v->first_triangle + (size_t)number);
    for (size_t j = 0; j < 3; j++) {
        double position[3];
        tribox_position_read(v->mesh, tribox_vertex_number(v->mesh, tribox_vertex_bytes(v->mesh), corner + j), position);
        for (size_t a = 0; a < 3; a++)
            triangle.u[3 * a + j] = position[a];
    }
    return triangle;
}

/* The window as a grid of its own, about its first planes. */
static tribox_lattice lattice_of(const tribox_voxels *v)
{
    tribox_lattice lattice;
    for (int a = 0; a < 3; a++) {
        const double lowest = tribox_plane_at(&v->planes, a, 0), highest = tribox_plane_at(&v->planes, a, v->size[a]);
        const double farthest = -lowest > highest ? -lowest : highest;
        lattice.origin[a] = lowest;
        lattice.per_cell[a] = 1 / v->planes.cell[a];
        /* planes: half a spacing of doubles for the first and for each; places: three roundings (PROOFS.md 7.10) */
        lattice.error[a] = 0x1.001p-52 * farthest * lattice.per_cell[a] + 0x1p-50 * ((double)v->size[a] + 4);
    }
    return lattice;
}

/*
 * Whether limits hold in double: planes are much farther apart than doubles, and cells of a size whose products neither overflow
 * nor vanish (PROOFS.md 7.10).
 */
static bool is_for_limits(const tribox_voxels *v)
{
    bool is = true;
    for (int a = 0; a < 3; a++)
        is &= v->size[a] <= 1 << 30 && v->planes.cell[a] >= 0x1p-700 && v->planes.cell[a] <= 0x1p700 && v->lattice.error[a] < 0.25;
    return is;
}

/*
 * By floats relative to the window's corner. Where the plane alone is asked beside the box normals, they cannot stand for the
 * doubles: it turns with the smallest of moves.
 */
static bool is_for_float(tribox_voxels *v)
{
    const bool has_moves = v->plan.axes == TRIBOX_AXES_BOX || v->plan.axes & TRIBOX_AXES_EDGES;
    return v->plan.axes & TRIBOX_AXES_BOX && has_moves && v->has_limits &&
           tribox_voxels_make_float(v, (float[3]){0, 0, 0}, (double[3]){0, 0, 0});
}

static void set_by_float(tribox_voxels *v, size_t count)
{
    const tribox_kernel *const kernel = v->plan.kernel;
    _Alignas(64) float streams[9][BLOCK] = {{0}};
    float *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    for (size_t at = 0; at < count; at += BLOCK) {
        const size_t some = count - at < BLOCK ? count - at : BLOCK;
        const tribox_soup soup = tribox_soup_of(&streams[0][0], BLOCK, some);
        v->first_number = (int32_t)at;
        tribox_mesh_write_local(v->mesh, kernel, v->lattice.origin, v->first_triangle + at, some, to);
        kernel->cells->sort(v, &soup);
    }
    kernel->cells->finish(v);
}

/* One by one: cell by cell without the box normals, as a triangle may then overlap cells anywhere. */
static void set_by_double(tribox_voxels *v, size_t count)
{
    const bool has_box = v->plan.axes & TRIBOX_AXES_BOX;
    for (size_t i = 0; i < count; i++) {
        const tribox_triangle triangle = tribox_voxels_numbered(v, (int32_t)i);
        (has_box ? tribox_voxels_add : tribox_voxels_wait_everywhere)(v, &triangle);
    }
}

static void set_part(tribox_voxels *v, size_t count)
{
    (is_for_float(v) ? set_by_float : set_by_double)(v, count);
    tribox_voxels_set_strips(v);
    tribox_voxels_settle(v);
}

static void set_mesh(tribox_voxels *v, const tribox_mesh *mesh, uint64_t *occupied)
{
    v->grid = NULL;
    v->mesh = mesh;
    v->first_layer = 0;
    v->end_layer = v->size[2];
    v->lattice = lattice_of(v);
    v->has_limits = is_for_limits(v);
    v->roughness = TRIBOX_EVEN;
    tribox_voxels_start(v, occupied);
    for (v->first_triangle = 0; v->first_triangle < mesh->count; v->first_triangle += PART)
        set_part(v, mesh->count - v->first_triangle < PART ? mesh->count - v->first_triangle : PART);
}

tribox_status tribox_voxelize_f64(const tribox_mesh *mesh, const tribox_grid_f64 *grid, const uint32_t first[3],
                                  const uint32_t size[3], const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    tribox_voxels voxels, *const v = &voxels;
    if (!grid || !occupied || !first != !size || !tribox_mesh_is_readable_f64(mesh))
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(options, &v->plan);
    if (status)
        return status;

    const tribox_mesh strided = tribox_mesh_with_strides(mesh);
    const bool is_fast = v->plan.accuracy == TRIBOX_FAST;
    const tribox_environment callers = tribox_environment_enter();
    memcpy(v->size, size ? size : grid->size, sizeof v->size);
    if (!tribox_grid_f64_is_sound(grid))
        status = TRIBOX_BAD_GRID;
    else if (first && !tribox_is_window(grid->size, first, size))
        status = TRIBOX_BAD_ARGUMENT;
    else if (!tribox_has_few_words(v->size))
        status = TRIBOX_BAD_GRID;
    else if (!tribox_mesh_is_in_range(&strided, v->plan.kernel, 0, mesh->count))
        status = TRIBOX_BAD_INDEX;
    if (!status) {
        v->plan.accuracy = is_fast ? TRIBOX_CONSERVATIVE : v->plan.accuracy;
        v->planes = tribox_planes_of(grid, first);
        if (v->size[0] && v->size[1] && v->size[2])
            set_mesh(v, &strided, occupied);
        else
            v->counts = (tribox_report){0, 0};
        v->plan.accuracy = is_fast ? TRIBOX_FAST : v->plan.accuracy;
        tribox_plan_report(&v->plan, v->counts, report);
    }
    tribox_environment_leave(callers);
    return status;
}
