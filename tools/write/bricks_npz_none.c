/* bricks_npz_none.c - stands in for bricks_npz.c where the program is built without zlib. */
#include "brick_out.h"
#include "console/message.h"
#include "part.h"

const brick_writer bricks_npz = {.open = NULL};

int bricks_check_npz(const char *path, const tribox_grid *grid)
{
    (void)grid;
    return message_failure("%s: this tribox was built without zlib, which .npz needs; write .npy or .raw", path);
}

int part_open(part *p, const char *path)
{
    (void)p;
    return message_failure("%s: this tribox was built without zlib, which parts need", path);
}

/* Not called, as part_open refuses. */
int part_read(part *p, unsigned threads, part_take *take, void *data)
{
    (void)threads, (void)take, (void)data;
    return part_open(p, p->path);
}
