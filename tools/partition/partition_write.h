/* partition_write.h - writes the triangles of each tile from all runs, and their index. */
#ifndef PARTITION_WRITE_H
#define PARTITION_WRITE_H

#include "tile_runs.h"

/* In the order of folder_out's files; the last is left out where triangles have no numbers. */
#define PARTITION_NAMES(has_numbers) ((const char *const[FOLDER_FILES]){"index", "triangles", (has_numbers) ? "numbers" : NULL})

/*
 * Writes the files by so many threads; the folder is still to be kept. header: all but records, places and checksum, which are
 * found here. Returns an exit_code.
 */
int partition_write(folder_out *out, tile_runs *runs, unsigned threads, bool is_quiet, partition_header *header);

#endif
