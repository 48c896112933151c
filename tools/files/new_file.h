/* new_file.h - temporary files and folders. Their names are given ending in XXXXXX, and come back with other letters there. */
#ifndef NEW_FILE_H
#define NEW_FILE_H

#include <stdbool.h>
#include <stdio.h>

/* With the rights of any new file, to be written. NULL with errno. */
FILE *new_file_open(char *name);

/* To be written and read, and gone when it is closed or the program ends in whatever way. NULL with errno. */
FILE *new_file_open_nameless(char *name);

/* A folder. False with errno. */
bool new_file_make_folder(char *name);

/* Gives a closed file or a folder its name. A file takes the place of another that has it, at once. False with errno. */
bool new_file_rename(const char *from, const char *to);
bool new_file_rename_folder(const char *from, const char *to);

void new_file_remove(const char *name);
void new_file_remove_folder(const char *name);

/* Where writing to this name goes: a link stays, and the file behind it is the one. To be freed; NULL with errno. */
char *new_file_target(const char *path);

/* Where files go that have no folder of their own. To be freed; NULL without memory. */
char *new_file_passing_folder(void);

/* From now on writing beyond a limit on file sizes or, with `is_stdout`, where nobody reads on, fails as on a full disk. */
void new_file_fail_quietly(bool is_stdout);

#endif
