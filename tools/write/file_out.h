/* file_out.h - a file that appears under its name only when all of it is written. */
#ifndef FILE_OUT_H
#define FILE_OUT_H

#include <stdio.h>

/* Until it is kept it is written beside, as NAME.XXXXXX; that file goes when the program fails or is interrupted. */
typedef struct file_out {
    FILE *stream;
    const char *path;
    char *beside; /* NULL when nothing is open */
} file_out;

/* Returns an exit_code. At most four are open at a time. A path of NULL opens nothing, and the rest then does nothing. */
int file_out_open(file_out *out, const char *path);

/* Writes out all that is pending and gives the file its name. Returns an exit_code; on failure nothing is left. */
int file_out_keep(file_out *out);

/* Removes what has been written, if it has not been kept. */
void file_out_drop(file_out *out);

#endif
