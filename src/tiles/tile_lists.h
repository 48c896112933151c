/* tile_lists.h - which triangles are in which tile: counted, or listed. In the environment of environment.h. */
#ifndef TRIBOX_TILE_LISTS_H
#define TRIBOX_TILE_LISTS_H

#include "grid/grid_cells.h"
#include "grid/triangles.h"
#include "plan.h"
#include "tiles.h"

/* Tiles base[a] .. base[a] + tiles[a] - 1 of each axis. */
typedef struct tribox_tile_box {
    int64_t base[3], tiles[3];
} tribox_tile_box;

/* The rest of a row, the rest of a layer, layers, rows, and the beginning of a row. */
enum { TRIBOX_SHARE_PARTS = 5 };

/* One call. */
typedef struct tribox_tiles_call {
    tribox_tiling tiling;
    tribox_plan plan; /* its accuracy is not FAST */
    const tribox_triangles *triangles;
    size_t from, to; /* the triangles that are listed: from .. to - 1 */
    tribox_planes planes;
    double first_plane[3]; /* where tile 0 begins */
    size_t *places;        /* by tile of the share: how many were counted, or where the next goes */
    uint32_t *list;        /* NULL to count */

    tribox_tile_box part[TRIBOX_SHARE_PARTS]; /* boxes that the share is made of */
    int parts;
    uint32_t triangle; /* the one at hand */
} tribox_tiles_call;

/* The tiles of a window as of a grid of its own; NULL for the whole. With a list, or to count: as tribox_tile_lists. */
tribox_status tribox_tiles_list(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                                const tribox_tiles *tiles, const tribox_options *options, size_t *starts, uint32_t *list);

/* Whether tiles of few cells are listed as cells are: not in a library that is to be small. */
#if defined(TRIBOX_SMALL)
enum { TRIBOX_TILES_AS_CELLS = 0 };
#else
enum { TRIBOX_TILES_AS_CELLS = 1 };
#endif

/* tribox_tiles_list of a whole grid, by the kernels' pairs: false where they do not list these tiles, or arguments are wrong. */
bool tribox_cells_list_tiles(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_tiles *tiles,
                             const tribox_options *options, size_t *starts, uint32_t *list, tribox_status *status);

/* What a share has from tile `at` on: layers, or else rows of one layer, or else tiles of one row. */
tribox_tile_box tribox_tiling_part(const tribox_tiling *t, size_t at);

/*
 * A number into a list of `has` that rise, so that they still do. Most are the greatest; whether they are the first is asked
 * without a branch, as nobody could foretell it.
 */
static inline void tribox_list_put(uint32_t *list, size_t has, uint32_t number)
{
    list[has] = number;
    if (list[has - (has != 0)] <= number)
        return;
    for (; has && list[has - 1] > number; has--)
        list[has] = list[has - 1];
    list[has] = number;
}

/* Finds the boxes of the share. */
void tribox_tiles_cut_share(tribox_tiles_call *l);

/* Tiles 0 to the count of them along the axis: their lowest cells lie above the planes between them. */
double tribox_tile_plane(const void *call, int a, int64_t tile);

/* Puts the triangle at hand into the list of a tile, if the share has the tile. */
static inline void tribox_tiles_put(tribox_tiles_call *l, size_t tile)
{
    if (tile < l->tiling.first || tile >= l->tiling.end)
        return;
    size_t *const place = l->places + (tile - l->tiling.first);
    if (l->list)
        l->list[*place] = l->triangle;
    ++*place;
}

/* Into those of the share that it overlaps, whatever its numbers. */
void tribox_tiles_put_by_planes(tribox_tiles_call *l);

/* The same where its bounding box touches tiles from `first` on (tribox_tile_range), more than one of them. */
void tribox_tiles_put_range(tribox_tiles_call *l, size_t first, unsigned more);

#endif
