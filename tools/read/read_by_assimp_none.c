/* read_by_assimp_none.c - what a build without libassimp says of the formats that it would read. */
#include "console/message.h"
#include "mesh.h"

static int refuse(const char *path)
{
    return message_failure(
        "%s: not a PLY, OFF, OBJ, STL, .f32 or .f64 file, and this program was built without libassimp, which reads other "
        "formats; install libassimp-dev and build it again, or save the mesh as PLY",
        path);
}

int read_by_assimp(const char *path, mesh *m)
{
    (void)m;
    return refuse(path);
}

int read_colours_by_assimp(const char *path, size_t triangles, float (*of)[3], struct assimp_colours *found)
{
    (void)triangles, (void)of, (void)found;
    return refuse(path);
}
