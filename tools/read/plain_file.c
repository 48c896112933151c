/* plain_file.c - opens a file whose parts are read where they stand. */
#include <stdlib.h>

#include "files/named_file.h"
#include "plain.h"

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
