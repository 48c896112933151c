/* tile_listing.h - which triangles of a task are in which tile, found by threads: the list of tribox_tile_lists. */
#ifndef TILE_LISTING_H
#define TILE_LISTING_H

#include "voxel_task.h"

/*
 * starts: those of all tiles, written. list: to be freed where the status is TRIBOX_OK, with its length, the last of the starts.
 * Fails as tribox_tile_lists, or with MESSAGE_NO_MEMORY.
 */
tribox_status tile_listing_make(const voxel_task *task, const tribox_tiles *tiles, const tribox_options *options, unsigned threads,
                                size_t *starts, uint32_t **list);
void tile_listing_free(uint32_t *list, size_t count);

#endif
