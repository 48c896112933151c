/*
 * mesh_words.h - would an index over a mesh pay that has no streams? Words of 64 triangles that a box asks, once from nine streams
 * and once from the mesh, by calls about 64 triangles each: the rest of a question is the same for both.
 */
#ifndef BENCH_MESH_WORDS_H
#define BENCH_MESH_WORDS_H

#include "node_bounds.h"
#include "ordered_soup.h"
#include "timing/contestant.h"

typedef struct mesh_words {
    const tribox_soup *soup;
    tribox_mesh mesh; /* the same triangles in the same order, with vertices as the file numbers them */
    float *positions;
    uint32_t *indices;
    uint32_t *asked; /* words, box after box; those of box b begin at start[b] */
    size_t *start;
    const tribox_box *boxes;
    size_t count; /* boxes */
} mesh_words;

/* file: the soup in the order of the file. False, with a message, if memory fails. */
bool mesh_words_make(const tribox_soup *file, const ordered_soup *soup, const node_bounds *bounds, const tribox_box *boxes,
                     size_t count, mesh_words *made);

void mesh_words_free(mesh_words *made);

/* Times are a word's. Without streams the triangles are gathered by tribox_mesh_overlap. */
contestant mesh_words_contestant(const mesh_words *question, bool has_streams, const char *kernel);

#endif
