/* index_question.h - one question to an index: its triangles, of a soup or a mesh, and the region. */
#ifndef TRIBOX_INDEX_QUESTION_H
#define TRIBOX_INDEX_QUESTION_H

#include "indexed.h"
#include "mesh/mesh_floats.h"
#include "mesh/mesh_local.h"
#include "mesh_words.h"
#include "pairs/oriented_words.h"
#include "pairs/pairs.h"

typedef struct tribox_question {
    tribox_indexed over;
    tribox_accuracy asked;
    tribox_plan plan;                    /* its accuracy is what runs: doubles take FAST as CONSERVATIVE */
    bool may_choose;                     /* the order of the groups is not fixed */
    const tribox_oriented_box *oriented; /* or NULL, and */
    tribox_box box;
    tribox_node_box nodes;    /* how nodes see the box: those of doubles each in its own way */
    tribox_float_box rounded; /* how floats see it, */
    tribox_local_box local;   /* and doubles */
    tribox_query pairs;       /* of a soup */
    tribox_mesh_query blocks; /* of a mesh */
    tribox_oriented_query turned;
    tribox_partial_packet partial;
    size_t undecided;
} tribox_question;

/* The triangles, checked; false if they cannot be read, or there are no nodes. */
bool tribox_question_take(tribox_question *q, const tribox_index *index);

/* The region, once the triangles are taken; then the options, which it may limit. */
tribox_status tribox_question_check_region(tribox_question *q, const tribox_region *region);
tribox_status tribox_question_check_options(tribox_question *q, const tribox_options *options);

/* A finite box, in place of the region or after another one. False if nothing overlaps it. In the environment of environment.h. */
bool tribox_question_about(tribox_question *q, const tribox_box *box);

/* The same of a region that was checked. */
bool tribox_question_start(tribox_question *q);

/* The first `children` children of a node. */
tribox_touch tribox_question_touch(tribox_question *q, const tribox_node *node, unsigned children);

/*
 * Answers `count` words with rising numbers, TRIBOX_BLOCK_WORDS at most; skips those with full[i] != 0. A triangle without vertices
 * overlaps nothing.
 */
void tribox_question_answer(tribox_question *q, const size_t *word, const size_t *full, unsigned count, uint64_t *hit);

/* Some triangle of a word, sooner if one lies wholly inside; false if none overlaps. */
bool tribox_question_any(tribox_question *q, size_t word, size_t *triangle);

/* The candidates of a word whose vertices are all in the box. */
uint64_t tribox_question_inside(const tribox_question *q, size_t word, uint64_t candidates);

#endif
