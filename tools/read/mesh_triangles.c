/* mesh_triangles.c - reads files of triangles in blocks, binary STL or raw; where the length is known, by threads in turn. */
#include "mesh.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/system.h"

/* A regular file that goes into room for all of it. */
typedef struct reading {
    mesh *m;
    triangle_file *file;
} reading;

/* A block, and its bytes. */
enum { BLOCK_ROOM = sizeof(triangle_block) + TRIANGLE_BLOCK_BYTES };

static bool begin_block(void *data, void *room)
{
    (void)data;
    ((triangle_block *)room)->bytes = (unsigned char *)((triangle_block *)room + 1);
    return true;
}

static int read_block(void *data, void *place, size_t n)
{
    reading *const r = data;
    triangle_block *const block = place;
    const size_t first = n * TRIANGLE_BLOCK, left = (size_t)r->file->promised - first;
    float *to[9];
    block->first = first;
    block->count = left < TRIANGLE_BLOCK ? left : TRIANGLE_BLOCK;
    reading_tell((double)first / (double)r->file->promised);
    if (r->m->is_double)
        return triangle_file_unpack(r->file, block, NULL, (double *)r->m->positions + 9 * first);
    mesh_streams(r->m, first, to);
    const int code = triangle_file_unpack(r->file, block, to, NULL);
    if (!code)
        mesh_look_add(first, block->count, r->m);
    return code;
}

/* A partition is made of such files piece by piece, so it needs no room for all triangles. */
static int make_room(const triangle_file *file, mesh *m)
{
    const uint64_t count = file->promised;
    bool has_room;
    if (file->format == TRIANGLES_F64) {
        double *const positions = count <= SIZE_MAX / sizeof(double[9]) ? malloc((size_t)count * sizeof(double[9]) + 1) : NULL;
        mesh_set_doubles(positions, 3 * (size_t)count, NULL, (size_t)count, m);
        has_room = positions;
    } else {
        has_room = !mesh_make_room(count ? NULL : file->name, count, m);
        m->triangles = m->soup.count = (size_t)count;
    }
    if (has_room)
        return EXIT_CODE_OK;
    return message_failure("%s: out of memory for %" PRIu64 " triangles; to voxelize it, sort it first: tribox partition %s -o "
                           "NAME.tiles, with the same grid",
                           file->name, count, file->name);
}

static int read_sized(triangle_file *file, unsigned threads, mesh *m)
{
    reading r = {.m = m, .file = file};
    int code = make_room(file, m);
    if (code)
        return code;
    const size_t blocks = (m->triangles + TRIANGLE_BLOCK - 1) / TRIANGLE_BLOCK;
    const crew_work work = {.count = blocks,
                            .threads = threads < blocks ? threads : (unsigned)blocks,
                            .place_bytes = BLOCK_ROOM,
                            .begin = begin_block,
                            .step = read_block};
    mesh_look_begin(m);
    reading_begin();
    code = crew_do(&work, &r);
    reading_end();
    if (code == MESSAGE_NO_MEMORY)
        return message_failure("%s: out of memory", file->name);
    file->taken = file->promised;
    code = code ? code : triangle_file_find(file, &(triangle_block){.count = 0});
    if (!code && m->is_double)
        mesh_look_all(NULL, threads, m);
    else if (!code)
        mesh_look_end(m);
    return code;
}

/* The triangles of a stream so far, nine numbers of this machine each. */
typedef struct listed {
    unsigned char *bytes;
    size_t count, room, each;
    bool is_double;
} listed;

static int check_memory(const char *name, size_t count, uint64_t needed)
{
    const uint64_t available = memory_available();
    char needed_text[16], available_text[16];
    if (needed <= available && needed <= SIZE_MAX)
        return EXIT_CODE_OK;
    return message_failure("%s: after %zu triangles the next take %s of memory and %s are available; save the mesh as a file, "
                           "which takes less",
                           name, count, memory_text(needed, needed_text), memory_text(available, available_text));
}

/* What the header of a stream promises is not believed. */
static int keep(const char *name, const triangle_block *block, listed *all)
{
    const uint64_t more = all->room ? 2 * (uint64_t)all->room : 16 * TRIANGLE_BLOCK;
    if (all->room - all->count < block->count) {
        const int code = check_memory(name, all->count, more * all->each);
        void *const bytes = code ? NULL : memory_grow(all->bytes, (size_t)more, &all->room, all->each);
        if (!bytes)
            return code ? code : message_failure("%s: out of memory after %zu triangles", name, all->count);
        all->bytes = bytes;
    }
    memcpy(all->bytes + all->count * all->each, block->bytes, block->count * all->each);
    all->count += block->count;
    return EXIT_CODE_OK;
}

/* Whether twice as much room, and what there is while it is copied, are too much. */
static bool is_over(const mesh_overflow *over, const listed *all)
{
    return over && over->memory / all->each < (all->room ? 3 * all->room : 16 * TRIANGLE_BLOCK);
}

/* Those that are listed go there first. */
static int overflow(mesh_overflow *over, const triangle_block *block, listed *all)
{
    const int code = all->count ? over->put(over->data, all->is_double, all->bytes, all->count * all->each) : EXIT_CODE_OK;
    free(all->bytes);
    *all = (listed){.each = all->each, .is_double = all->is_double};
    over->is_used = true;
    return code ? code : over->put(over->data, all->is_double, block->bytes, block->count * all->each);
}

static int make_mesh(const char *name, listed *all, unsigned threads, mesh *m)
{
    const tribox_mesh from = {.positions = all->bytes, .vertices = 3 * all->count, .count = all->count};
    if (all->is_double) {
        mesh_set_doubles((double *)(void *)all->bytes, from.vertices, NULL, from.count, m);
        all->bytes = NULL;
        mesh_look_all(NULL, threads, m);
        return EXIT_CODE_OK;
    }
    int code = check_memory(name, all->count, all->count * all->each);
    code = code ? code : mesh_make_room(name, all->count, m);
    return code || mesh_look_all(&from, threads, m) ? code : message_failure("%s: out of memory", name);
}

static int read_stream(triangle_file *file, unsigned threads, mesh_overflow *over, mesh *m)
{
    const bool is_double = file->format == TRIANGLES_F64;
    listed all = {.each = is_double ? sizeof(double[9]) : sizeof(float[9]), .is_double = is_double};
    triangle_block *const block = calloc(1, BLOCK_ROOM);
    int code = block && begin_block(NULL, block) ? EXIT_CODE_OK : message_failure("%s: out of memory", file->name);
    while (!code && !(code = triangle_file_find(file, block)) && block->count) {
        const bool is_full = all.room - all.count < block->count && is_over(over, &all);
        triangles_unpack(file->format, block->count, block->bytes);
        code = is_full || (over && over->is_used) ? overflow(over, block, &all) : keep(file->name, block, &all);
    }
    free(block);
    if (!code && !(over && over->is_used))
        code = make_mesh(file->name, &all, threads, m);
    free(all.bytes);
    return code;
}

int mesh_read_triangles(triangle_file *file, unsigned threads, mesh_overflow *over, mesh *m)
{
    return file->is_sized ? read_sized(file, threads, m) : read_stream(file, threads, over, m);
}
