/* double_triangles.c - reads blocks of doubles into memory that doubles where the length is not known. */
#include "double_triangles.h"

#include <inttypes.h>
#include <stdlib.h>

#include "console/memory.h"
#include "console/message.h"

enum { TRIANGLE_BYTES = 9 * sizeof(double) };

int triangles_more_room(const char *name, size_t count, size_t there, size_t triangle_bytes, uint64_t *room)
{
    enum { FIRST = 16 * TRIANGLE_BLOCK };
    char needed[16], left[16];
    *room = there ? 2 * (uint64_t)there : FIRST;
    const uint64_t bytes = *room * triangle_bytes, available = memory_available();
    if (bytes <= available && bytes <= SIZE_MAX)
        return EXIT_CODE_OK;
    return message_failure("%s: after %zu triangles the next take %s of memory and %s are available; save the mesh as a file, "
                           "which takes less",
                           name, count, memory_text(bytes, needed), memory_text(available, left));
}

static int make_room(const triangle_file *file, double_triangles *d)
{
    uint64_t room = file->promised;
    if (!file->is_sized) {
        const int code = triangles_more_room(file->name, d->count, d->capacity, TRIANGLE_BYTES, &room);
        if (code)
            return code;
    }
    double *const grown = room <= SIZE_MAX / TRIANGLE_BYTES ? realloc(d->positions, (size_t)room * TRIANGLE_BYTES + 1) : NULL;
    if (!grown)
        return message_failure("%s: out of memory for %" PRIu64 " triangles", file->name, room);
    d->positions = grown;
    d->capacity = (size_t)room;
    return EXIT_CODE_OK;
}

int double_triangles_read(triangle_file *file, double_triangles *d)
{
    size_t count = 1;
    *d = (double_triangles){.positions = NULL};
    int code = file->is_sized ? make_room(file, d) : EXIT_CODE_OK;
    while (!code && count) {
        if (!file->is_sized && d->capacity - d->count < TRIANGLE_BLOCK)
            code = make_room(file, d);
        if (code)
            break;
        code = triangle_file_next_doubles(file, d->positions + 9 * d->count, &count);
        d->count += count;
    }
    if (!code && !d->count)
        code = message_failure("%s: contains no triangles", file->name);
    if (code)
        free(d->positions);
    return code;
}
