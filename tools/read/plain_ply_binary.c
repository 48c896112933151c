/* plain_ply_binary.c - binary PLY files of triangles: threads take blocks of vertices in turn, then of faces. */
#include <pthread.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/pages.h"
#include "console/steps.h"
#include "mesh_look.h"
#include "plain_ply.h"
#include "ply_records.h"
#include "reading.h"

/* Vertices or faces: of a block, at least and at most, and so many that a thread takes less time to start than to read them. */
enum { BLOCK_LEAST = 512, BLOCK = 4096, BLOCKS_EACH = 8, STARTED = 1 << 16 };

typedef struct ply_binary {
    const plain_file *file;
    ply_records records;
    float *positions;
    mesh *m;
    unsigned threads;
    size_t block; /* faces of one */
    steps vertices, faces;
    pthread_mutex_t lock; /* of what follows */
    mesh_look look;
    bool is_failed;
} ply_binary;

static bool goes_on(ply_binary *p)
{
    pthread_mutex_lock(&p->lock);
    const bool is_failed = p->is_failed;
    pthread_mutex_unlock(&p->lock);
    return !is_failed;
}

static void fail(ply_binary *p)
{
    pthread_mutex_lock(&p->lock);
    p->is_failed = true;
    pthread_mutex_unlock(&p->lock);
}

/* Returns when all threads are here. */
static void run_steps(ply_binary *p, steps *s, bool (*work)(ply_binary *p, size_t step))
{
    for (size_t n; steps_take(s, &n); steps_done(s))
        if (goes_on(p) && !work(p, n))
            fail(p);
    steps_wait(s);
}

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

static bool take_vertices(ply_binary *p, size_t step)
{
    const size_t first = step * BLOCK, count = least(BLOCK, p->records.vertices - first);
    return ply_records_vertices(&p->records, p->file->stream, first, count, p->positions);
}

static bool store(ply_binary *p, const tribox_mesh *block, size_t first)
{
    float *to[9];
    mesh_look own = mesh_look_none();
    mesh_streams(p->m, first, to);
    if (tribox_mesh_to_soup(block, NULL, 0, block->count, NULL, to, to + 3, to + 6))
        return false;
    mesh_look_at(p->m, first, block->count, &own);
    pthread_mutex_lock(&p->lock);
    mesh_look_join(&own, &p->look);
    pthread_mutex_unlock(&p->lock);
    reading_tell((double)first / (double)p->records.faces);
    return true;
}

static bool take_faces(ply_binary *p, size_t step)
{
    const size_t first = step * p->block, count = least(p->block, p->records.faces - first);
    uint32_t *const corners = malloc(count * sizeof(uint32_t[3]));
    const tribox_mesh block = {.positions = p->positions,
                               .vertices = p->records.vertices,
                               .indices = corners,
                               .index_bytes = sizeof *corners,
                               .count = count};
    const bool is_taken =
        corners && ply_records_faces(&p->records, p->file->stream, first, count, corners) && store(p, &block, first);
    free(corners);
    return is_taken;
}

static void read_in_crew(void *data, unsigned thread)
{
    ply_binary *const p = data;
    (void)thread;
    run_steps(p, &p->vertices, take_vertices);
    run_steps(p, &p->faces, take_faces);
}

static bool read_all(ply_binary *p)
{
    mesh *const m = p->m;
    if (!mesh_take_room(p->records.faces, m))
        return false;
    reading_begin();
    crew_run(p->threads, read_in_crew, p);
    reading_end();
    m->triangles = m->soup.count = p->records.faces;
    m->first_not_finite = m->triangles;
    if (!p->is_failed)
        mesh_look_keep(&p->look, m);
    return !p->is_failed;
}

static void share_out(ply_binary *p)
{
    const size_t faces = p->records.faces, gaining = 1 + faces / STARTED;
    p->threads = (unsigned)least(p->file->threads, gaining);
    const size_t block = faces / (BLOCKS_EACH * p->threads);
    p->block = block < BLOCK_LEAST ? BLOCK_LEAST : least(block, BLOCK);
}

bool plain_ply_binary(const plain_file *file, const ply_header *h, mesh *m)
{
    ply_binary p = {.file = file, .m = m, .look = mesh_look_none()};
    if (!ply_records_of(h, file->size, &p.records))
        return false;
    const size_t vertices = p.records.vertices, bytes = vertices * sizeof(float[3]);
    p.positions = vertices <= SIZE_MAX / sizeof(float[3]) ? pages_take(bytes) : NULL;
    if (!p.positions)
        return false;
    share_out(&p);
    pthread_mutex_init(&p.lock, NULL);
    steps_start(&p.vertices, (vertices + BLOCK - 1) / BLOCK);
    steps_start(&p.faces, (p.records.faces + p.block - 1) / p.block);
    const bool is_read = read_all(&p);
    steps_free(&p.faces);
    steps_free(&p.vertices);
    pthread_mutex_destroy(&p.lock);
    pages_free(p.positions, bytes);
    return is_read;
}
