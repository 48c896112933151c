/* mesh_kind.c - opens files whose parts are read where they stand, and tells their formats apart. */
#define _POSIX_C_SOURCE 200809L
#include "mesh_kind.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "files/named_file.h"
#include "plain.h"
#include "words.h"

enum { HEAD_BYTES = 1 << 16 };

static bool read_head(plain_file *file)
{
    const size_t wanted = file->size < HEAD_BYTES ? (size_t)file->size : HEAD_BYTES;
    file->head.bytes = calloc(1, wanted + 1);
    return file->head.bytes && named_file_read_at(file->stream, 0, file->head.bytes, wanted, &file->head.size);
}

bool plain_file_open(const char *path, plain_file *file)
{
    file_about about;
    if (!named_file_about(path, &about) || about.kind != FILE_KIND_REGULAR || !about.size)
        return false;
    file->stream = named_file_open(path, "rb");
    if (!file->stream || !named_file_about_open(file->stream, &about) || about.kind != FILE_KIND_REGULAR)
        return false;
    file->size = about.size;
    return read_head(file);
}

void plain_file_close(plain_file *file)
{
    if (file->stream)
        fclose(file->stream);
    whole_file_free(&file->head);
    file->stream = NULL;
}

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
