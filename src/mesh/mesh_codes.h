/*
 * mesh_codes.h - a mesh with indices against a box: each vertex compared once, and triangles told by what their vertices share.
 */
#ifndef TRIBOX_MESH_CODES_H
#define TRIBOX_MESH_CODES_H

#include "mesh_blocks.h"

/* As many vertices have codes at a time; their numbers are near each other in most meshes. */
enum { TRIBOX_CODES = 1 << 16 };

/* The codes, on the stack of a call. What it costs to code vertices is bounded by `credit`. */
typedef struct tribox_codes {
    uint8_t code[TRIBOX_CODES]; /* that of vertex v at v modulo TRIBOX_CODES */
    tribox_coded_box box;
    size_t first, end;     /* the vertices that have one */
    size_t credit, earned; /* how many more may be coded, and by how many it grows with each triangle answered */
    size_t untold;         /* triangles that are answered next without codes, as most of those before were left open */
    size_t answered;       /* the first triangle of the last block, and its words: inside, and not known to be inside or not */
    uint64_t inside[TRIBOX_MESH_BLOCK / 64], unknown[TRIBOX_MESH_BLOCK / 64];
} tribox_codes;

/* Whether vertices of this mesh, its strides set, can be coded, and are worth it. */
bool tribox_codes_help(const tribox_mesh *mesh);

/* No codes yet. is_all_asked: else the first triangles may do, and few vertices are coded for them. */
void tribox_codes_start(tribox_codes *codes, const tribox_mesh *mesh, const tribox_box *box, bool is_all_asked);

/* A tribox_answer_block by the codes of the query, and all that `answer` of the query answers. */
size_t tribox_mesh_answer_coded(const tribox_mesh_query *query, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                                tribox_report *counts);

#endif
