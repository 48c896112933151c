/* bricks_npz_none.c - stands in for bricks_npz.c where the program is built without zlib. */
#include "brick_writer.h"
#include "console/message.h"
#include "parts_npz.h"

const brick_writer bricks_npz = {.open = NULL};

int bricks_check_npz(const char *path, const tribox_grid *grid)
{
    (void)grid;
    return message_failure("%s: this tribox was built without zlib, which .npz needs; write .npy or .raw", path);
}

/* Is not called, as the check refuses. */
int parts_npz_write(file_out *out, const part *parts, size_t count, const voxels *v, unsigned threads, progress *bar)
{
    (void)parts, (void)count, (void)v, (void)threads, (void)bar;
    return bricks_check_npz(out->path, NULL);
}
