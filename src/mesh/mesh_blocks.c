/* mesh_blocks.c - a mesh against a box, block by block: each once its indices have been checked. */
#include "mesh_blocks.h"

#include <string.h>

#include "base/bits.h"
#include "mesh_codes.h"
#include "mesh_input.h"
#include "pairs/pairs.h"

/* Triangles of a block at first, vertices that are copied, words of answers that are kept, and those that are no run. */
enum { BLOCK_LEAST = 256, COPIED = 1024, KEPT_WORDS = 16384, KEPT_MIXED = 384 };

/*
 * Answers from the first word on. Near in the mesh is near in space: most words are all zeros or all ones. Without branches, which
 * could not be foreseen.
 */
typedef struct kept_answers {
    uint64_t is_full[KEPT_WORDS / 64], is_mixed[KEPT_WORDS / 64];
    uint64_t mixed[KEPT_MIXED];
    size_t words, mixed_count;
} kept_answers;

/* False, and none are kept, if there is no room. */
static bool keep(kept_answers *kept, const uint64_t *word, size_t words)
{
    if (kept->words + words > KEPT_WORDS || kept->mixed_count + words > KEPT_MIXED)
        return false;
    for (size_t w = 0; w < words; w++, kept->words++) {
        const uint64_t bit = kept->words % 64, is_full = word[w] == ~UINT64_C(0), is_mixed = !is_full && word[w];
        uint64_t *const full = &kept->is_full[kept->words / 64], *const mixed = &kept->is_mixed[kept->words / 64];
        *full = (bit ? *full : 0) | is_full << bit;
        *mixed = (bit ? *mixed : 0) | is_mixed << bit;
        kept->mixed[kept->mixed_count] = word[w]; /* there is room for all of them */
        kept->mixed_count += (size_t)is_mixed;
    }
    return true;
}

static void write_kept(const kept_answers *kept, uint64_t *mask)
{
    for (size_t w = 0, m = 0; w < kept->words; w++) {
        const uint64_t is_full = kept->is_full[w / 64] >> w % 64 & 1, is_mixed = kept->is_mixed[w / 64] >> w % 64 & 1;
        mask[w] = (0 - is_full) | ((0 - is_mixed) & kept->mixed[m < KEPT_MIXED ? m : 0]);
        m += (size_t)is_mixed;
    }
}

/* A word of which all triangles are apart from the box, or what `answer` answers. Returns how many, 0 if one names no vertex. */
static size_t answer_some(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t *block, uint64_t *mask,
                          tribox_report *counts)
{
    size_t count = mesh->count - first;
    if (q->pattern && !q->codes) {
        const size_t word = count < 64 ? count : 64;
        const tribox_vertices found = q->plan->kernel->find_vertices(mesh, first, word);
        if (found.greatest >= mesh->vertices)
            return 0;
        if (q->plan->kernel->is_apart(mesh, q->pattern, found)) {
            tribox_pairs_write_none(word, mask);
            *block = BLOCK_LEAST;
            return word;
        }
    }
    /* Near in the mesh is near in space: the next words, up to a block, are likely not apart from the box either. */
    tribox_answer_block *const answer = q->codes ? tribox_mesh_answer_coded : q->answer;
    count = answer(q, mesh, first, count < *block ? count : *block, mask, counts);
    *block = 2 * count < TRIBOX_MESH_BLOCK ? 2 * count : TRIBOX_MESH_BLOCK;
    return count;
}

/*
 * Answers block by block. False if a triangle names no vertex. Then nothing is written if there is something to keep answers in: if
 * it is full, the rest is checked first.
 */
static bool answer_blocks(const tribox_mesh_query *q, const tribox_mesh *mesh, uint64_t *mask, kept_answers *kept,
                          tribox_report *counts)
{
    uint64_t some[TRIBOX_MESH_BLOCK / 64];
    size_t block = BLOCK_LEAST;
    for (size_t first = 0, count; first < mesh->count; first += count) {
        count = answer_some(q, mesh, first, &block, kept ? some : mask ? mask + first / 64 : NULL, counts);
        if (!count)
            return false;
        if (!kept || keep(kept, some, tribox_words_of(count)))
            continue;
        if (!tribox_mesh_is_in_range(mesh, q->plan->kernel, first + count, mesh->count - first - count))
            return false;
        write_kept(kept, mask);
        memcpy(mask + first / 64, some, tribox_words_of(count) * sizeof *mask);
        kept = NULL;
    }
    if (kept)
        write_kept(kept, mask);
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
    same.axes = TRIBOX_AXES_AS_STORED;
    return same;
}

/* A mesh of few vertices, all of which are there. */
TRIBOX_NOINLINE bool answer_small(const tribox_mesh_query *query, const tribox_mesh *mesh, uint64_t *mask, tribox_report *counts)
{
    small_copy copy;
    const tribox_mesh same = copied(mesh, query->in_double, &copy);
    return answer_blocks(query, &same, mask, NULL, counts);
}

/* To check all indices first would read them twice. */
TRIBOX_NOINLINE bool answer_unchecked(const tribox_mesh_query *query, const tribox_mesh *mesh, uint64_t *mask,
                                      tribox_report *counts)
{
    kept_answers kept;
    kept.words = kept.mixed_count = 0;
    return answer_blocks(query, mesh, mask, &kept, counts);
}

/* The few vertices of a small mesh are copied. */
bool tribox_mesh_answer(const tribox_mesh_query *query, const tribox_mesh *mesh, uint64_t *mask, tribox_report *counts)
{
    const bool is_small = mesh->indices && !query->codes && mesh->vertices <= COPIED && mesh->vertices <= 3 * mesh->count;
    const bool is_checked_first = !mesh->indices || query->is_empty || is_small;
    if (is_checked_first && !tribox_mesh_is_in_range(mesh, query->plan->kernel, 0, mesh->count))
        return false;
    if (query->is_empty) {
        tribox_pairs_write_none(mesh->count, mask);
        return true;
    }
    if (is_small)
        return answer_small(query, mesh, mask, counts);
    return mask && !is_checked_first ? answer_unchecked(query, mesh, mask, counts) : answer_blocks(query, mesh, mask, NULL, counts);
}
