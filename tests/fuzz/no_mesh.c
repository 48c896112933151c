/* no_mesh.c - stands in for tools/read/mesh.c: every file is refused, so that a command ends when it has read its arguments. */
#include "read/mesh.h"

#include "console/message.h"

int mesh_read(const char *path, mesh *m) { return mesh_read_as(path, TRIANGLES_OTHER, m); }

int mesh_read_as(const char *path, triangle_format format, mesh *m)
{
    *m = (mesh){.coordinates = NULL};
    return message_failure("%s: no mesh of format %d", path, (int)format);
}

int mesh_read_wide(const char *path, triangle_format format, mesh *m) { return mesh_read_as(path, format, m); }

void mesh_set_doubles(double *positions, size_t vertices, uint32_t *corners, size_t triangles, mesh *m)
{
    *m = (mesh){.positions = positions, .corners = corners, .triangles = triangles, .doubles.vertices = vertices};
}

tribox_mesh mesh_of_streams(const mesh *m, uint32_t **indices)
{
    *indices = NULL;
    return (tribox_mesh){.count = m->triangles};
}

int mesh_to_floats(const char *path, const double origin[3], mesh *m)
{
    (void)m;
    return message_failure("%s: no mesh to be rounded about %g", path, origin[0]);
}

void mesh_warn(const char *path, const mesh *m) { message_say("%s: %zu triangles", path, m->soup.count); }

void mesh_warn_rounded(const char *path, const mesh *m) { message_say("%s: %zu vertices", path, m->rounded); }

void mesh_warn_not_finite(const char *path, uint64_t not_finite, uint64_t count, uint64_t first)
{
    message_say("%s: %llu of %llu, first %llu", path, (unsigned long long)not_finite, (unsigned long long)count,
                (unsigned long long)first);
}

void mesh_free(mesh *m) { *m = (mesh){.coordinates = NULL}; }
