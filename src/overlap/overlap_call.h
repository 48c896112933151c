/*
 * overlap_call.h - one call about one box and many triangles: whatever holds the triangles, a soup, a mesh of floats or one of
 * doubles, it is answered block by block, and nothing else needs to know which it is.
 */
#ifndef TRIBOX_OVERLAP_CALL_H
#define TRIBOX_OVERLAP_CALL_H

#include "base/box.h"
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
    bool is_empty;       /* nothing overlaps the box */
    bool is_few_of_mesh; /* tribox_mesh_answer_few answers it */
    tribox_accuracy asked;
    tribox_plan plan; /* its accuracy is what runs: doubles take FAST as CONSERVATIVE */
    tribox_float_box rounded;
    tribox_local_box local;
    tribox_query pairs;      /* of a soup */
    tribox_mesh_query query; /* of a mesh */
} tribox_overlap_call;

/* What the call is about; false if it cannot be read. */
static inline bool tribox_call_take_soup(tribox_overlap_call *c, const tribox_soup *soup)
{
    if (!tribox_soup_is_readable(soup))
        return false;
    c->soup = soup;
    c->count = soup->count;
    return true;
}
bool tribox_call_take_mesh(tribox_overlap_call *c, const tribox_mesh *mesh);

/* The checks of the box and the options, once the triangles are taken; is_taken: whether they could be. */
static inline tribox_status tribox_call_check(tribox_overlap_call *c, bool is_taken, const tribox_box *box,
                                              const tribox_options *options)
{
    if (!box || !is_taken)
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_box_is_finite(box))
        return TRIBOX_BAD_BOX;
    c->box = box;
    const tribox_status status = tribox_plan_make(options, &c->plan);
    c->asked = c->plan.accuracy;
    return status;
}

/* Of a mesh, what comes next. */
void tribox_call_start_mesh(tribox_overlap_call *c, tribox_codes *codes, bool is_all_asked);

/* Whether codes would help a call that was checked; they are a large part of the stack, so others have no room for them. */
bool tribox_call_may_code(const tribox_overlap_call *c);

/*
 * Before the first block. Needs tribox_environment_enter(), as all that follows. codes: room for them, or NULL. is_all_asked: else
 * the first triangles may do.
 */
static inline void tribox_call_start(tribox_overlap_call *c, tribox_codes *codes, bool is_all_asked)
{
    c->is_empty = tribox_box_is_empty(c->box);
    if (!c->soup) {
        tribox_call_start_mesh(c, codes, is_all_asked);
        return;
    }
    const bool are_floats =
        tribox_box_round(c->box, c->plan.axes & TRIBOX_AXES_BOX, c->plan.accuracy == TRIBOX_FAST, &c->rounded.box);
    const bool is_flag_asked = are_floats && c->plan.accuracy == TRIBOX_EXACT;
    c->pairs = (tribox_query){.soup = c->soup,
                              .box = &c->rounded.box,
                              .count = c->count,
                              .ties = is_flag_asked ? TRIBOX_TIES_WHERE_SEVERAL : TRIBOX_TIES_LEFT};
}

/*
 * Answers triangles first .. first + count - 1, TRIBOX_CALL_BLOCK at most, or the first of them in whole words, and adds to the
 * counts. Returns how many; 0 if one names no vertex. A part is one of a mesh, or of more than a word.
 */
size_t tribox_call_answer_part(tribox_overlap_call *c, size_t first, size_t count, uint64_t *hit, tribox_report *counts);
static inline size_t tribox_call_answer_block(tribox_overlap_call *c, size_t first, size_t count, uint64_t *hit,
                                              tribox_report *counts)
{
    if (!c->soup || c->count > 64)
        return tribox_call_answer_part(c, first, count, hit, counts);
    const tribox_report few = tribox_pairs_answer(&c->pairs, &c->plan, hit);
    counts->overlapping += few.overlapping;
    counts->undecided += few.undecided;
    return count;
}

/* All of them; mask may be NULL. False, and nothing is written, if a triangle names no vertex. */
static inline bool tribox_call_answer(tribox_overlap_call *c, uint64_t *mask, tribox_report *counts)
{
    if (!c->soup && c->is_few_of_mesh)
        return tribox_mesh_answer_few(&c->query, &c->mesh, 0, c->count, mask, counts);
    if (!c->soup)
        return tribox_mesh_answer(&c->query, &c->mesh, mask, counts);
    if (c->is_empty)
        tribox_pairs_write_none(c->count, mask);
    else
        *counts = tribox_pairs_answer(&c->pairs, &c->plan, mask);
    return true;
}

/* The candidates among the triangles of a word, from triangle `first` on, whose vertices are all in the box. */
uint64_t tribox_call_inside(const tribox_overlap_call *c, size_t first, uint64_t candidates);

/* Writes what the call counted; report may be NULL. */
static inline void tribox_call_report(const tribox_overlap_call *c, tribox_report counts, tribox_report *report)
{
    if (c->asked == TRIBOX_FAST)
        counts.undecided = 0;
    tribox_plan_report(&c->plan, counts, report);
}

#endif
