/* plain_ply_binary.c - binary PLY files of triangles: threads take blocks of vertices in turn, then of faces. */
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/system.h"
#include "files/files.h"
#include "plain.h"

/* Vertices or faces: of a block, at least and at most, and so many that a thread takes less time to start than to read them. */
enum { BLOCK_LEAST = 512, BLOCK = 4096, BLOCKS_EACH = 8, STARTED = 1 << 16 };

/* Vertices of floats, and faces of corners of 32 bits, all of them triangles. */
typedef struct ply_binary {
    const plain_file *file;
    ply_layout in;
    size_t vertices, faces, face_bytes;
    float *positions;
    mesh *m;
    size_t block; /* faces of one */
} ply_binary;

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

static bool read_bytes(const ply_binary *p, uint64_t at, void *to, size_t bytes)
{
    size_t got;
    return to && named_file_read_at(p->file->stream, at, to, bytes, &got) && got == bytes;
}

/* Whether vertices stand in the file as they do in memory. */
static bool is_as_in_memory(const ply_layout *in)
{
    const uint32_t one = 1;
    return in->vertex == sizeof(float[3]) && in->axes[1] == 4 && in->axes[2] == 8 && ply_bits(&one, sizeof one, in->is_big) == one;
}

static int take_vertices(void *data, void *place, size_t step)
{
    const ply_binary *const p = data;
    const ply_layout *const in = &p->in;
    const size_t first = step * BLOCK, count = least(BLOCK, p->vertices - first), bytes = count * in->vertex;
    const uint64_t at = in->vertices_at + first * in->vertex;
    float *to = p->positions + 3 * first;
    (void)place;
    if (is_as_in_memory(in))
        return !read_bytes(p, at, to, bytes);
    unsigned char *const block = malloc(bytes);
    const bool is_read = read_bytes(p, at, block, bytes);
    for (size_t i = 0; is_read && i < count; i++)
        for (size_t a = 0; a < 3; a++, to++) {
            const uint32_t bits = (uint32_t)ply_bits(block + i * in->vertex + in->axes[a], sizeof bits, in->is_big);
            memcpy(to, &bits, sizeof bits);
        }
    free(block);
    return !is_read;
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
            corners[3 * i + v] = (uint32_t)ply_bits(list + count_bytes + 4 * v, sizeof *corners, is_big);
    }
    return !other;
}

static int take_faces(void *data, void *place, size_t step)
{
    ply_binary *const p = data;
    const ply_layout *const in = &p->in;
    const size_t first = step * p->block, count = least(p->block, p->faces - first), bytes = count * p->face_bytes;
    unsigned char *const faces = malloc(bytes);
    uint32_t *const corners = malloc(count * sizeof(uint32_t[3]));
    const tribox_mesh block = {
        .positions = p->positions, .vertices = p->vertices, .indices = corners, .index_bytes = sizeof *corners, .count = count};
    (void)place;
    bool is_taken = corners && read_bytes(p, in->faces_at + first * p->face_bytes, faces, bytes);
    if (is_taken && in->count_bytes == 1 && !in->is_big) /* the usual ones */
        is_taken = take_corners(faces + in->before, count, p->face_bytes, 1, false, corners);
    else if (is_taken)
        is_taken = take_corners(faces + in->before, count, p->face_bytes, in->count_bytes, in->is_big, corners);
    is_taken = is_taken && mesh_look_put(&block, 0, count, first, p->m);
    reading_tell((double)first / (double)p->faces);
    free(faces);
    free(corners);
    return !is_taken;
}

static bool read_all(ply_binary *p)
{
    const size_t gaining = 1 + p->faces / STARTED;
    const unsigned threads = (unsigned)least(p->file->threads, gaining);
    const size_t block = p->faces / (BLOCKS_EACH * threads);
    p->block = block < BLOCK_LEAST ? BLOCK_LEAST : least(block, BLOCK);
    const crew_work first = {.threads = threads, .count = (p->vertices + BLOCK - 1) / BLOCK, .step = take_vertices};
    const crew_work second = {.threads = threads, .count = (p->faces + p->block - 1) / p->block, .step = take_faces};
    if (mesh_make_room(NULL, p->faces, p->m))
        return false;
    mesh_look_begin(p->m);
    reading_begin();
    const bool is_read = !crew_do(&first, p) && !crew_do(&second, p);
    reading_end();
    p->m->triangles = p->m->soup.count = p->faces;
    if (is_read)
        mesh_look_end(p->m);
    return is_read;
}

static bool plain_ply_binary(const plain_file *file, const ply_header *h, mesh *m)
{
    ply_binary p = {.file = file, .m = m};
    const ply_layout *const in = &p.in;
    if (!ply_layout_of(h, file->size, &p.in) || in->number != PLY_FLOAT || (in->corner != PLY_INT32 && in->corner != PLY_UINT32))
        return false;
    p.face_bytes = in->before + in->count_bytes + sizeof(uint32_t[3]) + in->after;
    p.vertices = (size_t)in->vertices;
    p.faces = (size_t)in->faces;
    if (in->faces > (file->size - in->faces_at) / p.face_bytes || in->vertices > SIZE_MAX / sizeof(float[3]))
        return false;
    p.positions = pages_take(p.vertices * sizeof(float[3]));
    const bool is_read = p.positions && read_all(&p);
    pages_free(p.positions, p.vertices * sizeof(float[3]));
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
