/* mesh_words.h - words of a mesh from anywhere, answered with as few calls as can be. */
#ifndef TRIBOX_MESH_WORDS_H
#define TRIBOX_MESH_WORDS_H

#include "mesh/mesh_blocks.h"

/* How many of `count` words follow one another, and are not full. */
static inline unsigned tribox_run_of_words(const size_t *word, const size_t *full, unsigned count)
{
    unsigned n = 0;
    while (n < count && !full[n] && word[n] == word[0] + n)
        n++;
    return n;
}

/*
 * Answers `count` words with rising numbers; skips those with full[i] != 0. A triangle without vertices, as the mesh has changed
 * since it was indexed, overlaps nothing. Returns how many triangles were undecided.
 */
size_t tribox_mesh_words_answer(const tribox_mesh_query *query, const tribox_mesh *mesh, const size_t *word, const size_t *full,
                                unsigned count, uint64_t *hit);

#endif
