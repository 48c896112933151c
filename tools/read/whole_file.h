/* whole_file.h - the bytes of a whole file. */
#ifndef WHOLE_FILE_H
#define WHOLE_FILE_H

#include <stddef.h>

/* A NUL byte follows the last byte of the file. */
typedef struct whole_file {
    char *bytes;
    size_t size;
} whole_file;

/* Reads a regular file that is not empty. Returns an exit_code; whole_file_free may follow in any case. */
int whole_file_read(const char *path, whole_file *file);

void whole_file_free(whole_file *file);

#endif
