/* many_boxes.h - one call about many boxes, as they were drawn and in an order in which they are near each other. */
#ifndef BENCH_MANY_BOXES_H
#define BENCH_MANY_BOXES_H

#include "ordered_soup.h"
#include "timing/contestant.h"

typedef struct many_boxes {
    const ordered_soup *soup;
    const tribox_box *drawn;
    float *bounds[2][6]; /* as streams: as drawn, and in order */
    tribox_boxes boxes[2];
    uint32_t *order, *list;
    void *scratch;
    size_t *start, room;
} many_boxes;

/* boxes: used until many_boxes_free. False if memory or the library fails. */
bool many_boxes_make(const ordered_soup *soup, const tribox_box *boxes, size_t count, const char *kernel, many_boxes *made);

void many_boxes_free(many_boxes *made);

/* Whether every list of the call is that of a call about its box alone. list: room for all triangles of the soup. */
bool many_boxes_are_right(const many_boxes *question, const char *kernel, uint32_t *list);

typedef enum many_run { MANY_AS_DRAWN, MANY_IN_ORDER, MANY_ORDERING, MANY_RUNS } many_run;

/* Times are a box's. */
contestant many_boxes_contestant(const many_boxes *question, many_run run, const char *kernel);

#endif
