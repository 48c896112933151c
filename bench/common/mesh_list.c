/* mesh_list.c - finds and reads a mesh that a command line names. */
#include "mesh_list.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *mesh_list_name(const char *path)
{
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool mesh_list_read(const char *path, mesh *m)
{
    const char *const folder = strchr(path, '/') ? NULL : getenv("TRIBOX_MESHES");
    char whole[4096];
    snprintf(whole, sizeof whole, "%s%s%s", folder ? folder : "", folder ? "/" : "", path);
    return mesh_read(whole, m) == EXIT_CODE_OK;
}
