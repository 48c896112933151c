/* triangles.c - triangles of a soup or of a mesh, as streams of floats or as doubles. */
#include "triangles.h"

#include "base/floats.h"
#include "mesh/mesh_input.h"

bool tribox_triangles_of_soup(const tribox_soup *soup, tribox_triangles *triangles)
{
    if (!tribox_soup_is_readable(soup))
        return false;
    triangles->is_soup = true;
    triangles->are_doubles = false;
    triangles->soup = soup;
    triangles->count = soup->count;
    return true;
}

bool tribox_triangles_of_mesh(const tribox_mesh *mesh, tribox_triangles *triangles)
{
    if (!tribox_mesh_take(mesh, &triangles->mesh))
        return false;
    triangles->is_soup = false;
    triangles->are_doubles = triangles->mesh.position_bytes == sizeof(double);
    triangles->count = triangles->mesh.count;
    return true;
}

bool tribox_triangles_have_vertices(const tribox_triangles *triangles, const tribox_kernel *kernel)
{
    return triangles->is_soup || tribox_mesh_is_in_range(&triangles->mesh, kernel, 0, triangles->count);
}

size_t tribox_triangles_at_once(const tribox_triangles *triangles) { return triangles->is_soup ? SIZE_MAX : TRIBOX_STREAMED; }

tribox_soup tribox_soup_part(const tribox_soup *soup, size_t first, size_t count)
{
    tribox_soup part = {.count = count};
    for (int v = 0; v < 3; v++) {
        part.x[v] = soup->x[v] + first;
        part.y[v] = soup->y[v] + first;
        part.z[v] = soup->z[v] + first;
    }
    return part;
}

tribox_soup tribox_triangles_stream(const tribox_triangles *triangles, const tribox_kernel *kernel, const double origin[3],
                                    size_t first, size_t count, tribox_stream_room *room)
{
    float *to[9];
    if (triangles->is_soup) {
        const tribox_soup part = tribox_soup_part(triangles->soup, first, count);
        if (count >= kernel->lanes)
            return part;
        kernel->spread_triangles(&part, &room->few);
        return room->few.soup;
    }
    for (int k = 0; k < 9; k++)
        to[k] = room->number[k];
    for (size_t k = 0; count < kernel->lanes && k < 9; k++)
        memset(to[k], 0, sizeof(float[TRIBOX_LANES_MAX]));
    tribox_mesh_write_soup(&triangles->mesh, kernel, triangles->are_doubles ? origin : NULL, NULL, first, count, to);
    return tribox_soup_of(&room->number[0][0], TRIBOX_STREAMED, count);
}

static void read_soup(const tribox_soup *soup, size_t first, size_t count, double *to, size_t step)
{
    for (size_t n = 0; n < 9; n++) {
        const float *const from = tribox_soup_axis(soup, (int)n / 3)[n % 3] + first;
        for (size_t i = 0; i < count; i++)
            to[n * step + i] = (double)tribox_float_at(from + i);
    }
}

static void read_mesh(const tribox_mesh *mesh, size_t first, size_t count, double *to, size_t step)
{
    enum { SOME = 64 };
    double corner[3 * SOME][3];
    for (size_t at = 0; at < count; at += SOME) {
        const size_t some = count - at < SOME ? count - at : SOME;
        tribox_mesh_read_corners(mesh, 3 * (first + at), 3 * some, corner);
        for (size_t i = 0; i < 3 * some; i++)
            for (size_t a = 0; a < 3; a++)
                to[(3 * a + i % 3) * step + at + i / 3] = corner[i][a];
    }
}

void tribox_triangles_read(const tribox_triangles *triangles, size_t first, size_t count, double *to, size_t step)
{
    if (triangles->is_soup)
        read_soup(triangles->soup, first, count, to, step);
    else
        read_mesh(&triangles->mesh, first, count, to, step);
}
