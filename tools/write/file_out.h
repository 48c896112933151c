/* file_out.h - a file that appears under its name only when all of it has been written. */
#ifndef FILE_OUT_H
#define FILE_OUT_H

#include <stdbool.h>
#include <stdio.h>

/*
 * Until it is kept the file is ".tribox-" and six letters in the folder where it will be; a run that is killed leaves that there,
 * and whatever stood under the name as it was. Where the name is a symbolic link, the file that it leads to is written.
 */
typedef struct file_out {
    FILE *stream;     /* NULL when nothing is open */
    const char *path; /* as it was given */
    char *target, *beside;
} file_out;

/* "-", which is written as it comes. */
bool file_out_is_stdout(const char *path);

/* Returns an exit_code. A path of NULL opens nothing, and the other calls then do nothing. */
int file_out_open(file_out *out, const char *path);

/* The line of a write that failed, whose reason errno tells. Returns EXIT_CODE_FAILURE. */
int file_out_failure(const file_out *out);

/* Writes out all that is pending and gives the file its name. Returns an exit_code; on failure nothing is left. */
int file_out_keep(file_out *out);

/* Removes what has been written, if it has not been kept. */
void file_out_drop(file_out *out);

#endif
