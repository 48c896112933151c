/* mesh_input.c - what every call checks of a mesh before it reads it, and the indices that refer to no vertex. */
#include "mesh_input.h"

#include "dispatch.h"
#include "positions.h"
#include "base/soup.h"
#include "plan.h"

/* Whether `count` items of `bytes` bytes each fit the address space. */
static bool fits(size_t count, size_t bytes) { return count <= PTRDIFF_MAX / bytes; }

/* Where the three numbers of a vertex need not follow each other, vertices may: a column-major matrix has them side by side. */
static size_t least_stride(const tribox_mesh *mesh)
{
    const size_t bytes = tribox_position_bytes(mesh);
    return mesh->axis_stride ? bytes : 3 * bytes;
}

/* What 0 stands for: in a matrix of one vertex nothing tells columns from rows. */
static size_t usual_stride(const tribox_mesh *mesh)
{
    const size_t bytes = tribox_position_bytes(mesh);
    return mesh->axis_stride > bytes ? bytes : 3 * bytes;
}

/* As bits of each axis (positions.h); 0 if they are no order of the three. */
static unsigned stored_axes(unsigned axes)
{
    const unsigned digits = axes ? axes : 123, x = digits / 100 - 1, y = digits / 10 % 10 - 1, z = digits % 10 - 1;
    return x < 3 && y < 3 && z < 3 && (1u << x | 1u << y | 1u << z) == 7 ? x | y << 2 | z << 4 : 0;
}

static bool is_mesh_readable(const tribox_mesh *mesh)
{
    if (!mesh || (mesh->position_bytes && mesh->position_bytes != 4 && mesh->position_bytes != 8) ||
        !tribox_are_reserved_zero(mesh->reserved) || !stored_axes(mesh->axes))
        return false;
    const size_t least = least_stride(mesh), axis = mesh->axis_stride;
    if ((mesh->stride && mesh->stride < least) || !fits(mesh->vertices, mesh->stride ? mesh->stride : usual_stride(mesh)))
        return false;
    if (axis && (axis < tribox_position_bytes(mesh) || !fits(3, axis)))
        return false;
    if (mesh->indices && mesh->index_bytes != 2 && mesh->index_bytes != 4)
        return false;
    return fits(mesh->count, 3 * sizeof(float)) && (mesh->positions || !mesh->count);
}

bool tribox_mesh_take(const tribox_mesh *mesh, tribox_mesh *strided)
{
    if (!is_mesh_readable(mesh))
        return false;
    *strided = *mesh;
    strided->stride = mesh->stride ? mesh->stride : usual_stride(mesh);
    strided->axis_stride = mesh->axis_stride ? mesh->axis_stride : tribox_position_bytes(mesh);
    strided->axes = stored_axes(mesh->axes);
    return true;
}

bool tribox_mesh_has_triples(const tribox_mesh *mesh)
{
    const size_t bytes = tribox_position_bytes(mesh);
    return mesh->axis_stride == bytes && mesh->stride >= 3 * bytes;
}

static bool has_plain_positions(const tribox_mesh *mesh, size_t bytes)
{
    return tribox_position_bytes(mesh) == bytes && tribox_mesh_has_triples(mesh) && mesh->axes == TRIBOX_AXES_AS_STORED;
}

bool tribox_mesh_has_floats(const tribox_mesh *mesh) { return has_plain_positions(mesh, sizeof(float)); }

bool tribox_mesh_has_doubles(const tribox_mesh *mesh) { return has_plain_positions(mesh, sizeof(double)); }

/* The sizes, as arguments of their own, may be constants: then neither is asked of each corner. */
static inline void read_corners(const tribox_mesh *mesh, unsigned index_bytes, unsigned position_bytes, size_t first, size_t count,
                                double (*to)[3])
{
    tribox_mesh from = *mesh; /* known not to change while corners are written */
    from.position_bytes = position_bytes;
    for (size_t corner = 0; corner < count; corner++)
        tribox_position_read(&from, tribox_vertex_number(&from, index_bytes, first + corner), to[corner]);
}

void tribox_mesh_read_corners(const tribox_mesh *mesh, size_t first, size_t count, double (*to)[3])
{
    const unsigned bytes = tribox_vertex_bytes(mesh);
    if (mesh->position_bytes == sizeof(double))
        read_corners(mesh, bytes, sizeof(double), first, count, to);
    else if (bytes == 4)
        read_corners(mesh, 4, sizeof(float), first, count, to);
    else
        read_corners(mesh, bytes, sizeof(float), first, count, to);
}

bool tribox_mesh_is_in_range(const tribox_mesh *mesh, const tribox_kernel *kernel, size_t first, size_t count)
{
    return !count || kernel->find_vertices(mesh, first, count).greatest < mesh->vertices;
}

size_t tribox_mesh_not_finite(const tribox_mesh *mesh, size_t *first)
{
    tribox_mesh strided;
    const size_t count = tribox_mesh_take(mesh, &strided) ? mesh->count : 0;
    const unsigned bytes = count ? tribox_vertex_bytes(mesh) : 0;
    size_t found = 0, lowest = count;
    for (size_t i = count; i-- > 0;) {
        bool is_there = true, is_finite = true;
        for (size_t v = 0; v < 3; v++) {
            const size_t vertex = tribox_vertex_number(&strided, bytes, 3 * i + v);
            is_there &= vertex < mesh->vertices;
            if (!is_there)
                break;
            is_finite &= tribox_position_is_finite(&strided, vertex);
        }
        const bool is_bad = is_there && !is_finite;
        found += is_bad;
        lowest = is_bad ? i : lowest;
    }
    if (first)
        *first = lowest;
    return found;
}

/* How many corners of triangles at .. at + count - 1 have no vertex; *first becomes the first of them, if it is none yet. */
static size_t count_bad(const tribox_mesh *mesh, size_t at, size_t count, size_t none, size_t *first)
{
    const unsigned bytes = tribox_vertex_bytes(mesh);
    size_t found = 0;
    for (size_t corner = 3 * at; corner < 3 * (at + count); corner++)
        if (tribox_vertex_number(mesh, bytes, corner) >= mesh->vertices) {
            found++;
            *first = *first == none ? corner : *first;
        }
    return found;
}

size_t tribox_mesh_bad_vertices(const tribox_mesh *mesh, size_t *first)
{
    const tribox_kernel *const kernel = tribox_kernel_any();
    const size_t triangles = is_mesh_readable(mesh) ? mesh->count : 0, corners = 3 * triangles;
    size_t found = 0, lowest = corners;
    if (corners && !mesh->indices) {
        found = corners > mesh->vertices ? corners - mesh->vertices : 0;
        lowest = corners - found;
    }
    for (size_t at = 0; mesh && mesh->indices && at < triangles; at += 64) {
        const size_t count = triangles - at < 64 ? triangles - at : 64;
        if (!tribox_mesh_is_in_range(mesh, kernel, at, count))
            found += count_bad(mesh, at, count, corners, &lowest);
    }
    if (first)
        *first = lowest;
    return found;
}
