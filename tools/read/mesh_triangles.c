/* mesh_triangles.c - reads files of triangles block by block; where the length is known, threads take blocks in turn. */
#include "mesh_triangles.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/message.h"
#include "double_triangles.h"
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

static int read_found(const reading *r, triangle_block *block, mesh_look *look)
{
    const size_t first = (size_t)block->first;
    float *to[9];
    if (r->m->is_double)
        return triangle_file_unpack(r->file, block, NULL, (double *)r->m->positions + 9 * first);
    mesh_streams(r->m, first, to);
    const int code = triangle_file_unpack(r->file, block, to, NULL);
    if (!code)
        mesh_look_at(r->m, first, block->count, look);
    return code;
}

static void read_blocks(void *data, unsigned thread)
{
    reading *const r = data;
    mesh_look own = mesh_look_none();
    (void)thread;
    triangle_block block = {.bytes = malloc(TRIANGLE_BLOCK_BYTES)};
    int code = block.bytes ? EXIT_CODE_OK : message_failure("%s: out of memory", r->file->name);
    while (!code && find_block(r, &block)) {
        code = read_found(r, &block, &own);
        reading_tell((double)block.first / (double)r->file->promised);
    }
    free(block.bytes);
    pthread_mutex_lock(&r->lock);
    r->code = code ? code : r->code;
    mesh_look_join(&own, &r->look);
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

static int read_floats(triangle_file *file, mesh *m)
{
    int code = EXIT_CODE_OK;
    for (size_t count = 1; !code && count; m->soup.count += code ? 0 : count) {
        float *to[9];
        if (m->capacity - m->soup.count < TRIANGLE_BLOCK)
            code = mesh_more_room(file->name, m);
        if (code)
            break;
        mesh_streams(m, m->soup.count, to);
        code = triangle_file_next(file, to, &count);
    }
    m->triangles = m->soup.count;
    return code || m->soup.count ? code : message_failure("%s: contains no triangles", file->name);
}

static int read_doubles(triangle_file *file, mesh *m)
{
    double_triangles found;
    const int code = double_triangles_read(file, &found);
    if (!code)
        mesh_set_doubles(found.positions, 3 * found.count, NULL, found.count, m);
    return code;
}

int mesh_read_triangles(triangle_file *file, unsigned threads, mesh *m)
{
    if (file->is_sized)
        return read_sized(file, threads, m);
    const int code = file->format == TRIANGLES_F64 ? read_doubles(file, m) : read_floats(file, m);
    if (!code)
        mesh_look_all(threads, m);
    return code;
}
