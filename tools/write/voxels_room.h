/* voxels_room.h - whether all cells of a grid fit into one call, and into memory. */
#ifndef VOXELS_ROOM_H
#define VOXELS_ROOM_H

#include "voxels.h"

/* Refuses a grid of more words than one call takes. instead: what to do. Returns an exit_code. */
int voxels_check_words(const tribox_grid *grid, const char *instead);

/* Refuses what does not fit into memory before any of it is taken. instead: as above. Returns an exit_code. */
int voxels_check_memory(const tribox_grid *grid, uint64_t bytes, const char *instead);

#endif
