/*
 * voxel_limits.h - what no voxelization can do without: its answer has to be written. That its soup has to be read is in
 * common/loads.h.
 */
#ifndef BENCH_VOXEL_LIMITS_H
#define BENCH_VOXEL_LIMITS_H

#include <stdbool.h>

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of each triangle in turn the words of the grid that its own cells lie in, and their bits. */
typedef struct voxel_words {
    size_t count, room;
    uint32_t *word;
    uint64_t *bits;
} voxel_words;

/* `blank` has tribox_window_words words, zero before and after. False if memory runs out or the library refuses. */
bool voxel_words_find(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options, uint64_t *blank,
                      voxel_words *found);

/* Returns how many cells are newly set. */
size_t voxel_words_write(const voxel_words *words, uint64_t *occupied);

void voxel_words_free(voxel_words *words);

#ifdef __cplusplus
}
#endif

#endif
