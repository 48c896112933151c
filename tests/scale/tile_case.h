/* tile_case.h - triangles of floats or doubles, a grid and its tiles, and the calls about them by one name. */
#ifndef TRIBOX_TESTS_TILE_CASE_H
#define TRIBOX_TESTS_TILE_CASE_H

#include "common/guard.h"
#include "voxels/cells.h"

enum { CASE_CELLS = 60000, CASE_CELLS_F64 = 3000, CASE_WORDS = CASE_CELLS };

typedef struct tile_case {
    cells_case of; /* of floats, as a soup or as a mesh, or of doubles; the scene, the grid, the options */
    uint32_t tile;
} tile_case;

/*
 * Any kind of grid, with triangles of all kinds, some of them on planes between tiles or next to them, some not finite; and any
 * options. Tiles are of `tile` cells, or of any number where that is 0.
 */
void tile_case_draw(random_source *r, uint32_t tile, tile_case *c);

/* For messages. */
void tile_case_tell(const tile_case *c, char *text, size_t length);

size_t tile_case_tiles(const tile_case *c);

/* Places and lists of a part of the triangles. */
tribox_status tile_case_part(const tile_case *c, size_t first, size_t count, size_t from, size_t to, size_t *places,
                             uint32_t *list);

/* Of triangles handed over before, as laying them out needs an environment; by the one of three sinks that there is. */
typedef struct any_sink {
    tribox_sink bits;
    tribox_ids_sink ids;
    tribox_lists_sink lists;
} any_sink;
tribox_status tile_case_bricks(const tile_case *c, const soup_or_mesh *of, size_t from, size_t to, const size_t *starts,
                               const uint32_t *list, void *scratch, const any_sink *sink, tribox_report *report);

/* Ids are written where a bit is set; those of the whole grid with its bits, which are zero before. */
void tile_case_dense_ids(const tile_case *c, const tribox_options *options, uint64_t *occupied, uint32_t *ids);

/* Which triangles overlap a tile's box by these options. */
void tile_case_overlap(const tile_case *c, size_t tile, const tribox_options *options, uint64_t *mask);

/* So many lists as a call makes them, first the starts and then the numbers, in memory that ends where it has to. */
typedef struct tile_lists {
    guarded starts_pages, list_pages;
    size_t *starts;
    uint32_t *list;
} tile_lists;
typedef tribox_status list_call(const void *of, size_t *starts, uint32_t *list);
tile_lists lists_asked(size_t count, list_call *ask, const void *of);
void tile_lists_free(tile_lists lists);

/* Those of tiles from .. to - 1. */
tile_lists tile_case_lists(const tile_case *c, size_t from, size_t to);

#endif
