/* outside_labels.c - joins labels as tiles come: a face is kept until the tile on its other side is there. */
#include "outside_labels.h"

#include <stdlib.h>
#include <string.h>

#include "tribox_threads.h"

static const size_t labels_most = UINT32_MAX - 1;

/* Room for `more` labels, each the parent of itself. */
static bool add_labels(outside_labels *o, size_t more)
{
    if (more > labels_most - o->count)
        return false;
    if (o->count + more > o->room) {
        const size_t room = o->count + more + o->count / 2;
        uint32_t *const grown = realloc(o->parents, room * sizeof *grown);
        if (!grown)
            return false;
        o->parents = grown;
        o->room = room;
    }
    for (size_t n = 0; n < more; n++, o->count++)
        o->parents[o->count] = (uint32_t)o->count;
    return true;
}

bool outside_labels_start(const tile_set *set, outside_labels *o)
{
    *o = (outside_labels){.set = set};
    for (int a = 0; a < 3; a++)
        o->along[a] = set->task.grid.size[a] / set->tile + (set->task.grid.size[a] % set->tile != 0);
    o->record_of = malloc(set->tiles * sizeof *o->record_of);
    o->tiles = calloc(set->count + 1, sizeof *o->tiles);
    if (!o->record_of || !o->tiles || !add_labels(o, set->tiles + 1))
        return false;
    memset(o->record_of, 0xff, set->tiles * sizeof *o->record_of);
    for (size_t r = 0; r < set->count; r++)
        o->record_of[set->records[r].tile] = (uint32_t)r;
    return true;
}

void outside_labels_free(outside_labels *o)
{
    for (size_t r = 0; o->tiles && r < o->set->count; r++)
        for (int face = 0; face < 6; face++)
            free(o->tiles[r].faces[face]);
    free(o->record_of);
    free(o->tiles);
    free(o->parents);
}

size_t outside_face_cells(const tribox_window *w, int face)
{
    return (size_t)w->size[face < 2 ? 1 : 0] * w->size[face < 4 ? 2 : 1];
}

/* The tile beside a face; false at the border of the grid. */
static bool find_beside(const outside_labels *o, size_t tile, int face, size_t *beside)
{
    const size_t step[3] = {1, o->along[0], (size_t)o->along[0] * o->along[1]};
    const size_t at = tile / step[face / 2] % o->along[face / 2];
    if (face % 2 ? at + 1 == o->along[face / 2] : !at)
        return false;
    *beside = face % 2 ? tile + step[face / 2] : tile - step[face / 2];
    return true;
}

/* Across one face. Returns whether it is to be kept, as the tile beside it is not there yet. */
static bool join_face(outside_labels *o, size_t record, const tribox_window *w, int face, const uint32_t *labels)
{
    size_t beside = 0;
    const size_t cells = outside_face_cells(w, face);
    const uint32_t from = o->tiles[record].from;
    const bool is_within = find_beside(o, (size_t)o->set->records[record].tile, face, &beside);
    const uint32_t other = is_within ? o->record_of[beside] : NO_RECORD;
    if (other == NO_RECORD) {
        tribox_fill_join(o->parents, labels, from, NULL, is_within ? (uint32_t)beside + 1 : 0, cells);
        return false;
    }
    labelled_tile *const tile = &o->tiles[other];
    if (!tile->is_there)
        return true;
    tribox_fill_join(o->parents, labels, from, tile->faces[face ^ 1], tile->from, cells);
    free(tile->faces[face ^ 1]);
    tile->faces[face ^ 1] = NULL;
    return false;
}

bool outside_labels_add(outside_labels *o, size_t record, uint32_t *faces[6], uint32_t count)
{
    const tribox_window w = tile_cells_of(o->set, (size_t)o->set->records[record].tile);
    labelled_tile *const tile = &o->tiles[record];
    tile->from = (uint32_t)o->count;
    tile->count = count;
    if (!add_labels(o, count))
        return false;
    for (int face = 0; face < 6; face++)
        if (join_face(o, record, &w, face, faces[face])) {
            tile->faces[face] = faces[face];
            faces[face] = NULL;
        }
    tile->is_there = true;
    return true;
}

/* Of tiles without triangles: one label each. */
static void join_tiles(outside_labels *o, size_t tile)
{
    static const uint32_t one = 0;
    for (int face = 0; face < 6; face++) {
        size_t beside = 0;
        const bool is_within = find_beside(o, tile, face, &beside);
        if (!is_within || o->record_of[beside] == NO_RECORD)
            tribox_fill_join(o->parents, &one, (uint32_t)tile + 1, NULL, is_within ? (uint32_t)beside + 1 : 0, 1);
    }
}

/* A root is the least of its labels, so that of the outside is 0. */
void outside_labels_finish(outside_labels *o)
{
    for (size_t t = 0; t < o->set->tiles; t++)
        if (o->record_of[t] == NO_RECORD)
            join_tiles(o, t);
    for (size_t n = 0; n < o->count; n++)
        o->parents[n] = tribox_fill_root(o->parents, (uint32_t)n);
}
