/* mesh_streams.c - triangles of a mesh as nine streams: as they are, or relative to an origin. */
#include "dispatch.h"
#include "base/environment.h"
#include "base/finite.h"
#include "base/floats.h"
#include "mesh_input.h"

/* A part of the triangles, and streams for it. */
static bool are_streams_writable(size_t triangles, size_t first, size_t count, float *const x[3], float *const y[3],
                                 float *const z[3])
{
    if (first > triangles || count > triangles - first || !x || !y || !z)
        return false;
    for (int v = 0; count && v < 3; v++)
        if (!x[v] || !y[v] || !z[v])
            return false;
    return true;
}

/* The kernel, where it and the vertices of these triangles are there. */
static tribox_status find_kernel(const tribox_mesh *strided, size_t first, size_t count, const tribox_options *options,
                                 const tribox_kernel **kernel)
{
    *kernel = tribox_kernel_find(options ? options->kernel : NULL);
    if (!*kernel)
        return TRIBOX_NO_KERNEL;
    return tribox_mesh_is_in_range(strided, *kernel, first, count) ? TRIBOX_OK : TRIBOX_BAD_VERTEX;
}

/* Of floats, or of doubles that do not follow each other: number by number. */
static void write_each_triangle(const tribox_mesh *mesh, const double origin[3], const uint32_t *list, size_t first, size_t count,
                                float *const to[9])
{
    enum { SOME = 64 };
    double u[3 * SOME][3];
    for (size_t at = 0, part; at < count; at += part) {
        part = list ? 1 : count - at < SOME ? count - at : SOME;
        tribox_mesh_read_corners(mesh, 3 * (list ? list[first + at] : first + at), 3 * part, u);
        for (size_t k = 0; k < 9; k++)
            for (size_t i = 0; i < part; i++)
                tribox_float_put(to[k] + at + i, u[3 * i + k % 3][k / 3] - origin[k / 3]);
    }
}

/* Kernels copy numbers as they are stored: what they write, and take from them, is of the axes that those are. */
void tribox_mesh_write_soup(const tribox_mesh *mesh, const tribox_kernel *kernel, const double *origin, const uint32_t *list,
                            size_t first, size_t count, float *const to[9])
{
    static const double zero[3] = {0, 0, 0};
    double origins[TRIBOX_LOCAL];
    float *stored[9];
    if (!tribox_mesh_has_triples(mesh) || (origin && mesh->position_bytes != sizeof(double))) {
        write_each_triangle(mesh, origin ? origin : zero, list, first, count, to);
        return;
    }
    for (int a = 0; a < 3; a++) {
        const size_t k = tribox_stored_axis(mesh, a);
        for (size_t v = 0; v < 3; v++)
            stored[3 * k + v] = to[3 * (size_t)a + v];
        for (size_t n = k; n < TRIBOX_LOCAL; n += 3)
            origins[n] = origin ? origin[a] : 0;
    }
    kernel->gather(mesh, mesh->position_bytes == sizeof(double) ? origins : NULL, list, first, count, stored);
}

bool tribox_mesh_origin_of(const double *origin, double of[3])
{
    for (int a = 0; a < 3; a++)
        of[a] = origin ? origin[a] : 0;
    return tribox_are_finite_doubles(of, 3);
}

tribox_status tribox_mesh_to_soup(const tribox_mesh *mesh, const double origin[3], size_t first, size_t count,
                                  const tribox_options *options, float *const x[3], float *const y[3], float *const z[3])
{
    tribox_mesh strided;
    double from[3];
    if (!tribox_mesh_take(mesh, &strided) || !tribox_mesh_origin_of(origin, from) ||
        !are_streams_writable(mesh->count, first, count, x, y, z))
        return TRIBOX_BAD_ARGUMENT;
    float *const to[9] = {x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]};
    const tribox_kernel *kernel;
    const tribox_status status = find_kernel(&strided, first, count, options, &kernel);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    tribox_mesh_write_soup(&strided, kernel, origin ? from : NULL, NULL, first, count, to);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}
