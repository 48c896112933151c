/* plain_ply_binary.c - binary PLY files of triangles: threads take blocks of vertices in turn, then of faces. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/system.h"
#include "files/files.h"
#include "little.h"
#include "mesh.h"
#include "plain.h"
#include "mesh_file.h"

/* Vertices of floats, and faces of corners of 32 bits, all of them triangles. */
typedef struct ply_records {
    ply_layout in;
    size_t vertices, faces, face_bytes, count_bytes;
} ply_records;

static bool ply_records_of(const ply_header *h, uint64_t size, ply_records *r)
{
    ply_layout *const in = &r->in;
    if (!ply_layout_of(h, size, in) || in->number != PLY_FLOAT || (in->corner != PLY_INT32 && in->corner != PLY_UINT32))
        return false;
    r->count_bytes = ply_type_size(in->count);
    r->face_bytes = in->before + r->count_bytes + sizeof(uint32_t[3]) + in->after;
    r->vertices = (size_t)in->vertices;
    r->faces = (size_t)in->faces;
    return in->faces <= (size - in->faces_at) / r->face_bytes && in->faces <= SIZE_MAX / sizeof(float[9]);
}

/* The order of the bytes of this machine is that of `is_big`, or not; either is right. */
static inline uint32_t load(const unsigned char *from, bool is_big)
{
    return is_big ? (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 | from[3] : little_get32(from);
}

/* For free(). */
static unsigned char *read_block(FILE *stream, uint64_t at, size_t bytes)
{
    size_t got;
    unsigned char *const block = malloc(bytes);
    if (block && (!named_file_read_at(stream, at, block, bytes, &got) || got < bytes)) {
        free(block);
        return NULL;
    }
    return block;
}

/* Whether vertices stand in the file as they do in memory. */
static bool is_as_in_memory(const ply_records *r)
{
    const uint32_t one = 1;
    unsigned char bytes[sizeof one];
    memcpy(bytes, &one, sizeof one);
    return r->in.vertex == sizeof(float[3]) && r->in.axes[1] == 4 && r->in.axes[2] == 8 && load(bytes, r->in.is_big) == one;
}

/* Reads a block of vertices to where all positions are; or of faces, of which none may have other than three corners. */
static bool ply_records_vertices(const ply_records *r, FILE *stream, size_t first, size_t count, float *positions)
{
    const uint64_t at = r->in.vertices_at + first * r->in.vertex;
    const size_t bytes = count * r->in.vertex;
    size_t got;
    if (is_as_in_memory(r))
        return named_file_read_at(stream, at, positions + 3 * first, bytes, &got) && got == bytes;
    unsigned char *const block = read_block(stream, at, bytes);
    for (size_t i = 0; block && i < count; i++)
        for (size_t a = 0; a < 3; a++) {
            const uint32_t bits = load(block + i * r->in.vertex + r->in.axes[a], r->in.is_big);
            memcpy(positions + 3 * (first + i) + a, &bits, sizeof bits);
        }
    free(block);
    return block;
}

/* Returns whether all faces are triangles: their counts are 3 in the one byte, 0 in others. */
static inline bool take_corners(const unsigned char *list, size_t count, size_t face_bytes, size_t count_bytes, bool is_big,
                                uint32_t *corners)
{
    unsigned char other = 0;
    const size_t lowest = is_big ? count_bytes - 1 : 0;
    for (size_t i = 0; i < count; i++, list += face_bytes) {
        for (size_t b = 0; b < count_bytes; b++)
            other |= (unsigned char)(list[b] ^ (b == lowest ? 3 : 0));
        for (size_t v = 0; v < 3; v++)
            corners[3 * i + v] = load(list + count_bytes + 4 * v, is_big);
    }
    return !other;
}

static bool ply_records_faces(const ply_records *r, FILE *stream, size_t first, size_t count, uint32_t *corners)
{
    unsigned char *const block = read_block(stream, r->in.faces_at + first * r->face_bytes, count * r->face_bytes);
    const unsigned char *const lists = block ? block + r->in.before : NULL;
    bool is_taken = block;
    if (block && r->count_bytes == 1 && !r->in.is_big)
        is_taken = take_corners(lists, count, r->face_bytes, 1, false, corners);
    else if (block)
        is_taken = take_corners(lists, count, r->face_bytes, r->count_bytes, r->in.is_big, corners);
    free(block);
    return is_taken;
}

/* Vertices or faces: of a block, at least and at most, and so many that a thread takes less time to start than to read them. */
enum { BLOCK_LEAST = 512, BLOCK = 4096, BLOCKS_EACH = 8, STARTED = 1 << 16 };

typedef struct ply_binary {
    const plain_file *file;
    ply_records records;
    float *positions;
    mesh *m;
    size_t block; /* faces of one */
    mesh_look look;
} ply_binary;

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

static int take_vertices(void *data, void *place, size_t step)
{
    ply_binary *const p = data;
    const size_t first = step * BLOCK, count = least(BLOCK, p->records.vertices - first);
    (void)place;
    return !ply_records_vertices(&p->records, p->file->stream, first, count, p->positions);
}

static int take_faces(void *data, void *place, size_t step)
{
    ply_binary *const p = data;
    const size_t first = step * p->block, count = least(p->block, p->records.faces - first);
    uint32_t *const corners = malloc(count * sizeof(uint32_t[3]));
    const tribox_mesh block = {.positions = p->positions,
                               .vertices = p->records.vertices,
                               .indices = corners,
                               .index_bytes = sizeof *corners,
                               .count = count};
    (void)place;
    const bool is_taken = corners && ply_records_faces(&p->records, p->file->stream, first, count, corners) &&
                          mesh_look_put(&block, 0, count, first, p->m, &p->look);
    reading_tell((double)first / (double)p->records.faces);
    free(corners);
    return !is_taken;
}

static bool read_all(ply_binary *p)
{
    const size_t vertices = p->records.vertices, faces = p->records.faces, gaining = 1 + faces / STARTED;
    const unsigned threads = (unsigned)least(p->file->threads, gaining);
    const size_t block = faces / (BLOCKS_EACH * threads);
    p->block = block < BLOCK_LEAST ? BLOCK_LEAST : least(block, BLOCK);
    if (!mesh_take_room(faces, p->m))
        return false;
    reading_begin();
    const crew_work first = {.threads = threads, .count = (vertices + BLOCK - 1) / BLOCK, .step = take_vertices};
    const crew_work second = {.threads = threads, .count = (faces + p->block - 1) / p->block, .step = take_faces};
    const bool is_read = !crew_do(&first, p) && !crew_do(&second, p);
    reading_end();
    p->m->triangles = p->m->soup.count = faces;
    if (is_read)
        mesh_look_keep(&p->look, p->m);
    return is_read;
}

static bool plain_ply_binary(const plain_file *file, const ply_header *h, mesh *m)
{
    ply_binary p = {.file = file, .m = m, .look = mesh_look_none()};
    if (!ply_records_of(h, file->size, &p.records))
        return false;
    const size_t vertices = p.records.vertices, bytes = vertices * sizeof(float[3]);
    p.positions = vertices <= SIZE_MAX / sizeof(float[3]) ? pages_take(bytes) : NULL;
    const bool is_read = p.positions && read_all(&p);
    pages_free(p.positions, bytes);
    return is_read;
}

bool plain_ply(const plain_file *file, mesh *m)
{
    ply_header h;
    if (ply_header_read(NULL, &file->head, &h) != EXIT_CODE_OK || h.element_count < 2)
        return false;
    if (h.elements[0].kind != PLY_VERTICES || h.elements[1].kind != PLY_FACES || h.elements[0].count > UINT32_MAX)
        return false;
    for (int i = 2; i < h.element_count; i++)
        if (h.elements[i].count)
            return false;
    return h.format == PLY_ASCII ? plain_ply_text(file, &h, m) : plain_ply_binary(file, &h, m);
}
