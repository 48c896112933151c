/* mesh_list.h - the meshes that a benchmark's command line names. */
#ifndef MESH_LIST_H
#define MESH_LIST_H

#include <stddef.h>

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

#endif
