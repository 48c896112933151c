/* tile_case.h - triangles of floats or doubles, a grid and its tiles, and the calls about them by one name. */
#ifndef TRIBOX_TESTS_TILE_CASE_H
#define TRIBOX_TESTS_TILE_CASE_H

#include "common/soup_or_mesh.h"
#include "voxels/occupancy.h"
#include "voxels/window_f64.h"

enum { CASE_CELLS = 60000, CASE_CELLS_F64 = 3000, CASE_WORDS = CASE_CELLS };

typedef struct tile_case {
    bool is_double, is_mesh;
    grid_planes at; /* of floats: the grid, the triangles, and these as a mesh */
    triangle_list triangles;
    float corners[TRIANGLE_LIST_MAX][3][3];
    window_f64 window; /* of doubles */
    const char *scene;
    uint32_t tile;
    tribox_options options;
} tile_case;

/*
 * Any kind of grid, with triangles of all kinds, some of them on planes between tiles or next to them, some not finite; and any
 * options. Tiles are of `tile` cells, or of any number where that is 0.
 */
void tile_case_draw(random_source *r, uint32_t tile, tile_case *c);

/* For messages. */
void tile_case_tell(const tile_case *c, char *text, size_t length);

const uint32_t *tile_case_size(const tile_case *c);
size_t tile_case_triangles(const tile_case *c);
size_t tile_case_tiles(const tile_case *c);

/* The triangles as they are asked about; or, of floats, always as a soup, which judges the mesh of them. */
soup_or_mesh tile_case_asked(const tile_case *c);
soup_or_mesh tile_case_judge(const tile_case *c);
const tribox_grid *tile_case_grid(const tile_case *c);

/* The calls. */
tribox_status tile_case_list(const tile_case *c, size_t from, size_t to, size_t *starts, uint32_t *list);
tribox_status tile_case_part(const tile_case *c, size_t first, size_t count, size_t from, size_t to, size_t *places,
                             uint32_t *list);

/* By the one of three sinks that there is. */
typedef struct any_sink {
    tribox_sink bits;
    tribox_ids_sink ids;
    tribox_lists_sink lists;
} any_sink;
tribox_status tile_case_bricks(const tile_case *c, size_t from, size_t to, const size_t *starts, const uint32_t *list,
                               void *scratch, const any_sink *sink, tribox_report *report);

/* Ids are written where a bit is set; those of the whole grid with its bits, which are zero before. */
void tile_case_dense_ids(const tile_case *c, const tribox_options *options, uint64_t *occupied, uint32_t *ids);

/* The bits of the whole grid, by the scalar kernel where all are to be right. */
size_t tile_case_dense(const tile_case *c, const tribox_options *options, uint64_t *occupied);

/* Which triangles overlap a tile's box by these options. */
void tile_case_overlap(const tile_case *c, size_t tile, const tribox_options *options, uint64_t *mask);

/* The lists of tiles from .. to - 1; free both. */
typedef struct tile_lists {
    size_t *starts;
    uint32_t *list;
} tile_lists;
tile_lists tile_case_lists(const tile_case *c, size_t from, size_t to);
void tile_lists_free(tile_lists lists);

#endif
