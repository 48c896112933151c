/* file_out.h - a file, or a folder of files, that appears under its name only when all of it has been written. */
#ifndef FILE_OUT_H
#define FILE_OUT_H

#include <stdbool.h>
#include <stdio.h>

/*
 * Until it is kept the file is ".tribox-" and six letters in the folder where it will be; a run that is killed leaves that there,
 * and whatever stood under the name as it was. Where the name is a symbolic link, the file that it leads to is written.
 */
typedef struct file_out {
    FILE *stream;     /* NULL when nothing is open, or all of it has been written */
    const char *path; /* as it was given */
    char *target, *beside;
} file_out;

/* "-", which is written as it comes; false for NULL. */
bool file_out_is_stdout(const char *path);

/* The names that a command writes, and the options that give them; NULL for none. */
enum { FILE_OUT_NAMES = 2 };
typedef struct file_out_names {
    const char *option[FILE_OUT_NAMES], *path[FILE_OUT_NAMES];
} file_out_names;

/*
 * Refuses two names of one file, by whatever links, and the name of a file that is read, or that is in a folder that is. what: the
 * word for those that are read. Returns an exit_code.
 */
int file_out_check(const file_out_names *names, const char *what, const char *const *read, size_t count);

/* Returns an exit_code. A path of NULL opens nothing, and the other calls then do nothing. */
int file_out_open(file_out *out, const char *path);

/* The line of a write that failed, whose reason errno tells. Returns EXIT_CODE_FAILURE. */
int file_out_failure(const file_out *out);

/* Writes out all that is pending and gives the file its name. Returns an exit_code; on failure nothing is left. */
int file_out_keep(file_out *out);

/* The same of two files: both get their names, or neither, and what had them stays. */
int file_out_keep_both(file_out *one, file_out *other);

/* Removes what has been written, if it has not been kept. */
void file_out_drop(file_out *out);

/*
 * Opens a nameless file, gone with the program, for what cannot go where it belongs yet: on the disk of the output; for standard
 * output where TMPDIR says, or in /tmp. NULL after a line.
 */
FILE *spool_open(const file_out *out);

/* Hands on all of it from its start, until some is not taken. Returns an exit_code. */
int spool_read(FILE *spool, const file_out *out, bool (*take)(void *data, const void *bytes, size_t count), void *data);

enum { FOLDER_FILES = 3 }; /* at most */

/* Until it is kept the folder is ".tribox-" and six letters beside its place; a run that is killed leaves that there. */
typedef struct folder_out {
    const char *path; /* as it was given */
    const char *told; /* what messages call it */
    char *beside;
    FILE *file[FOLDER_FILES]; /* NULL: there is no such file */
    char *name[FOLDER_FILES]; /* in `beside` */
} folder_out;

/*
 * Makes it, with files of these names, up to the first NULL. What stands under the name already is refused. told: NULL, or what
 * messages call one that is never kept, but used where it is. Returns an exit_code.
 */
int folder_out_open(folder_out *out, const char *path, const char *told, const char *const names[FOLDER_FILES]);

/* Writes out all that is pending; the folder stays where it is until it is dropped. Returns an exit_code. */
int folder_out_finish(folder_out *out);

/* Writes out all that is pending and gives the folder its name. Returns an exit_code; on failure nothing is left. */
int folder_out_keep(folder_out *out);

/* A nameless file in the folder, likewise. NULL with errno. */
FILE *folder_out_spill(const folder_out *out);

/* The line of a write that failed for this errno. Returns EXIT_CODE_FAILURE. */
int folder_out_failure(const folder_out *out, int reason);

/* Removes what has been written, if it has not been kept. */
void folder_out_drop(folder_out *out);

#endif
