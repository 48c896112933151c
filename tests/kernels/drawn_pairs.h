/* drawn_pairs.h - lists of pairs drawn from the scenes. */
#ifndef TRIBOX_TESTS_DRAWN_PAIRS_H
#define TRIBOX_TESTS_DRAWN_PAIRS_H

#include "pair_list.h"
#include "common/scenes.h"

enum { DRAWN_MAX = 10240, DRAWN_WORDS = DRAWN_MAX / 64 };

/* The numbers that a list of pairs points to. */
typedef struct drawn_numbers {
    float stream[SOUP_STREAMS][DRAWN_MAX];
    tribox_box box;
    float triangle[3][3];
} drawn_numbers;

/* The first numbers as a soup beside a box; or those for boxes, if it is NULL, beside a triangle. */
pair_list pairs_over(const drawn_numbers *numbers, size_t count, const tribox_box *box, const float (*triangle)[3]);

/* One batch of a scene: its triangles against its box, or one of its triangles against boxes made from its box. */
pair_list draw_pairs(random_source *r, const scene *s, bool is_soup, drawn_numbers *numbers);

/*
 * DRAWN_MAX pairs about the box of the paper, as different from lane to lane as can be. Zeros overlap: the box holds the origin,
 * and so does the triangle. A zero past the end of a stream therefore shows.
 */
pair_list draw_distinct_lanes(random_source *r, bool is_soup, drawn_numbers *numbers);

#endif
