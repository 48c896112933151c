/* box.h - what every call checks of a box before it uses it. */
#ifndef TRIBOX_BOX_H
#define TRIBOX_BOX_H

#include "finite.h"
#include "soup.h"
#include "tribox.h"

static inline bool tribox_box_is_finite(const tribox_box *box)
{
    for (int a = 0; a < 3; a++)
        if (!tribox_is_finite_double(box->lo[a]) || !tribox_is_finite_double(box->hi[a]))
            return false;
    return true;
}

/* Of a finite box, in our environment: denormals-are-zero would see no difference between two subnormal bounds. */
static inline bool tribox_box_is_empty(const tribox_box *box)
{
    return box->lo[0] > box->hi[0] || box->lo[1] > box->hi[1] || box->lo[2] > box->hi[2];
}

/* Whether boxes can be read: no NULL where boxes are, and a count that fits. */
static inline bool tribox_boxes_are_readable(const tribox_boxes *boxes)
{
    if (!boxes || !tribox_is_addressable(boxes->count))
        return false;
    for (int a = 0; boxes->count && a < 3; a++)
        if (!boxes->lo[a] || !boxes->hi[a])
            return false;
    return true;
}

#endif
