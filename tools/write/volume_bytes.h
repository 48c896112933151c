/* volume_bytes.h - the cells of a grid as a byte each, x fastest, then y, then z. */
#ifndef VOLUME_BYTES_H
#define VOLUME_BYTES_H

#include <stdio.h>

#include "console/progress.h"
#include "voxels.h"

/* 1 where a cell is set, else 0. Stops where the stream fails. */
void volume_write_bytes(FILE *to, const voxels *v, progress *bar);

#endif
