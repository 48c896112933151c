/* parts_npz.h - parts that become one .npz file by threads: where the bricks of each go is known before they are read. */
#ifndef PARTS_NPZ_H
#define PARTS_NPZ_H

#include "console/progress.h"
#include "file_out.h"
#include "part.h"

/*
 * Writes the content of an open file that is not standard output: the bytes of brick_out for the bricks of all parts, stored and
 * not deflated. v: grid and shift. bar: of the share done. Returns an exit_code.
 */
int parts_npz_write(file_out *out, part *parts, size_t count, const voxels *v, unsigned threads, progress *bar);

#endif
