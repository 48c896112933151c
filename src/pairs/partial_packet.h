/*
 * partial_packet.h - the pairs of a call as a kernel can read them: the caller's, or a packet of them where they are too few for
 * one.
 */
#ifndef TRIBOX_PARTIAL_PACKET_H
#define TRIBOX_PARTIAL_PACKET_H

#include "kernel.h"

static inline bool tribox_is_partial(size_t count, const tribox_kernel *kernel) { return count && count < kernel->lanes; }

static inline const tribox_soup *tribox_pad_triangles(const tribox_soup *soup, const tribox_kernel *kernel,
                                                      tribox_partial_packet *partial)
{
    if (!tribox_is_partial(soup->count, kernel))
        return soup;
    kernel->spread_triangles(soup, partial);
    return &partial->soup;
}

static inline const tribox_boxes *tribox_pad_boxes(const tribox_boxes *boxes, const tribox_kernel *kernel,
                                                   tribox_partial_packet *partial)
{
    if (!tribox_is_partial(boxes->count, kernel))
        return boxes;
    kernel->spread_boxes(boxes, partial);
    return &partial->boxes;
}

#endif
