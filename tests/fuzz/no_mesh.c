/* no_mesh.c - stands in for tools/read/mesh.c: every file is refused, so that a command ends when it has read its arguments. */
#include "console/message.h"
#include "read/mesh.h"

int mesh_read_over(const char *path, triangle_format format, bool is_wide, unsigned threads, mesh_overflow *over, mesh *m)
{
    (void)is_wide, (void)threads, (void)over;
    *m = (mesh){.coordinates = NULL};
    return message_failure("%s: no mesh of format %d", path, (int)format);
}

int mesh_to_floats(const char *path, const double origin[3], mesh *m)
{
    (void)m;
    return message_failure("%s: no mesh to be rounded about %g", path, origin[0]);
}

int read_colours_by_assimp(const char *path, size_t triangles, float (*of)[3], struct assimp_colours *found)
{
    (void)of, (void)found;
    return message_failure("%s: no colours of %zu triangles", path, triangles);
}
