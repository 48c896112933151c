/* files.h - files by their names in any alphabet: opened, mapped, and made to appear when they are whole. */
#ifndef FILES_H
#define FILES_H

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

typedef struct file_map {
    void *bytes; /* NULL for an empty file */
    size_t size;
    struct file_map_watch *watch; /* of a system on which others may cut the file */
} file_map;

typedef enum file_map_result { FILE_MAP_OK, FILE_MAP_NOT_OPENED, FILE_MAP_REFUSED } file_map_result;

/*
 * Where others cut the file, looking at bytes that it has no more ends the program as a failure, with the line that it has changed
 * and nothing left of what it writes. Maps are opened and closed by one thread.
 *
 * NOT_OPENED with errno. REFUSED: no regular file, or no addresses.
 */
file_map_result file_map_open(file_map *map, const char *path);

/* Of a file that is open, whatever its name. False where that is refused. */
bool file_map_of_stream(file_map *map, FILE *stream);

void file_map_close(file_map *map);

/* With the rights of any new file, to be written. NULL with errno. */
FILE *new_file_open(char *name);

/* Gives a new file the rights of the one whose place it will take, if there is one: before anything is written. */
void new_file_take_rights(FILE *to, const char *of);

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
