/* mesh_kind.c - tells the formats of meshes apart. */
#define _POSIX_C_SOURCE 200809L
#include "mesh_kind.h"

#include <string.h>
#include <strings.h>

#include "plain.h"
#include "words.h"

static const struct {
    const char *word, *ending;
} kinds[] = {
    [MESH_PLY] = {"ply", ".ply"}, [MESH_OFF] = {"off", ".off"}, [MESH_STL_TEXT] = {"solid", ".stl"}, [MESH_OBJ] = {"", ".obj"}};

bool mesh_kind_has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), size = strlen(ending);
    return length >= size && !strcasecmp(path + length - size, ending);
}

mesh_kind mesh_kind_by(const char *path, const words *first)
{
    int kind = 0;
    while (kind < MESH_OTHER && !(first->length && words_is(first, kinds[kind].word)))
        kind++;
    for (int k = 0; kind == MESH_OTHER && k < MESH_OTHER; k++)
        if (mesh_kind_has_ending(path, kinds[k].ending))
            return (mesh_kind)k;
    return (mesh_kind)kind;
}

mesh_kind mesh_kind_of(const char *path)
{
    plain_file file = {.path = path};
    mesh_kind kind = MESH_OTHER;
    if (plain_file_open(path, &file)) {
        words first = words_of(path, &file.head, '#');
        words_next(&first);
        kind = mesh_kind_by(path, &first);
    }
    plain_file_close(&file);
    return kind;
}
