/* mesh_file.c - reads whole files, with a reason for each way that can fail, and the beginning of others; tells formats apart. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "console/message.h"
#include "console/system.h"
#include "files/files.h"
#include "plain.h"
#include "mesh_file.h"

/* Whether the reader of a kind takes what a file begins with, in as far as it is read. */
static bool is_begun(mesh_kind kind, const whole_file *file)
{
    words first = words_of(NULL, file, '#');
    const bool has_word = words_next(&first);
    if (kind == MESH_PLY)
        return has_word && first.word == file->bytes && words_is(&first, "ply");
    return kind != MESH_OFF || !has_word || !strncmp(first.word + strspn(first.word, "STCN"), "OFF", 3);
}

/* How many bytes a file has, SIZE_MAX where only its end says so. */
static int open_whole(const char *path, FILE **stream, size_t *size)
{
    file_about about;
    *stream = NULL;
    *size = SIZE_MAX;
    if (!strcmp(path, "-")) {
        *stream = stdin;
        return EXIT_CODE_OK;
    }
    if (!named_file_about(path, &about))
        return message_failure("%s: cannot open the mesh file: %s", path, strerror(errno));
    if (about.kind != FILE_KIND_REGULAR)
        return message_failure("%s: is %s; give a mesh file", path,
                               about.kind == FILE_KIND_FOLDER ? "a directory" : "not a regular file");
    if (about.size == 0)
        return message_failure("%s: the file is empty", path);
    if (about.size >= SIZE_MAX)
        return message_failure("%s: the file is too large for the address space", path);
    *size = (size_t)about.size;
    *stream = named_file_open(path, "rb");
    return *stream ? EXIT_CODE_OK : message_failure("%s: cannot open the mesh file: %s", path, strerror(errno));
}

/* In pieces. What begins like no mesh of its kind is left after the first of a stream, for the kind's reader to refuse. */
static int read_pieces(const char *path, mesh_kind kind, FILE *stream, size_t size, whole_file *file)
{
    const size_t most = (size_t)1 << 22;
    const bool is_sized = size < SIZE_MAX;
    size_t room = 0, piece = most, got = most;
    for (bool is_begun_well = true; is_begun_well && got == piece && file->size < size;) {
        piece = size - file->size < most ? size - file->size : most;
        const size_t needed = is_sized ? size + 1 : file->size + piece + 1;
        char *const bytes = is_sized || room < memory_available() ? memory_grow(file->bytes, needed, &room, 1) : NULL;
        if (!bytes && is_sized)
            return message_failure("%s: out of memory: the file has %zu bytes" MESH_TO_SORT, path, size);
        if (!bytes)
            return message_failure("stdin: out of memory after %zu bytes" MESH_TO_SORT, file->size);
        file->bytes = bytes;
        errno = 0;
        got = fread(bytes + file->size, 1, piece, stream);
        file->size += got;
        bytes[file->size] = '\0';
        is_begun_well = is_sized || file->size != most || is_begun(kind, file);
        if (is_sized)
            reading_tell((double)file->size / (double)size);
    }
    if (!is_sized && ferror(stream))
        return message_failure("stdin: cannot read the mesh: %s", strerror(errno));
    if (is_sized && file->size < size)
        return message_failure("%s: cannot read the file: %s", path,
                               errno ? strerror(errno) : "it became shorter while it was read");
    return file->size ? EXIT_CODE_OK : message_failure("stdin: the file is empty");
}

int whole_file_read(const char *path, mesh_kind kind, whole_file *file)
{
    FILE *stream;
    size_t size;
    *file = (whole_file){NULL, 0};
    int code = open_whole(path, &stream, &size);
    if (code)
        return code;
    reading_begin();
    code = read_pieces(path, kind, stream, size, file);
    reading_end();
    if (stream != stdin)
        fclose(stream);
    return code;
}

void whole_file_free(whole_file *file)
{
    free(file->bytes);
    *file = (whole_file){NULL, 0};
}

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

#define KIND(kind, name, word, ending, comment) {word, ending},
static const struct {
    const char *word, *ending;
} kinds[] = {MESH_KINDS(KIND)};

const char *mesh_kind_ending(mesh_kind kind) { return kinds[kind].ending; }

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
    plain_file file = {.stream = NULL};
    mesh_kind kind = MESH_OTHER;
    if (plain_file_open(path, &file)) {
        words first = words_of(path, &file.head, '#');
        words_next(&first);
        kind = mesh_kind_by(path, &first);
    }
    plain_file_close(&file);
    return kind;
}

bool mesh_is_binary_ply(const char *path)
{
    plain_file file = {.stream = NULL};
    bool is_binary = false;
    if (plain_file_open(path, &file)) {
        words w = words_of(path, &file.head, ' ');
        is_binary = words_next(&w) && words_is(&w, "ply") && words_next(&w) && words_is(&w, "format") && words_next(&w) &&
                    !words_is(&w, "ascii");
    }
    plain_file_close(&file);
    return is_binary;
}
