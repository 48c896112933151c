/*
 * between_boxes.h - triangles of floats against a box of doubles, at the speed of floats: between the largest box of floats inside
 * it and the smallest around it. Triangles that overlap the inner box overlap the box, those that miss the outer box miss it, and
 * the few others are settled one by one in double. The axes that separate a box separate all that is in it, so this holds for
 * every choice of axes.
 */
#ifndef BETWEEN_BOXES_H
#define BETWEEN_BOXES_H

#include "found_words.h"
#include "tribox.h"

/*
 * Does what tribox_overlap, or tribox_classify where inside is not NULL, would do for a box of doubles. outer: room for a second
 * mask. The report counts the triangles between the boxes as undecided.
 */
tribox_status between_boxes_ask(const tribox_soup *soup, const tribox_box *box, const tribox_options *test, uint64_t *mask,
                                uint64_t *inside, uint64_t *outer, tribox_report *report);

/* The same by an index. words: receives the words of the mask, of which some may be zero; inner: room for as many. */
tribox_status between_boxes_index(const tribox_index *index, const tribox_soup *soup, const tribox_box *box,
                                  const tribox_options *test, found_words *words, found_words *inner, tribox_report *report);

#endif
