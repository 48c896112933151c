/* partition_write.h - writes the triangles of each tile, and their index. */
#ifndef PARTITION_WRITE_H
#define PARTITION_WRITE_H

#include "console/progress.h"
#include "partition.h"
#include "read/mesh.h"
#include "voxelize/tile_set.h"
#include "write/folder_out.h"

/* In the order of folder_out's files. */
#define PARTITION_NAMES ((const char *const[FOLDER_FILES]){"index", "triangles"})

/*
 * Writes both files; what fails is told by the streams. set: lists over the mesh, its work estimated. header: all but records,
 * places and checksum, which are found here. False where there is no memory.
 */
bool partition_write(folder_out *out, const mesh *m, tile_set *set, partition_header *header, progress *bar);

#endif
