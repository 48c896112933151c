/* mesh_list.c - finds and reads a mesh that a command line names. */
#include "mesh_list.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "read/indexed_mesh.h"
#include "read/mesh.h"
#include "read/scan.h"

const char *mesh_list_name(const char *path)
{
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

enum { PATH_ROOM = 4096 };

static const char *find(const char *path, char whole[PATH_ROOM])
{
    const char *const folder = strchr(path, '/') ? NULL : getenv("TRIBOX_MESHES");
    snprintf(whole, PATH_ROOM, "%s%s%s", folder ? folder : "", folder ? "/" : "", path);
    return whole;
}

bool mesh_list_read(const char *path, mesh *m)
{
    char whole[PATH_ROOM];
    return mesh_read(find(path, whole), m) == EXIT_CODE_OK;
}

bool mesh_list_read_indexed(const char *path, indexed_mesh *m)
{
    char whole[PATH_ROOM];
    whole_file file;
    const mesh_kind kind = mesh_kind_of(find(path, whole));
    *m = (indexed_mesh){.positions = NULL};
    if (kind == MESH_STL_TEXT || kind == MESH_OTHER)
        return message_failure("%s: no PLY, OFF or OBJ file, which have indices", path) == EXIT_CODE_OK;
    const bool is_read = !whole_file_read(whole, &file) && !scan_read(whole, kind, &file, m);
    whole_file_free(&file);
    indexed_mesh_narrow(m);
    if (is_read && (m->position_bytes != sizeof(float) || !m->triangles))
        return message_failure("%s: no triangles of floats", path) == EXIT_CODE_OK;
    return is_read;
}
