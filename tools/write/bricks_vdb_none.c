/* bricks_vdb_none.c - stands in for bricks_vdb.c where the program is built without OpenVDB. */
#include "brick_out.h"
#include "console/message.h"

const brick_writer bricks_vdb = {.open = NULL};

void bricks_begin_vdb(void) {}

int bricks_check_vdb(const char *path, const tribox_grid *grid)
{
    (void)grid;
    return message_failure("%s: this tribox was built without OpenVDB, which .vdb needs; write .npz", path);
}
