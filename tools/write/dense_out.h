/* dense_out.h - the cells of a grid at their places in a file, by several threads, with holes where none is set. */
#ifndef DENSE_OUT_H
#define DENSE_OUT_H

#include "console/progress.h"
#include "file_out.h"
#include "volume.h"

/*
 * What stands before the cells, all layers of these, and what stands after them: by threads, in any order, where the file has
 * places, else by one. Returns an exit_code.
 */
int dense_write(const volume_frame *frame, const file_out *file, const voxels *v, unsigned threads, progress *bar);

#endif
