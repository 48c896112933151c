/*
 * overlap_call.h - one call about one box and many triangles: whatever holds the triangles, a soup, a mesh of floats or one of
 * doubles, it is answered block by block, and nothing else needs to know which it is.
 */
#ifndef TRIBOX_OVERLAP_CALL_H
#define TRIBOX_OVERLAP_CALL_H

#include "mesh/mesh_codes.h"
#include "mesh/mesh_floats.h"
#include "mesh/mesh_local.h"
#include "pairs/pairs.h"

/* Triangles of a block at most, of whatever they are. */
enum { TRIBOX_CALL_BLOCK = 64 * TRIBOX_BLOCK_WORDS };

typedef struct tribox_overlap_call {
    const tribox_soup *soup; /* or NULL, and */
    tribox_mesh mesh;        /* its strides set */
    size_t count;
    const tribox_box *box;
    bool is_empty; /* nothing overlaps the box */
    tribox_accuracy asked;
    tribox_plan plan; /* its accuracy is what runs: doubles take FAST as CONSERVATIVE */
    tribox_float_box rounded;
    tribox_local_box local;
    tribox_partial_packet partial;
    tribox_query pairs;      /* of a soup */
    tribox_mesh_query query; /* of a mesh */
} tribox_overlap_call;

/* What the call is about; false if it cannot be read. */
bool tribox_call_take_soup(tribox_overlap_call *c, const tribox_soup *soup);
bool tribox_call_take_mesh(tribox_overlap_call *c, const tribox_mesh *mesh);

/* The checks of the box and the options, once the triangles are taken; is_taken: whether they could be. */
tribox_status tribox_call_check(tribox_overlap_call *c, bool is_taken, const tribox_box *box, const tribox_options *options);

/* Whether codes would help a call that was checked; they are a large part of the stack, so others have no room for them. */
bool tribox_call_may_code(const tribox_overlap_call *c);

/*
 * Before the first block. Needs tribox_environment_enter(), as all that follows. codes: room for them, or NULL. is_all_asked: else
 * the first triangles may do.
 */
void tribox_call_start(tribox_overlap_call *c, tribox_codes *codes, bool is_all_asked);

/*
 * Answers triangles first .. first + count - 1, TRIBOX_CALL_BLOCK at most, or the first of them in whole words, and adds to the
 * counts. Returns how many; 0 if one names no vertex.
 */
size_t tribox_call_answer_block(tribox_overlap_call *c, size_t first, size_t count, uint64_t *hit, tribox_report *counts);

/* All of them; mask may be NULL. False, and nothing is written, if a triangle names no vertex. */
bool tribox_call_answer(tribox_overlap_call *c, uint64_t *mask, tribox_report *counts);

/* The candidates among the triangles of a word, from triangle `first` on, whose vertices are all in the box. */
uint64_t tribox_call_inside(const tribox_overlap_call *c, size_t first, uint64_t candidates);

/* Writes what the call counted; report may be NULL. */
void tribox_call_report(const tribox_overlap_call *c, tribox_report counts, tribox_report *report);

#endif
