/* status.c - what a status means, in words. */
#include "tribox.h"

const char *tribox_status_text(tribox_status status)
{
    switch (status) {
    case TRIBOX_OK:
        return "success";
    case TRIBOX_BAD_ARGUMENT:
        return "an argument is NULL or not allowed: the comment on the function says what is";
    case TRIBOX_BAD_BOX:
        return "a bound of the box is NaN or infinite";
    case TRIBOX_BAD_GRID:
        return "the grid is not finite, not positive, too large, or finer than its numbers can tell";
    case TRIBOX_BAD_OPTION:
        return "unknown accuracy, axis set or order of the axes";
    case TRIBOX_NO_KERNEL:
        return "unknown kernel name, or a kernel that this processor cannot run";
    case TRIBOX_NO_MEMORY:
        return "out of memory";
    case TRIBOX_BAD_INDEX:
        return "an index of the mesh refers to no vertex, or one of a list to no triangle";
    case TRIBOX_STOPPED:
        return "the sink ended the call";
    }
    return "unknown status";
}
