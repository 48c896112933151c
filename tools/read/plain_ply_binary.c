/* plain_ply_binary.c - vertices of floats, and faces that are all triangles, so that each stands where it is known before. */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/pages.h"
#include "files/named_file.h"
#include "little.h"
#include "mesh_look.h"
#include "plain_ply.h"
#include "turns.h"

/* Vertices or faces: of a block, and for each of which a thread takes less time to start than to read them. */
enum { BLOCK = 4096, STARTED = 1 << 16 };

typedef struct ply_binary {
    const plain_file *file;
    bool is_big;
    uint64_t vertices_at, faces_at; /* in the file */
    size_t vertices, vertex_bytes, axis_at[3];
    size_t faces, face_bytes, count_at, count_bytes;
    float *positions;
    mesh *m;
    pthread_mutex_t lock; /* of what follows */
    mesh_look look;
} ply_binary;

/* The order of the bytes of this machine is that of `is_big`, or not; either is right. */
static inline uint32_t load(const unsigned char *from, bool is_big)
{
    return is_big ? (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 | from[3] : little_get32(from);
}

static bool lay_out_vertex(const ply_element *e, ply_binary *p)
{
    for (int i = 0; i < e->property_count; i++) {
        const ply_property *const property = &e->properties[i];
        if (property->count || (property->role <= PLY_Z && property->type != PLY_FLOAT))
            return false;
        if (property->role <= PLY_Z)
            p->axis_at[property->role] = p->vertex_bytes;
        p->vertex_bytes += ply_type_size(property->type);
    }
    return true;
}

static bool lay_out_face(const ply_element *e, ply_binary *p)
{
    for (int i = 0; i < e->property_count; i++) {
        const ply_property *const property = &e->properties[i];
        const bool is_corners = property->role == PLY_CORNERS;
        if (is_corners ? property->type != PLY_INT32 && property->type != PLY_UINT32 : property->count)
            return false;
        if (is_corners) {
            p->count_at = p->face_bytes;
            p->count_bytes = ply_type_size(property->count);
        }
        p->face_bytes += is_corners ? p->count_bytes + sizeof(uint32_t[3]) : ply_type_size(property->type);
    }
    return true;
}

/* Whether the file has the bytes that the header promises. */
static bool lay_out(const ply_header *h, ply_binary *p)
{
    const ply_element *const vertices = &h->elements[0], *const faces = &h->elements[1];
    if (!vertices->count || !faces->count || !lay_out_vertex(vertices, p) || !lay_out_face(faces, p))
        return false;
    p->vertices_at = h->size;
    const uint64_t left = p->file->size - h->size;
    if (vertices->count > left / p->vertex_bytes)
        return false;
    p->faces_at = h->size + vertices->count * p->vertex_bytes;
    if (faces->count > (p->file->size - p->faces_at) / p->face_bytes || faces->count > SIZE_MAX / sizeof(float[9]))
        return false;
    p->vertices = (size_t)vertices->count;
    p->faces = (size_t)faces->count;
    return true;
}

/* A block of records, for free(). */
static unsigned char *read_records(const ply_binary *p, uint64_t at, size_t bytes)
{
    size_t got;
    unsigned char *const records = malloc(bytes);
    if (records && (!named_file_read_at(p->file->stream, at, records, bytes, &got) || got < bytes)) {
        free(records);
        return NULL;
    }
    return records;
}

static bool take_vertices(void *data, unsigned thread, size_t turn)
{
    const ply_binary *const p = data;
    const size_t first = turn * BLOCK, left = p->vertices - first, count = left < BLOCK ? left : BLOCK;
    unsigned char *const records = read_records(p, p->vertices_at + first * p->vertex_bytes, count * p->vertex_bytes);
    (void)thread;
    for (size_t i = 0; records && i < count; i++)
        for (size_t a = 0; a < 3; a++) {
            const uint32_t bits = load(records + i * p->vertex_bytes + p->axis_at[a], p->is_big);
            memcpy(p->positions + 3 * (first + i) + a, &bits, sizeof bits);
        }
    free(records);
    return records;
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

static bool take_all_corners(const ply_binary *p, const unsigned char *records, size_t count, uint32_t *corners)
{
    if (p->count_bytes == 1 && !p->is_big)
        return take_corners(records + p->count_at, count, p->face_bytes, 1, false, corners);
    return take_corners(records + p->count_at, count, p->face_bytes, p->count_bytes, p->is_big, corners);
}

static bool fill_faces(ply_binary *p, size_t first, size_t count, const uint32_t *corners)
{
    const tribox_mesh all = {
        .positions = p->positions, .vertices = p->vertices, .indices = corners, .index_bytes = sizeof *corners, .count = count};
    float *to[9];
    mesh_streams(p->m, first, to);
    if (tribox_mesh_to_soup(&all, NULL, 0, count, NULL, to, to + 3, to + 6))
        return false;
    mesh_look own = mesh_look_none();
    mesh_look_at(p->m, first, count, &own);
    pthread_mutex_lock(&p->lock);
    mesh_look_join(&own, &p->look);
    pthread_mutex_unlock(&p->lock);
    return true;
}

static bool take_faces(void *data, unsigned thread, size_t turn)
{
    ply_binary *const p = data;
    const size_t first = turn * BLOCK, left = p->faces - first, count = left < BLOCK ? left : BLOCK;
    unsigned char *const records = read_records(p, p->faces_at + first * p->face_bytes, count * p->face_bytes);
    uint32_t *const corners = malloc(count * sizeof(uint32_t[3]));
    (void)thread;
    const bool is_taken =
        records && corners && take_all_corners(p, records, count, corners) && fill_faces(p, first, count, corners);
    free(records);
    free(corners);
    return is_taken;
}

static bool read_blocks_of(ply_binary *p, size_t count, bool (*work)(void *data, unsigned thread, size_t turn))
{
    const size_t gaining = 1 + count / STARTED;
    return turns_run(p->file->threads < gaining ? p->file->threads : (unsigned)gaining, (count + BLOCK - 1) / BLOCK, work, p);
}

static bool read_all(ply_binary *p)
{
    if (!read_blocks_of(p, p->vertices, take_vertices))
        return false;
    p->m->triangles = p->m->soup.count = p->faces;
    if (!read_blocks_of(p, p->faces, take_faces))
        return false;
    mesh_look_keep(&p->look, p->m);
    return true;
}

bool plain_ply_binary(const plain_file *file, const ply_header *h, mesh *m)
{
    ply_binary p = {.file = file, .is_big = h->format == PLY_BIG_ENDIAN, .m = m, .look = mesh_look_none()};
    if (!lay_out(h, &p))
        return false;
    const size_t bytes = p.vertices * sizeof(float[3]);
    p.positions = p.vertices <= SIZE_MAX / sizeof(float[3]) ? pages_take(bytes) : NULL;
    pthread_mutex_init(&p.lock, NULL);
    const bool is_read = p.positions && mesh_take_room(p.faces, m) && read_all(&p);
    pthread_mutex_destroy(&p.lock);
    pages_free(p.positions, bytes);
    return is_read;
}
