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
#include "words.h"

/* In pieces, between which it is told how far this is. */
static bool read_pieces(FILE *stream, whole_file *file)
{
    const size_t piece = (size_t)1 << 22;
    bool is_read = true;
    reading_begin();
    for (size_t at = 0; is_read && at < file->size; at += piece) {
        const size_t left = file->size - at, count = left < piece ? left : piece;
        is_read = fread(file->bytes + at, 1, count, stream) == count;
        reading_tell((double)at / (double)file->size);
    }
    reading_end();
    return is_read;
}

static int read_bytes(const char *path, FILE *stream, whole_file *file)
{
    file->bytes = malloc(file->size + 1);
    if (!file->bytes)
        return message_failure("%s: out of memory: the file has %zu bytes" MESH_TO_SORT, path, file->size);
    errno = 0;
    if (read_pieces(stream, file)) {
        file->bytes[file->size] = '\0';
        return EXIT_CODE_OK;
    }
    const char *reason = errno ? strerror(errno) : "it became shorter while it was read";
    whole_file_free(file);
    return message_failure("%s: cannot read the file: %s", path, reason);
}

/* Whether the reader of a kind takes what a file begins with, in as far as it is read. */
static bool is_begun(mesh_kind kind, const whole_file *file)
{
    words first = words_of(NULL, file, '#');
    const bool has_word = words_next(&first);
    if (kind == MESH_PLY)
        return has_word && first.word == file->bytes && words_is(&first, "ply");
    return kind != MESH_OFF || !has_word || !strncmp(first.word + strspn(first.word, "STCN"), "OFF", 3);
}

/* Its size is known at its end. What begins like no mesh of its kind is left there, for the kind's reader to refuse. */
static int read_stdin(mesh_kind kind, whole_file *file)
{
    const size_t piece = (size_t)1 << 22;
    size_t room = 0, got = piece;
    while (got == piece) {
        char *const bytes = room < memory_available() ? memory_grow(file->bytes, file->size + piece + 1, &room, 1) : NULL;
        if (!bytes)
            return message_failure("stdin: out of memory after %zu bytes" MESH_TO_SORT, file->size);
        file->bytes = bytes;
        errno = 0;
        got = fread(bytes + file->size, 1, piece, stdin);
        file->size += got;
        file->bytes[file->size] = '\0';
        if (file->size == piece && !is_begun(kind, file))
            break;
    }
    if (ferror(stdin))
        return message_failure("stdin: cannot read the mesh: %s", strerror(errno));
    return file->size ? EXIT_CODE_OK : message_failure("stdin: the file is empty");
}

int whole_file_read(const char *path, mesh_kind kind, whole_file *file)
{
    file_about about;
    *file = (whole_file){NULL, 0};
    if (!strcmp(path, "-"))
        return read_stdin(kind, file);
    if (!named_file_about(path, &about))
        return message_failure("%s: cannot open the mesh file: %s", path, strerror(errno));
    if (about.kind != FILE_KIND_REGULAR)
        return message_failure("%s: is %s; give a mesh file", path,
                               about.kind == FILE_KIND_FOLDER ? "a directory" : "not a regular file");
    if (about.size == 0)
        return message_failure("%s: the file is empty", path);
    if (about.size >= SIZE_MAX)
        return message_failure("%s: the file is too large for the address space", path);

    FILE *stream = named_file_open(path, "rb");
    if (!stream)
        return message_failure("%s: cannot open the mesh file: %s", path, strerror(errno));
    file->size = (size_t)about.size;
    const int code = read_bytes(path, stream, file);
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

bool mesh_is_binary_ply(const char *path)
{
    plain_file file = {.path = path};
    bool is_binary = false;
    if (plain_file_open(path, &file)) {
        words w = words_of(path, &file.head, ' ');
        is_binary = words_next(&w) && words_is(&w, "ply") && words_next(&w) && words_is(&w, "format") && words_next(&w) &&
                    !words_is(&w, "ascii");
    }
    plain_file_close(&file);
    return is_binary;
}
