/* check_stl.c - refuses an STL file that ends before its last triangle. */
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "mesh_file.h"
#include "message.h"

enum { HEADER_SIZE = 84, TRIANGLE_SIZE = 50 };

/* A binary file may begin with "solid" as well: its size tells first. */
static uint64_t binary_size(const mesh_file *file)
{
    uint64_t count = 0;
    for (int i = 3; i >= 0 && file->size >= HEADER_SIZE; i--)
        count = count << 8 | (unsigned char)file->bytes[80 + i];
    return HEADER_SIZE + TRIANGLE_SIZE * count;
}

static const char *last_of(const char *text, const char *word)
{
    const char *last = NULL;
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word))
        last = at;
    return last;
}

int mesh_file_check_stl(const char *path, const mesh_file *file)
{
    const bool is_text = !strncmp(file->bytes, "solid", 5) && !memchr(file->bytes, '\0', file->size);
    if (!is_text && file->size < binary_size(file))
        return message_failure("%s: truncated, or no STL file: it has %zu bytes where an STL file with this header has %llu", path,
                               file->size, (unsigned long long)binary_size(file));
    const char *last = is_text ? last_of(file->bytes, "facet") : NULL;
    if (last && !strstr(last, "endsolid"))
        return message_failure("%s: truncated: no 'endsolid' behind the last facet", path);
    return EXIT_CODE_OK;
}
