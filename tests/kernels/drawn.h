/* drawn.h - questions drawn from the scenes. */
#ifndef TRIBOX_TESTS_DRAWN_H
#define TRIBOX_TESTS_DRAWN_H

#include "question.h"
#include "common/scenes.h"

enum { DRAWN_MAX = 10240, DRAWN_WORDS = DRAWN_MAX / 64 };

/* The numbers that a question points to. */
typedef struct drawn {
    float stream[SOUP_STREAMS][DRAWN_MAX];
    tribox_box box;
    float triangle[3][3];
} drawn;

/* One batch of a scene: its triangles against its box, or one of its triangles against boxes made from its box. */
question draw_question(random_source *r, const scene *s, bool is_soup, drawn *numbers);

/*
 * DRAWN_MAX pairs about the box of the paper, as different from lane to lane as can be. Zeros overlap: the box holds the origin,
 * and so does the triangle. A zero past the end of a stream therefore shows.
 */
question draw_distinct_lanes(random_source *r, bool is_soup, drawn *numbers);

#endif
