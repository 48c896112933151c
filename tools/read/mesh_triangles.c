/* mesh_triangles.c - reads files of triangles in blocks, binary STL or raw; where the length is known, by threads in turn. */
#include "mesh.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/system.h"
#include "console/message.h"
#include "mesh_file.h"

/* A regular file that goes into room for all of it. */
typedef struct reading {
    mesh *m;
    triangle_file *file;
    int code; /* of finding blocks */
    mesh_look look;
} reading;

static void *make_block(void *data)
{
    (void)data;
    triangle_block *const block = malloc(sizeof *block + TRIANGLE_BLOCK_BYTES);
    if (block)
        *block = (triangle_block){.bytes = (unsigned char *)(block + 1)};
    return block;
}

static bool find_block(void *data, void *block, size_t n)
{
    reading *const r = data;
    (void)n;
    r->code = triangle_file_find(r->file, block);
    return !r->code && ((triangle_block *)block)->count;
}

static int read_block(void *data, void *place, size_t n)
{
    reading *const r = data;
    triangle_block *const block = place;
    const size_t first = (size_t)block->first;
    float *to[9];
    (void)n;
    if (r->m->is_double)
        return triangle_file_unpack(r->file, block, NULL, (double *)r->m->positions + 9 * first);
    mesh_streams(r->m, first, to);
    const int code = triangle_file_unpack(r->file, block, to, NULL);
    if (!code)
        mesh_look_add(r->m, first, block->count, &r->look);
    return code;
}

static int tell_block(void *data, void *block, size_t n)
{
    const reading *const r = data;
    (void)n;
    reading_tell((double)((triangle_block *)block)->first / (double)r->file->promised);
    return EXIT_CODE_OK;
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
    const uint64_t blocks = file->promised / TRIANGLE_BLOCK + 1;
    reading r = {.m = m, .file = file, .look = mesh_look_none()};
    const crew_work work = {.threads = threads < blocks ? threads : (unsigned)blocks,
                            .begin = make_block,
                            .end = free,
                            .find = find_block,
                            .step = read_block,
                            .tell = tell_block};
    int code = file->format == TRIANGLES_F64 ? make_doubles(file, m) : make_floats(file, m);
    if (code)
        return code;
    reading_begin();
    code = crew_do(&work, &r);
    reading_end();
    if (code == MESSAGE_NO_MEMORY)
        code = message_failure("%s: out of memory", file->name);
    m->triangles = (size_t)file->promised;
    if (!m->is_double)
        m->soup.count = m->triangles;
    code = code ? code : r.code;
    if (!code && m->is_double)
        mesh_look_all(threads, m);
    else if (!code)
        mesh_look_keep(&r.look, m);
    return code;
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

/* Numbers of this machine, of which others are made in the same way as from them. */
static int put_over(const mesh_overflow *over, bool is_double, size_t count, unsigned char *numbers)
{
    triangles_unpack(is_double ? TRIANGLES_F64 : TRIANGLES_F32, count, numbers);
    return over->put(over->data, is_double, numbers, count * (is_double ? sizeof(double[9]) : sizeof(float[9])));
}

static void lay(const mesh *m, bool is_double, size_t first, size_t count, unsigned char *to)
{
    if (is_double) {
        memcpy(to, (const double *)m->positions + 9 * first, count * sizeof(double[9]));
        return;
    }
    const float *const *const streams[3] = {m->soup.x, m->soup.y, m->soup.z};
    for (size_t k = 0; k < 9 * count; k++)
        memcpy(to + k * sizeof(float), &streams[k % 3][k % 9 / 3][first + k / 9], sizeof(float));
}

/* The triangles that there are, then those of the block, then the rest. */
static int overflow(triangle_file *file, triangle_block *block, mesh_overflow *over, bool is_double, mesh *m)
{
    triangle_block *const room = make_block(NULL);
    int code = room ? EXIT_CODE_OK : message_failure("%s: out of memory", file->name);
    over->is_used = true;
    for (size_t first = 0; !code && first < m->triangles; first += TRIANGLE_BLOCK) {
        const size_t left = m->triangles - first, count = left < TRIANGLE_BLOCK ? left : TRIANGLE_BLOCK;
        lay(m, is_double, first, count, room->bytes);
        code = put_over(over, is_double, count, room->bytes);
    }
    free(room);
    mesh_free(m);
    while (!code && block->count) {
        triangles_unpack(file->format, block->count, block->bytes);
        code = put_over(over, is_double, block->count, block->bytes);
        if (!code)
            code = triangle_file_find(file, block);
    }
    return code;
}

/* Whether twice as much room, and what there is while it is copied, are too much. */
static bool is_over(const mesh_overflow *over, size_t room, bool is_double)
{
    return over && over->memory / (is_double ? sizeof(double[9]) : sizeof(float[9])) < (room ? 3 * room : 16 * TRIANGLE_BLOCK);
}

static int read_stream(triangle_file *file, mesh_overflow *over, mesh *m)
{
    const bool is_double = file->format == TRIANGLES_F64;
    triangle_block *const block = make_block(NULL);
    size_t room = 0;
    int code = block ? EXIT_CODE_OK : message_failure("%s: out of memory", file->name);
    while (!code && !(code = triangle_file_find(file, block)) && block->count) {
        float *to[9];
        if (room - m->triangles < TRIANGLE_BLOCK && is_over(over, room, is_double)) {
            code = overflow(file, block, over, is_double, m);
            break;
        }
        if (room - m->triangles < TRIANGLE_BLOCK)
            code = more_room(file->name, is_double, &room, m);
        if (code)
            break;
        if (!is_double)
            mesh_streams(m, m->triangles, to);
        code = triangle_file_unpack(file, block, to, is_double ? (double *)m->positions + 9 * m->triangles : NULL);
        m->triangles += block->count;
        m->soup.count = is_double ? 0 : m->triangles;
    }
    free(block);
    if (!code && is_double && m->triangles)
        mesh_set_doubles(m->positions, 3 * m->triangles, NULL, m->triangles, m);
    return code || m->triangles || (over && over->is_used) ? code : message_failure("%s: contains no triangles", file->name);
}

int mesh_read_triangles(triangle_file *file, unsigned threads, mesh_overflow *over, mesh *m)
{
    if (file->is_sized)
        return read_sized(file, threads, m);
    const int code = read_stream(file, over, m);
    if (!code && m->triangles)
        mesh_look_all(threads, m);
    return code;
}
