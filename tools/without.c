/* without.c - stands in for what needs libraries, each on its own, where the program is built without them. */
#include "console/message.h"
#include "picture/preview.h"
#include "read/mesh.h"
#include "read/mesh_file.h"
#include "write/mesh_npz.h"
#include "write/part.h"
#include "write/volume.h"

#ifdef WITHOUT_PNG
const bool picture_png_is_there = false;

bool picture_png_write(FILE *to, const unsigned char *pixels, unsigned width, unsigned height)
{
    (void)to, (void)pixels, (void)width, (void)height;
    return false;
}
#endif

#ifdef WITHOUT_ASSIMP
static int refuse_mesh(const char *path)
{
    return message_failure("%s: not a file of " MESH_ENDINGS
                           ", and this program was built without libassimp, which reads other formats; "
                           "build it with libassimp-dev, or save the mesh as PLY",
                           path);
}

int read_by_assimp(const char *path, mesh *m)
{
    (void)m;
    return refuse_mesh(path);
}

int read_colours_by_assimp(const char *path, size_t triangles, float (*of)[3], struct assimp_colours *found)
{
    (void)triangles, (void)of, (void)found;
    return refuse_mesh(path);
}
#endif

#ifdef WITHOUT_OPENVDB
static int refuse_vdb(const char *path, const tribox_grid *grid)
{
    (void)grid;
    return message_failure("%s: this tribox was built without OpenVDB, which .vdb needs; write .npz", path);
}

const volume_writer volume_vdb = {.check_grid = refuse_vdb};
#endif

#ifdef WITHOUT_ZLIB
static int refuse_npz(const char *path, const tribox_grid *grid)
{
    (void)grid;
    return message_failure("%s: this tribox was built without zlib, which .npz needs; write .npy or .raw", path);
}

const volume_writer volume_npz = {.check_grid = refuse_npz};

int mesh_npz_write(const file_out *out, const mesh *m, const rgb *colours)
{
    (void)m, (void)colours;
    return refuse_npz(out->path, NULL);
}

int part_open(part *p, const char *path)
{
    (void)p;
    return message_failure("%s: this tribox was built without zlib, which parts need", path);
}

/* Not called, as part_open refuses. */
int part_read(part *p, unsigned threads, part_taker *take, void *data)
{
    (void)threads, (void)take, (void)data;
    return part_open(p, p->path);
}
#endif
