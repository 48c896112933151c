/* bricks_npz_none.c - stands in for bricks_npz.c where the program is built without zlib. */
#include "brick_writer.h"
#include "console/message.h"

const brick_writer bricks_npz = {.open = NULL};

int bricks_check_npz(const char *path, const tribox_grid *grid)
{
    (void)grid;
    return message_failure("%s: this tribox was built without zlib, which .npz needs; write .npy or .raw", path);
}
