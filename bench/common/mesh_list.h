/* mesh_list.h - the meshes that a benchmark's command line names: files, or names in the folder $TRIBOX_MESHES. */
#ifndef MESH_LIST_H
#define MESH_LIST_H

#include <stdbool.h>

#include "console/message.h"

enum { MESH_LIST_MAX = 64 };
typedef struct mesh_list {
    const char *path[MESH_LIST_MAX];
    size_t count;
} mesh_list;

static inline int mesh_list_take(mesh_list *list, const char *path)
{
    if (list->count == MESH_LIST_MAX)
        return message_usage("'%s' is one mesh too many: give %d at most", path, MESH_LIST_MAX);
    list->path[list->count++] = path;
    return EXIT_CODE_OK;
}

/* The name without its folder. */
const char *mesh_list_name(const char *path);

struct mesh;
struct indexed_mesh;

/* False after a line on standard error. */
bool mesh_list_read(const char *path, struct mesh *m);

/* The same with its vertices and indices, of floats: PLY, OFF and OBJ. indexed_mesh_free follows in any case. */
bool mesh_list_read_indexed(const char *path, struct indexed_mesh *m);

#endif
