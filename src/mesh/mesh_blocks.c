/* mesh_blocks.c - a mesh against a box, block by block: each once its indices have been checked. */
#include "mesh_blocks.h"

#include <string.h>

#include "base/bits.h"
#include "mesh_input.h"
#include "pairs/pairs.h"

/* Triangles of a block at first, words of answers that are kept, of 131072 triangles, and vertices that are copied. */
enum { BLOCK_LEAST = 256, KEPT_WORDS = 2048, COPIED = 1024 };

/* Answers block by block. False if a triangle names no vertex. */
static bool answer_blocks(const tribox_mesh_query *q, const tribox_mesh *mesh, uint64_t *mask, tribox_report *counts)
{
    size_t block = BLOCK_LEAST;
    for (size_t first = 0, count; first < mesh->count; first += count) {
        const size_t left = mesh->count - first;
        uint64_t *const to = mask ? mask + first / 64 : NULL;
        if (q->pattern) {
            count = left < 64 ? left : 64;
            const tribox_vertices found = q->plan->kernel->find_vertices(mesh, first, count);
            if (found.greatest >= mesh->vertices)
                return false;
            if (q->plan->kernel->is_apart(mesh, q->pattern, found)) {
                tribox_pairs_write_none(count, to);
                block = BLOCK_LEAST;
                continue;
            }
        }
        /* Near in the mesh is near in space: the next words, up to a block, are likely not apart from the box either. */
        count = q->answer(q, mesh, first, left < block ? left : block, to, counts);
        if (!count)
            return false;
        block = 2 * count < TRIBOX_MESH_BLOCK ? 2 * count : TRIBOX_MESH_BLOCK;
    }
    return true;
}

/* The vertices of a small mesh, and one more. */
typedef union small_copy {
    float single[COPIED + 1][3];
    double wide[COPIED + 1][3];
} small_copy;

/* The same mesh with a vertex after its last one, which can then be read like the others. */
static tribox_mesh copied(const tribox_mesh *mesh, bool in_double, small_copy *copy)
{
    const size_t bytes = in_double ? sizeof copy->wide[0] : sizeof copy->single[0];
    for (size_t v = 0; v < mesh->vertices; v++) {
        if (in_double)
            tribox_position_read(mesh, v, copy->wide[v]);
        else
            memcpy(copy->single[v], (const char *)mesh->positions + v * mesh->stride, bytes);
    }
    memset((char *)copy + mesh->vertices * bytes, 0, bytes);
    tribox_mesh same = *mesh;
    same.positions = copy;
    same.stride = bytes;
    same.vertices++;
    same.position_bytes = in_double ? sizeof(double) : sizeof(float);
    same.axis_stride = same.position_bytes;
    return same;
}

/*
 * To check all indices first would read them twice, so the answers of a mesh that is not too large are kept until all are there;
 * the few vertices of a small one are copied.
 */
bool tribox_mesh_answer(const tribox_mesh_query *query, const tribox_mesh *mesh, uint64_t *mask, tribox_report *counts)
{
    const size_t words = tribox_words_of(mesh->count);
    const bool is_small = mesh->indices && mesh->vertices <= COPIED && mesh->vertices <= 3 * mesh->count;
    const bool is_checked_first = !mesh->indices || query->is_empty || is_small || (mask && words > KEPT_WORDS);
    if (is_checked_first && !tribox_mesh_is_in_range(mesh, query->plan->kernel, 0, mesh->count))
        return false;
    if (query->is_empty) {
        tribox_pairs_write_none(mesh->count, mask);
        return true;
    }
    if (is_small) {
        small_copy copy;
        const tribox_mesh same = copied(mesh, query->in_double, &copy);
        return answer_blocks(query, &same, mask, counts);
    }
    if (is_checked_first || !mask)
        return answer_blocks(query, mesh, mask, counts);
    uint64_t kept[KEPT_WORDS];
    if (!answer_blocks(query, mesh, kept, counts))
        return false;
    memcpy(mask, kept, words * sizeof *mask);
    return true;
}
