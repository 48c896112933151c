/* mesh_words.c - words of a mesh: the corners of many are found before the first is read, and comes into the cache meanwhile. */
#include "mesh_words.h"

#include <string.h>

#include "base/bits.h"

enum { WORDS = TRIBOX_MESH_BLOCK / 64 };

/* Words whose corners were found, in ascending order. */
typedef struct finding {
    const tribox_mesh_query *query;
    const tribox_mesh *mesh;
    tribox_corners corners;
    uint32_t offset[3 * TRIBOX_MESH_BLOCK];
    size_t first[WORDS]; /* triangle of each */
    uint64_t *to[WORDS]; /* where its answer goes */
    size_t words, count; /* triangles */
    size_t undecided;
} finding;

/* Triangles of a mesh that has changed since it was indexed, as one names a vertex that is not there: one by one. */
static void answer_changed(finding *f, size_t first, size_t count, uint64_t *hit, tribox_report *counts)
{
    memset(hit, 0, tribox_words_of(count) * sizeof *hit);
    for (size_t i = 0; i < count; i++) {
        uint64_t bit;
        if (f->query->answer(f->query, f->mesh, first + i, 1, &bit, counts))
            hit[i / 64] |= bit << i % 64;
    }
}

/* Triangles that follow one another. */
static void answer_run(finding *f, size_t first, size_t count, uint64_t *hit)
{
    tribox_report counts = {0, 0};
    for (size_t at = 0, done; at < count; at += done) {
        const size_t most = count - at < TRIBOX_MESH_BLOCK ? count - at : TRIBOX_MESH_BLOCK;
        done = f->query->answer(f->query, f->mesh, first + at, most, hit + at / 64, &counts);
        if (!done)
            answer_changed(f, first + at, most, hit + at / 64, &counts);
        done = done ? done : most;
    }
    f->undecided += counts.undecided;
}

static void answer_found(finding *f)
{
    uint64_t hit[WORDS];
    if (f->count >= f->query->plan->kernel->lanes)
        f->undecided += f->query->answer_corners(f->query, f->mesh, &f->corners, f->first, f->count, hit);
    else if (f->count)
        answer_run(f, f->first[0], f->count, hit);
    for (size_t w = 0; w < f->words; w++)
        *f->to[w] = hit[w];
    f->words = f->count = 0;
}

/* Finds the corners of triangles that follow one another, where all can be read from where they lie. */
static bool find_run(finding *f, size_t first, size_t count, uint64_t *hit)
{
    tribox_corners corners;
    uint32_t *const offset = f->offset + 3 * f->count;
    f->query->plan->kernel->find_corners(f->mesh, first, count, offset, &corners);
    if (!corners.base || !corners.has_all)
        return false;
    for (size_t i = 0; i < count; i++) /* its other corners are mostly those of triangles beside it */
        tribox_will_read(corners.base + offset[3 * i]);
    for (size_t at = 0; at < count; at += 64) {
        f->first[f->words] = first + at;
        f->to[f->words++] = hit + at / 64;
    }
    corners.offset = f->offset;
    f->corners = corners;
    f->count += count;
    return true;
}

/* Without vertex numbers nine numbers follow one another: there is nothing to find, or no two words can be walked as one. */
static bool has_offsets(const tribox_mesh_query *query, const tribox_mesh *mesh) { return mesh->indices && query->answer_corners; }

size_t tribox_mesh_words_answer(const tribox_mesh_query *query, const tribox_mesh *mesh, const size_t *word, const size_t *full,
                                unsigned count, uint64_t *hit)
{
    finding f;
    const bool are_found = has_offsets(query, mesh);
    f.query = query;
    f.mesh = mesh;
    f.words = f.count = f.undecided = 0;
    for (unsigned k = 0, n; k < count; k += n ? n : 1) {
        const unsigned room = are_found ? WORDS - (unsigned)f.words : count;
        n = tribox_run_of_words(word + k, full + k, count - k < room ? count - k : room);
        const size_t first = 64 * word[k], left = mesh->count - first, triangles = left < 64 * (size_t)n ? left : 64 * (size_t)n;
        if (n && !(are_found && find_run(&f, first, triangles, hit + k)))
            answer_run(&f, first, triangles, hit + k);
        if (f.words == WORDS)
            answer_found(&f);
    }
    answer_found(&f);
    return f.undecided;
}
