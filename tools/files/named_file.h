/* named_file.h - what stands under a name. Names are UTF-8 on Windows, and elsewhere the bytes that the system takes. */
#ifndef NAMED_FILE_H
#define NAMED_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef enum file_kind { FILE_KIND_REGULAR, FILE_KIND_FOLDER, FILE_KIND_OTHER } file_kind;

typedef struct file_about {
    file_kind kind;
    uint64_t size;    /* of a regular file */
    uint64_t changed; /* when it was, in a measure of the system's own */
} file_about;

/* Mode "rb" or "wb". NULL with errno. */
FILE *named_file_open(const char *path, const char *mode);

/* Of what links lead to. False with errno. */
bool named_file_about(const char *path, file_about *about);
bool named_file_about_open(FILE *stream, file_about *about);

/*
 * Reads from an offset of a regular file, wherever the stream stands; several threads may at once. *got is less than bytes where
 * the file ends. False with errno.
 */
bool named_file_read_at(FILE *stream, uint64_t offset, void *to, size_t bytes, size_t *got);

/* Writes at an offset of a regular file, wherever the stream stands; several threads may at once. False with errno. */
bool named_file_write_at(FILE *stream, uint64_t offset, const void *from, size_t bytes);

/* Whether there is anything, be it a link that leads nowhere. */
bool named_file_is_there(const char *path);

/* Whether two names lead to one file, or will: what stands there counts or, where nothing does, the folder and the name in it. */
bool named_file_is_same(const char *a, const char *b);

/* How many of the name's characters are its folder, the last separator among them. */
size_t named_file_folder(const char *path);

/* Whether files can be made in the current folder. */
bool named_file_is_writable_here(void);

#endif
