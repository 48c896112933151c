/* file_map_windows.c - maps files by MapViewOfFile. */
#include "file_map.h"

#include <io.h>

#include "named_file.h"
#include "windows_file.h"

static bool map_open(file_map *map, FILE *stream)
{
    file_about about;
    if (!named_file_about_open(stream, &about) || about.kind != FILE_KIND_REGULAR)
        return false;
    if (!about.size)
        return true;
    const HANDLE mapping = CreateFileMappingW((HANDLE)_get_osfhandle(_fileno(stream)), NULL, PAGE_READONLY, 0, 0, NULL);
    if (!mapping)
        return false;
    map->bytes = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
    map->size = map->bytes ? (size_t)about.size : 0;
    CloseHandle(mapping); /* the view keeps it */
    return map->bytes;
}

file_map_result file_map_open(file_map *map, const char *path)
{
    *map = (file_map){.bytes = NULL};
    FILE *const stream = named_file_open(path, "rb");
    if (!stream)
        return FILE_MAP_NOT_OPENED;
    const bool is_mapped = map_open(map, stream);
    fclose(stream);
    return is_mapped ? FILE_MAP_OK : FILE_MAP_REFUSED;
}

bool file_map_of_stream(file_map *map, FILE *stream)
{
    *map = (file_map){.bytes = NULL};
    return map_open(map, stream);
}

void file_map_close(file_map *map)
{
    if (map->bytes)
        UnmapViewOfFile(map->bytes);
    *map = (file_map){.bytes = NULL};
}
