/* oriented_words.h - words of triangles and an oriented box, answered some at a time. */
#ifndef TRIBOX_ORIENTED_WORDS_H
#define TRIBOX_ORIENTED_WORDS_H

#include "base/finite.h"
#include "plan.h"

typedef struct tribox_oriented_question {
    const tribox_soup *soup;
    const tribox_oriented_box *box;
    tribox_plan *plan;
} tribox_oriented_question;

static inline bool tribox_oriented_is_finite(const tribox_oriented_box *box)
{
    return tribox_are_finite(box->center, 3) && tribox_are_finite(box->half, 3) && tribox_are_finite(&box->axis[0][0], 9);
}

static inline bool tribox_oriented_is_empty(const tribox_oriented_box *box)
{
    return box->half[0] < 0 || box->half[1] < 0 || box->half[2] < 0;
}

/* Whether a plan can be kept about the box: EXACT takes all axes, or the box normals alone. */
static inline bool tribox_oriented_has_axes(const tribox_plan *plan)
{
    return plan->accuracy != TRIBOX_EXACT || plan->axes == TRIBOX_AXES_ALL || plan->axes == TRIBOX_AXES_BOX;
}

/* Answers words word .. word + words - 1 of the soup. Returns how many triangles were left to a slower stage. */
size_t tribox_oriented_answer(const tribox_oriented_question *q, size_t word, size_t words, uint64_t *hit);

#endif
