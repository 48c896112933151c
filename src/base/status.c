/* status.c - the version, and what a status means, in words. */
#include "compiler.h"
#include "tribox.h"

#define AS_TEXT(number) #number
#define VERSION_TEXT(major, minor, patch) AS_TEXT(major) "." AS_TEXT(minor) "." AS_TEXT(patch)

const char *tribox_version(void) { return VERSION_TEXT(TRIBOX_VERSION_MAJOR, TRIBOX_VERSION_MINOR, TRIBOX_VERSION_PATCH); }

const char *tribox_status_text(tribox_status status)
{
    switch (status) {
    case TRIBOX_OK:
        return "success";
    case TRIBOX_BAD_ARGUMENT:
        return "an argument is NULL or not allowed; see the comment on the function";
    case TRIBOX_BAD_BOX:
        return "a number of the box is NaN or infinite, or the middle at which to split it is not within it";
    case TRIBOX_BAD_GRID:
        return "the grid is not finite, not positive, too large, or so fine that two planes are one number";
    case TRIBOX_BAD_OPTION:
        return "an option is unknown, not available in this call, or reserved and not zero";
    case TRIBOX_NO_KERNEL:
        return "unknown kernel name, or a kernel that this processor cannot run, or that -ffp-contract=fast broke";
    case TRIBOX_BAD_VERTEX:
        return "the mesh refers to a vertex, or a list to a triangle, that does not exist";
    case TRIBOX_STOPPED:
        return "the sink ended the call";
    }
    return "unknown status";
}
