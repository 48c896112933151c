/*
 * mesh_blocks.h - a mesh against a box, block by block: words apart from the box are left out, and nothing is written where a
 * vertex is missing.
 */
#ifndef TRIBOX_MESH_BLOCKS_H
#define TRIBOX_MESH_BLOCKS_H

#include "plan.h"

/* Triangles of a block at most, and those whose streams fit the first-level cache. */
enum { TRIBOX_MESH_BLOCK = 768, TRIBOX_MESH_STREAMED = 256 };

typedef struct tribox_mesh_query tribox_mesh_query;

/*
 * Answers some of the triangles first .. first + count - 1, at most TRIBOX_MESH_BLOCK: the first of them, in whole words unless
 * all. Adds to the counts; mask may be NULL. Returns how many, 0 if a triangle names no vertex.
 */
typedef size_t tribox_answer_block(const tribox_mesh_query *query, const tribox_mesh *mesh, size_t first, size_t count,
                                   uint64_t *mask, tribox_report *counts);

/*
 * Answers words from anywhere, whose corners follow one another and can all be read: word w has the triangles from first[w] on, 64
 * of them but for the last word; `count` in all, a packet at least and TRIBOX_MESH_BLOCK at most. Returns how many were undecided.
 */
typedef size_t tribox_answer_corners(const tribox_mesh_query *query, const tribox_mesh *mesh, const tribox_corners *corners,
                                     const size_t *first, size_t count, uint64_t *hit);

struct tribox_mesh_query {
    tribox_answer_block *answer;
    tribox_answer_corners *answer_corners; /* NULL where corners cannot be walked */
    tribox_plan *plan;
    const tribox_box_pattern *pattern; /* NULL where vertices are not compared with the box, word by word */
    struct tribox_codes *codes;        /* NULL where vertices are not coded (mesh_codes.h) */
    bool is_empty;                     /* nothing overlaps this box */
    bool in_double;                    /* of positions that are copied */
    const void *about;                 /* what `answer` knows of the box */
};

/*
 * Answers all triangles of a mesh whose strides are set; mask may be NULL. False, and nothing is written, if an index names no
 * vertex.
 */
bool tribox_mesh_answer(const tribox_mesh_query *query, const tribox_mesh *mesh, uint64_t *mask, tribox_report *counts);

#endif
