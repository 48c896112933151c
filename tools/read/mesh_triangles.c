/* mesh_triangles.c - reads files of triangles in blocks, binary STL or raw; where the length is known, by threads in turn. */
#include "mesh.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/memory.h"
#include "console/message.h"
#include "mesh_look.h"
#include "reading.h"

/* A regular file that goes into room for all of it. */
typedef struct reading {
    mesh *m;
    pthread_mutex_t lock; /* of what follows */
    triangle_file *file;
    int code;
    mesh_look look;
} reading;

static bool find_block(reading *r, triangle_block *block)
{
    pthread_mutex_lock(&r->lock);
    if (!r->code)
        r->code = triangle_file_find(r->file, block);
    const bool is_there = !r->code && block->count;
    pthread_mutex_unlock(&r->lock);
    return is_there;
}

static int read_found(reading *r, triangle_block *block)
{
    const size_t first = (size_t)block->first;
    float *to[9];
    if (r->m->is_double)
        return triangle_file_unpack(r->file, block, NULL, (double *)r->m->positions + 9 * first);
    mesh_streams(r->m, first, to);
    const int code = triangle_file_unpack(r->file, block, to, NULL);
    if (!code)
        mesh_look_add(r->m, first, block->count, &r->look);
    return code;
}

static void read_blocks(void *data, unsigned thread)
{
    reading *const r = data;
    (void)thread;
    triangle_block block = {.bytes = malloc(TRIANGLE_BLOCK_BYTES)};
    int code = block.bytes ? EXIT_CODE_OK : message_failure("%s: out of memory", r->file->name);
    while (!code && find_block(r, &block)) {
        code = read_found(r, &block);
        reading_tell((double)block.first / (double)r->file->promised);
    }
    free(block.bytes);
    pthread_mutex_lock(&r->lock);
    r->code = code ? code : r->code;
    pthread_mutex_unlock(&r->lock);
}

/* A partition is made of such files piece by piece, so it needs no room for all triangles. */
static int lacks_room(const triangle_file *file)
{
    return message_failure("%s: out of memory for %" PRIu64 " triangles; to voxelize it, sort it first: tribox partition %s -o "
                           "NAME.tiles, with the same grid",
                           file->name, file->promised, file->name);
}

static int make_floats(const triangle_file *file, mesh *m)
{
    return !file->promised ? mesh_make_room(file->name, 0, m) : mesh_take_room(file->promised, m) ? EXIT_CODE_OK : lacks_room(file);
}

static int make_doubles(const triangle_file *file, mesh *m)
{
    const uint64_t count = file->promised;
    double *const positions = count <= SIZE_MAX / sizeof(double[9]) ? malloc((size_t)count * sizeof(double[9]) + 1) : NULL;
    if (!positions)
        return lacks_room(file);
    mesh_set_doubles(positions, 3 * (size_t)count, NULL, (size_t)count, m);
    return EXIT_CODE_OK;
}

static int read_sized(triangle_file *file, unsigned threads, mesh *m)
{
    const int code = file->format == TRIANGLES_F64 ? make_doubles(file, m) : make_floats(file, m);
    reading r = {.m = m, .file = file, .code = code, .look = mesh_look_none()};
    if (code)
        return code;
    pthread_mutex_init(&r.lock, NULL);
    reading_begin();
    crew_run(threads, read_blocks, &r);
    reading_end();
    pthread_mutex_destroy(&r.lock);
    m->triangles = (size_t)file->promised;
    if (!m->is_double)
        m->soup.count = m->triangles;
    if (!r.code && m->is_double)
        mesh_look_all(threads, m);
    else if (!r.code)
        mesh_look_keep(&r.look, m);
    return r.code;
}

/* Room for a block more at least. What the header of a stream promises is not believed. */
static int more_room(const char *name, bool is_double, size_t *room, mesh *m)
{
    const size_t bytes = is_double ? sizeof(double[9]) : sizeof(float[9]), count = m->triangles;
    const uint64_t more = *room ? 2 * (uint64_t)*room : 16 * TRIANGLE_BLOCK, needed = more * bytes, available = memory_available();
    char needed_text[16], available_text[16];
    if (needed > available || needed > SIZE_MAX)
        return message_failure("%s: after %zu triangles the next take %s of memory and %s are available; save the mesh as a file, "
                               "which takes less",
                               name, count, memory_text(needed, needed_text), memory_text(available, available_text));
    double *const positions = is_double ? realloc(m->positions, (size_t)needed) : NULL;
    if (is_double ? !positions : !mesh_grow(more, m))
        return message_failure("%s: out of memory after %zu triangles", name, count);
    m->positions = positions;
    *room = (size_t)more;
    return EXIT_CODE_OK;
}

static int read_stream(triangle_file *file, mesh *m)
{
    const bool is_double = file->format == TRIANGLES_F64;
    size_t room = 0, count = 1;
    int code = EXIT_CODE_OK;
    while (!code && count) {
        float *to[9];
        if (room - m->triangles < TRIANGLE_BLOCK)
            code = more_room(file->name, is_double, &room, m);
        if (code)
            break;
        if (!is_double)
            mesh_streams(m, m->triangles, to);
        code = is_double ? triangle_file_next_doubles(file, (double *)m->positions + 9 * m->triangles, &count)
                         : triangle_file_next(file, to, &count);
        m->triangles += count;
        m->soup.count = is_double ? 0 : m->triangles;
    }
    if (!code && is_double)
        mesh_set_doubles(m->positions, 3 * m->triangles, NULL, m->triangles, m);
    return code || m->triangles ? code : message_failure("%s: contains no triangles", file->name);
}

int mesh_read_triangles(triangle_file *file, unsigned threads, mesh *m)
{
    if (file->is_sized)
        return read_sized(file, threads, m);
    const int code = read_stream(file, m);
    if (!code)
        mesh_look_all(threads, m);
    return code;
}
