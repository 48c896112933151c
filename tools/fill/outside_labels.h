/* outside_labels.h - which free cells of each tile the outside reaches: labels of tiles, joined across their faces. */
#ifndef OUTSIDE_LABELS_H
#define OUTSIDE_LABELS_H

#include "tile_cells.h"

/* The labels of a record's tile among all, and its faces until the tiles beside them are there. */
typedef struct labelled_tile {
    uint32_t from, count;
    bool is_there;
    uint32_t *faces[6];
} labelled_tile;

/* Label 0 is the outside, 1 + t that of tile t if it has no triangles; labels of other tiles follow. */
typedef struct outside_labels {
    const tile_set *set;
    uint32_t along[3];    /* tiles */
    uint32_t *record_of;  /* each tile's; NO_RECORD without triangles */
    labelled_tile *tiles; /* of records */
    uint32_t *parents;
    size_t count, room; /* labels */
} outside_labels;

#define NO_RECORD UINT32_MAX

/* False where there is no memory. In any case outside_labels_free follows. */
bool outside_labels_start(const tile_set *set, outside_labels *o);
void outside_labels_free(outside_labels *o);

/* How many cells a face of a window has. */
size_t outside_face_cells(const tribox_window *w, int face);

/*
 * Adds a record's tile: its faces, of which those that are kept are taken over and NULL then. One thread at a time. False where
 * there is no memory, or no number is left.
 */
bool outside_labels_add(outside_labels *o, size_t record, uint32_t *faces[6], uint32_t count);

/* When all are added: joins the tiles without triangles; then any number of threads may ask. */
void outside_labels_finish(outside_labels *o);

/* Whether the outside reaches the cells of a label, and all of a tile without triangles. */
static inline bool outside_has_label(const outside_labels *o, uint32_t label) { return o->parents[label] == 0; }
static inline bool outside_has_tile(const outside_labels *o, size_t tile) { return outside_has_label(o, (uint32_t)tile + 1); }

#endif
