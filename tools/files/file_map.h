/* file_map.h - the bytes of a file in memory, read as they are looked at. */
#ifndef FILE_MAP_H
#define FILE_MAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

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

#endif
