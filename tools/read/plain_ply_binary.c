/*
 * plain_ply_binary.c - binary PLY files of triangles: threads take blocks of vertices in turn, then of faces, to be stored or
 * handed over.
 */
#include <pthread.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/pages.h"
#include "console/steps.h"
#include "mesh_look.h"
#include "plain_ply.h"
#include "ply_records.h"
#include "reading.h"
#include "vertex_extremes.h"

/*
 * Vertices or faces: of a block, at least and at most, and for each of which a thread takes less time to start than to read them,
 * or to read them and hand them over.
 */
enum { BLOCK_LEAST = 512, BLOCK = 4096, BLOCKS_EACH = 8, STARTED = 1 << 16, STARTED_TAKEN = 1 << 14 };

typedef struct ply_binary {
    const plain_file *file;
    const mesh_taker *taker; /* NULL: triangles are stored */
    ply_records records;
    float *positions;
    mesh *m;
    unsigned threads;
    size_t block; /* faces of one */
    steps vertices, asking, faces;
    uint32_t extreme[EXTREMES];
    pthread_mutex_t lock; /* of what follows */
    vertex_extremes extremes;
    unsigned met; /* of the extremes, by triangles that were taken */
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
static void run_steps(ply_binary *p, steps *s, unsigned thread, bool (*work)(ply_binary *p, unsigned thread, size_t step))
{
    for (size_t n; steps_take(s, &n); steps_done(s))
        if (goes_on(p) && !work(p, thread, n))
            fail(p);
    steps_wait(s);
}

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

static bool take_vertices(ply_binary *p, unsigned thread, size_t step)
{
    const size_t first = step * BLOCK, count = least(BLOCK, p->records.vertices - first);
    vertex_extremes own = vertex_extremes_none();
    (void)thread;
    if (!ply_records_vertices(&p->records, p->file->stream, first, count, p->positions))
        return false;
    if (!p->taker)
        return true;
    vertex_extremes_look(p->positions, first, count, &own);
    pthread_mutex_lock(&p->lock);
    vertex_extremes_join(&own, &p->extremes);
    pthread_mutex_unlock(&p->lock);
    return true;
}

/* The taker has a bar of its own. */
static bool begin_to_store(ply_binary *p)
{
    reading_begin();
    return mesh_take_room(p->records.faces, p->m);
}

/* The box is that of the vertices, and of the triangles only if these have such as reach its sides, which is seen at the end. */
static bool ask_taker(ply_binary *p, unsigned thread, size_t step)
{
    mesh *const m = p->m;
    (void)thread, (void)step;
    m->is_taken =
        p->taker && vertex_extremes_box(&p->extremes, &m->bounds) && p->taker->begin(p->taker->data, &m->bounds, p->records.faces);
    if (m->is_taken)
        vertex_extremes_find(&p->extremes, p->positions, BLOCK, p->extreme);
    return m->is_taken || begin_to_store(p);
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

static unsigned join_met(ply_binary *p, unsigned met)
{
    pthread_mutex_lock(&p->lock);
    met = p->met |= met;
    pthread_mutex_unlock(&p->lock);
    return met;
}

static bool hand_over(ply_binary *p, unsigned thread, const tribox_mesh *block)
{
    const unsigned before = join_met(p, 0), met = vertex_extremes_meet(p->extreme, block->indices, 3 * block->count, before);
    if (met != before)
        join_met(p, met);
    return p->taker->take(p->taker->data, thread, block);
}

static bool take_faces(ply_binary *p, unsigned thread, size_t step)
{
    const size_t first = step * p->block, count = least(p->block, p->records.faces - first);
    uint32_t *const corners = malloc(count * sizeof(uint32_t[3]));
    const tribox_mesh block = {.positions = p->positions,
                               .vertices = p->records.vertices,
                               .indices = corners,
                               .index_bytes = sizeof *corners,
                               .count = count};
    const bool is_taken = corners && ply_records_faces(&p->records, p->file->stream, first, count, corners) &&
                          (p->m->is_taken ? hand_over(p, thread, &block) : store(p, &block, first));
    free(corners);
    return is_taken;
}

static void read_in_crew(void *data, unsigned thread)
{
    ply_binary *const p = data;
    run_steps(p, &p->vertices, thread, take_vertices);
    run_steps(p, &p->asking, thread, ask_taker);
    run_steps(p, &p->faces, thread, take_faces);
}

/* Reads what has not been read. */
static bool read_by_threads(ply_binary *p)
{
    p->is_failed = false;
    steps_start(&p->faces, (p->records.faces + p->block - 1) / p->block);
    crew_run(p->threads, read_in_crew, p);
    steps_free(&p->faces);
    return !p->is_failed;
}

/* Faces that were handed over for nothing are read again. */
static bool read_all(ply_binary *p)
{
    mesh *const m = p->m;
    bool is_read = read_by_threads(p);
    if (m->is_taken && !(is_read && p->met == (1U << EXTREMES) - 1)) {
        p->taker->drop(p->taker->data);
        m->is_taken = false;
        is_read = begin_to_store(p) && read_by_threads(p);
    }
    if (!m->is_taken)
        reading_end();
    m->triangles = p->records.faces;
    m->first_not_finite = m->triangles;
    if (is_read && !m->is_taken) {
        m->soup.count = m->triangles;
        mesh_look_keep(&p->look, m);
    }
    return is_read;
}

static void share_out(ply_binary *p)
{
    const size_t faces = p->records.faces, gaining = 1 + faces / (p->taker ? STARTED_TAKEN : STARTED);
    p->threads = (unsigned)least(p->file->threads, gaining);
    const size_t block = faces / (BLOCKS_EACH * p->threads);
    p->block = block < BLOCK_LEAST ? BLOCK_LEAST : least(block, BLOCK);
}

bool plain_ply_binary(const plain_file *file, const ply_header *h, mesh *m)
{
    ply_binary p = {.file = file, .taker = file->taker, .m = m, .extremes = vertex_extremes_none(), .look = mesh_look_none()};
    if (!ply_records_of(h, file->size, &p.records))
        return false;
    const size_t vertices = p.records.vertices, bytes = vertices * sizeof(float[3]);
    p.positions = vertices <= SIZE_MAX / sizeof(float[3]) ? pages_take(bytes) : NULL;
    if (!p.positions)
        return false;
    share_out(&p);
    pthread_mutex_init(&p.lock, NULL);
    steps_start(&p.vertices, (vertices + BLOCK - 1) / BLOCK);
    steps_start(&p.asking, 1);
    const bool is_read = read_all(&p);
    steps_free(&p.asking);
    steps_free(&p.vertices);
    pthread_mutex_destroy(&p.lock);
    pages_free(p.positions, bytes);
    return is_read;
}
