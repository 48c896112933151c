/* file_map_posix.c - maps files by mmap. */
#define _POSIX_C_SOURCE 200809L
#include "file_map.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static bool map_open(file_map *map, int file)
{
    struct stat about;
    if (fstat(file, &about) || !S_ISREG(about.st_mode))
        return false;
    if (!about.st_size)
        return true;
    void *const bytes = mmap(NULL, (size_t)about.st_size, PROT_READ, MAP_PRIVATE, file, 0);
    if (bytes == MAP_FAILED)
        return false;
    *map = (file_map){bytes, (size_t)about.st_size};
    return true;
}

file_map_result file_map_open(file_map *map, const char *path)
{
    *map = (file_map){NULL, 0};
    const int file = open(path, O_RDONLY);
    if (file < 0)
        return FILE_MAP_NOT_OPENED;
    const bool is_mapped = map_open(map, file);
    close(file);
    return is_mapped ? FILE_MAP_OK : FILE_MAP_REFUSED;
}

bool file_map_of_stream(file_map *map, FILE *stream)
{
    *map = (file_map){NULL, 0};
    return map_open(map, fileno(stream));
}

void file_map_close(file_map *map)
{
    if (map->bytes)
        munmap(map->bytes, map->size);
    *map = (file_map){NULL, 0};
}
