/* turned_boxes.h - the same boxes turned about their middles: oriented ones, by an index and without. */
#ifndef BENCH_TURNED_BOXES_H
#define BENCH_TURNED_BOXES_H

#include "ordered_soup.h"
#include "timing/contestant.h"

typedef struct turned_boxes {
    const ordered_soup *soup;
    tribox_oriented_box *boxes;
    size_t count;
    uint32_t *list; /* room for all triangles */
    uint64_t *mask; /* of all triangles */
} turned_boxes;

/* list, mask: room of the caller's. False, with a message, if memory fails. */
bool turned_boxes_make(const ordered_soup *soup, const tribox_box *boxes, size_t count, uint32_t *list, uint64_t *mask,
                       turned_boxes *made);

void turned_boxes_free(turned_boxes *made);

/* Whether the lists of the first boxes are those of tribox_overlap_oriented. */
bool turned_boxes_are_right(const turned_boxes *question, size_t boxes, const char *kernel);

/* Lists by the index, of all boxes; or tribox_overlap_oriented of the first so many. Times are a box's. */
contestant turned_boxes_by_index(const turned_boxes *question, const char *kernel);
contestant turned_boxes_linear(const turned_boxes *question, size_t boxes, const char *kernel);

#endif
