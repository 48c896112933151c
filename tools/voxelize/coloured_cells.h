/* coloured_cells.h - a mesh into the words of its whole grid, and a colour for each cell: that of its lowest triangle. */
#ifndef COLOURED_CELLS_H
#define COLOURED_CELLS_H

#include "colours/cell_colours.h"
#include "colours/mesh_colours.h"
#include "console/progress.h"
#include "tile_set.h"

/*
 * task: with ids. words: of the whole grid, all 0. The colours are the same for any number of threads. Returns an exit_code; on
 * success cell_colours_free gives the memory back.
 */
int coloured_cells_make(const voxel_task *task, const mesh_colours *colours, unsigned threads, uint64_t *words, cell_colours *cells,
                        progress *bar, tribox_report *report);

#endif
