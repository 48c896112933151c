/* oriented_words.h - words of triangles of any kind and an oriented box, answered some at a time. */
#ifndef TRIBOX_ORIENTED_WORDS_H
#define TRIBOX_ORIENTED_WORDS_H

#include "base/finite.h"
#include "plan.h"

/* Triangles of a block at most, and room for their streams. */
enum { TRIBOX_ORIENTED_BLOCK = 64 * TRIBOX_MOVED_WORDS };
typedef struct tribox_streams {
    float number[9][TRIBOX_ORIENTED_BLOCK];
} tribox_streams;

/* A question: set by tribox_oriented_ask_soup, or tribox_oriented_ask_mesh of mesh/mesh_input.h. */
typedef struct tribox_oriented_query tribox_oriented_query;
struct tribox_oriented_query {
    const tribox_oriented_box *box;
    tribox_rounded_frame frame; /* of points as `read_block` gives them */
    tribox_plan *plan;
    const void *triangles; /* a soup or a mesh */
    size_t count;

    /* Triangles first .. first + count - 1, a block at most, where they lie or in the room. Whole packets can be read. */
    tribox_soup (*read_block)(const tribox_oriented_query *q, size_t first, size_t count, tribox_streams *room);

    /* Triangle i as it is. */
    void (*read_triangle)(const tribox_oriented_query *q, size_t i, double u[3][3]);
};

static inline bool tribox_oriented_is_finite(const tribox_oriented_box *box)
{
    return tribox_are_finite_doubles(box->center, 3) && tribox_are_finite_doubles(box->half, 3) &&
           tribox_are_finite_doubles(&box->axis[0][0], 9);
}

/* Of a finite box, in our environment. */
static inline bool tribox_oriented_is_empty(const tribox_oriented_box *box)
{
    return box->half[0] < 0 || box->half[1] < 0 || box->half[2] < 0;
}

/* Whether a plan can be kept about the box: EXACT takes all axes, or the box normals alone. */
static inline bool tribox_oriented_has_axes(const tribox_plan *plan)
{
    return plan->accuracy != TRIBOX_EXACT || plan->axes == TRIBOX_AXES_ALL || plan->axes == TRIBOX_AXES_BOX;
}

/*
 * A question about a soup of as many triangles as the kernel has lanes, or with numbers after them (tribox_partial_packet), and a
 * finite box that is not empty. What it is asked of is kept by address. In the environment of environment.h, as is what follows.
 */
void tribox_oriented_ask_soup(tribox_oriented_query *q, const tribox_soup *soup, const tribox_oriented_box *box, tribox_plan *plan);

/* Answers words word .. word + words - 1 of the triangles. Returns how many were left to a slower stage. */
size_t tribox_oriented_answer(const tribox_oriented_query *q, size_t word, size_t words, uint64_t *hit);

/* Answers all, and counts. mask may be NULL. */
tribox_report tribox_oriented_answer_all(const tribox_oriented_query *q, uint64_t *mask);

#endif
