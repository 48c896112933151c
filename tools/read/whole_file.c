/* whole_file.c - reads a whole file, with a reason for each way that can fail. */
#include "whole_file.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "files/named_file.h"
#include "reading.h"

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
        return message_failure("%s: out of memory: the file has %zu bytes", path, file->size);
    errno = 0;
    if (read_pieces(stream, file)) {
        file->bytes[file->size] = '\0';
        return EXIT_CODE_OK;
    }
    const char *reason = errno ? strerror(errno) : "it became shorter while it was read";
    whole_file_free(file);
    return message_failure("%s: cannot read the file: %s", path, reason);
}

int whole_file_read(const char *path, whole_file *file)
{
    file_about about;
    *file = (whole_file){NULL, 0};
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
