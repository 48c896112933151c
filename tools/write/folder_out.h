/* folder_out.h - a folder that appears under its name only when all of its files have been written. */
#ifndef FOLDER_OUT_H
#define FOLDER_OUT_H

#include <stdio.h>

enum { FOLDER_FILES = 3 }; /* at most */

/* Until it is kept the folder is ".tribox-" and six letters beside its place; a run that is killed leaves that there. */
typedef struct folder_out {
    const char *path; /* as it was given */
    char *beside;
    FILE *file[FOLDER_FILES]; /* NULL: there is no such file */
    char *name[FOLDER_FILES]; /* in `beside` */
} folder_out;

/*
 * Makes it, with files of these names, up to the first NULL. What stands under the name already is refused. Returns an exit_code.
 */
int folder_out_open(folder_out *out, const char *path, const char *const names[FOLDER_FILES]);

/* Writes out all that is pending and gives the folder its name. Returns an exit_code; on failure nothing is left. */
int folder_out_keep(folder_out *out);

/* A nameless file in the folder, for what waits until it can be written; gone when it is closed. NULL with errno. */
FILE *folder_out_spill(const folder_out *out);

/* The line of a write that failed for this errno. Returns EXIT_CODE_FAILURE. */
int folder_out_failure(const folder_out *out, int reason);

/* Removes what has been written, if it has not been kept. */
void folder_out_drop(folder_out *out);

#endif
