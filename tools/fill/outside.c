/*
 * outside.c - what the outside does not reach: threads label the free cells of tiles, labels are joined as tiles come, a face being
 * kept until the tile on its other side is there, and then tiles are filled beam by beam.
 */
#define _POSIX_C_SOURCE 200809L
#include "fill_tiles.h"

#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/system.h"
#include "tribox_threads.h"

/* ----------------------------------------------------------------------------------------------------------------------- labels */

/* The labels of a record's tile among all, and its faces until the tiles beside them are there. */
typedef struct labelled_tile {
    uint32_t from, count;
    bool is_there;
    uint32_t *faces[6];
} labelled_tile;

/* Label 0 is the outside, 1 + t that of tile t if it has no triangles; labels of other tiles follow. */
typedef struct outside {
    const beams *beams;
    const tile_set *set;
    progress *bar;
    uint32_t along[3];    /* tiles */
    uint32_t *record_of;  /* each tile's; NO_RECORD without triangles */
    labelled_tile *tiles; /* of records */
    uint32_t *parents;
    size_t count, room; /* labels */
} outside;

#define NO_RECORD UINT32_MAX

static const size_t labels_most = UINT32_MAX - 1;

/* Room for `more` labels, each the parent of itself. */
static bool add_labels(outside *o, size_t more)
{
    if (more > labels_most - o->count)
        return false;
    uint32_t *const parents = memory_grow(o->parents, o->count + more, &o->room, sizeof *parents);
    if (!parents)
        return false;
    o->parents = parents;
    for (size_t n = 0; n < more; n++, o->count++)
        o->parents[o->count] = (uint32_t)o->count;
    return true;
}

/* False where there is no memory. */
static bool labels_start(outside *o)
{
    const tile_set *const set = o->set;
    for (int a = 0; a < 3; a++)
        o->along[a] = tiles_along(set, a);
    o->record_of = malloc(set->tiles * sizeof *o->record_of);
    o->tiles = calloc(set->count + 1, sizeof *o->tiles);
    if (!o->record_of || !o->tiles || !add_labels(o, set->tiles + 1))
        return false;
    memset(o->record_of, 0xff, set->tiles * sizeof *o->record_of);
    for (size_t r = 0; r < set->count; r++)
        o->record_of[set->records[r].tile] = (uint32_t)r;
    return true;
}

static size_t face_cells(const tribox_window *w, int face) { return (size_t)w->size[face < 2 ? 1 : 0] * w->size[face < 4 ? 2 : 1]; }

/* The tile beside a face; false at the border of the grid. */
static bool find_beside(const outside *o, size_t tile, int face, size_t *beside)
{
    const size_t step[3] = {1, o->along[0], (size_t)o->along[0] * o->along[1]};
    const size_t at = tile / step[face / 2] % o->along[face / 2];
    if (face % 2 ? at + 1 == o->along[face / 2] : !at)
        return false;
    *beside = face % 2 ? tile + step[face / 2] : tile - step[face / 2];
    return true;
}

/* Across one face. Returns whether it is to be kept, as the tile beside it is not there yet. */
static bool join_face(outside *o, size_t record, const tribox_window *w, int face, const uint32_t *labels)
{
    size_t beside = 0;
    const size_t cells = face_cells(w, face);
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

/*
 * Adds a record's tile: its faces, of which those that are kept are taken over and NULL then. One thread at a time. False where
 * there is no memory, or no number is left.
 */
static bool labels_add(outside *o, size_t record, uint32_t *faces[6], uint32_t count)
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
static void join_tiles(outside *o, size_t tile)
{
    static const uint32_t one = 0;
    for (int face = 0; face < 6; face++) {
        size_t beside = 0;
        const bool is_within = find_beside(o, tile, face, &beside);
        if (!is_within || o->record_of[beside] == NO_RECORD)
            tribox_fill_join(o->parents, &one, (uint32_t)tile + 1, NULL, is_within ? (uint32_t)beside + 1 : 0, 1);
    }
}

/* When all are added: joins the tiles without triangles. A root is the least of its labels, so that of the outside is 0. */
static void labels_finish(outside *o)
{
    for (size_t t = 0; t < o->set->tiles; t++)
        if (o->record_of[t] == NO_RECORD)
            join_tiles(o, t);
    for (size_t n = 0; n < o->count; n++)
        o->parents[n] = tribox_fill_root(o->parents, (uint32_t)n);
}

/* Whether the outside reaches the cells of a label, and all of a tile without triangles. */
static bool has_label(const outside *o, uint32_t label) { return o->parents[label] == 0; }
static bool has_tile(const outside *o, size_t tile) { return has_label(o, (uint32_t)tile + 1); }

/* ---------------------------------------------------------------------------------------------------------------------- threads */

/* Of a thread: a tile, and for the second pass the tiles of a beam. */
typedef struct outside_room {
    tile_room *tile;
    uint64_t *surface;
    void *scratch;
    uint64_t *solid; /* `most` tiles; two for each where the inside is asked for, the second the inside */
    size_t most;
    uint64_t *mask; /* of labels */
    size_t mask_words;
    uint32_t *faces[6], labels; /* of the tile, in the first pass */
} outside_room;

static size_t tile_word_count(const tile_set *set) { return tribox_mask_words(set->tile) * set->tile * set->tile; }

static void free_faces(outside_room *r)
{
    for (int face = 0; face < 6; face++) {
        free(r->faces[face]);
        r->faces[face] = NULL;
    }
}

static void end_room(void *data)
{
    outside_room *const r = data;
    free_faces(r);
    tile_room_free(r->tile);
    free(r->surface);
    free(r->scratch);
    free(r->solid);
    free(r->mask);
}

static bool start_room(void *about, void *room)
{
    const outside *const o = about;
    const tile_set *const set = o->set;
    outside_room *const r = room;
    r->tile = tile_room_new(set, 0, set->count);
    r->surface = malloc(tile_word_count(set) * sizeof *r->surface);
    r->scratch = malloc(tribox_fill_labels_bytes((const uint32_t[3]){set->tile, set->tile, set->tile}));
    return r->tile && r->surface && r->scratch;
}

/* ------------------------------------------------------------------------------------------------------------------- first pass */

static int label_tile(void *data, void *place, size_t record)
{
    const outside *const o = data;
    const tile_set *const set = o->set;
    outside_room *const r = place;
    const tribox_window w = tile_cells_of(set, (size_t)set->records[record].tile);
    tribox_report report;
    tribox_status status = TRIBOX_OK;
    for (int face = 0; face < 6; face++) {
        r->faces[face] = malloc(face_cells(&w, face) * sizeof *r->faces[face]);
        status = r->faces[face] ? status : MESSAGE_NO_MEMORY;
    }
    if (!status)
        status = tile_words_take(set, record, record + 1, r->tile, &w, r->surface, &report);
    return status ? (int)status : (int)tribox_fill_labels(w.size, r->surface, r->scratch, r->faces, &r->labels);
}

static int add_tile(void *data, void *place, size_t record)
{
    outside *const o = data;
    outside_room *const r = place;
    const bool is_added = labels_add(o, record, r->faces, r->labels);
    free_faces(r);
    progress_tell(o->bar, (double)(record + 1) / (double)o->set->count);
    return is_added ? 0 : (int)MESSAGE_NO_MEMORY;
}

static tribox_status open_outside(const beams *b, const double x[2], unsigned threads, progress *bar, void **about)
{
    const crew_work work = {.threads = threads,
                            .count = b->set->count,
                            .place_bytes = sizeof(outside_room),
                            .begin = start_room,
                            .end = end_room,
                            .step = label_tile,
                            .tell = add_tile};
    outside *const o = calloc(1, sizeof *o);
    (void)x;
    *about = o;
    if (!o)
        return MESSAGE_NO_MEMORY;
    *o = (outside){.beams = b, .set = b->set, .bar = bar};
    const int status = labels_start(o) ? crew_do(&work, o) : (int)MESSAGE_NO_MEMORY;
    if (!status)
        labels_finish(o);
    return (tribox_status)status;
}

static void close_outside(void *about)
{
    outside *const o = about;
    if (!o)
        return;
    for (size_t r = 0; o->tiles && r < o->set->count; r++)
        for (int face = 0; face < 6; face++)
            free(o->tiles[r].faces[face]);
    free(o->record_of);
    free(o->tiles);
    free(o->parents);
    free(o);
}

/* ------------------------------------------------------------------------------------------------------------------ second pass */

static size_t cells_of(const tribox_window *w) { return (size_t)w->size[0] * w->size[1] * w->size[2]; }

static void *more_room(void *had, size_t *count, size_t wanted, size_t size)
{
    void *const grown = wanted > *count ? realloc(had, wanted * size) : had;
    *count = grown && wanted > *count ? wanted : *count;
    return grown;
}

/* The labels of a record that the outside reaches. */
static bool find_outside(const outside *o, size_t record, outside_room *r)
{
    const labelled_tile *const tile = &o->tiles[record];
    const size_t words = tribox_mask_words(tile->count) + 1;
    uint64_t *const mask = more_room(r->mask, &r->mask_words, words, sizeof *mask);
    if (!mask)
        return false;
    r->mask = mask;
    memset(mask, 0, words * sizeof *mask);
    for (uint32_t n = 0; n < tile->count; n++)
        mask[n / 64] |= (uint64_t)has_label(o, tile->from + n) << n % 64;
    return true;
}

static tribox_status fill_tile(const outside *o, size_t record, const tribox_window *w, outside_room *r, uint64_t *solid,
                               beam_found *found)
{
    uint32_t *const no_faces[6] = {NULL}, count = 0;
    tribox_report report = {0, 0};
    size_t inside = 0;
    tribox_status status = tile_words_take(o->set, record, record + 1, r->tile, w, r->surface, &report);
    if (!status)
        status = tribox_fill_labels(w->size, r->surface, r->scratch, no_faces, &count);
    if (!status && !find_outside(o, record, r))
        status = MESSAGE_NO_MEMORY;
    if (!status)
        status = tribox_fill_labelled(w->size, r->surface, r->scratch, r->mask, solid, &inside);
    found->report.overlapping += report.overlapping;
    found->report.undecided += report.undecided;
    found->inside += inside;
    return status;
}

static void add_cells(beam_solid *solid, const tribox_window *w, const uint64_t *words, const uint64_t *inside)
{
    solid->tiles[solid->count++] = (tile_cells){*w, words, inside, tribox_mask_words(w->size[0]), 0};
}

/* The cells of a tile that go on. inside: room for them where they are asked for. */
static void add_tile_cells(beam_solid *to, const tribox_window *w, fill_cells cells, const uint64_t *surface, const uint64_t *solid,
                           uint64_t *inside)
{
    const size_t words = tribox_window_words(w->size);
    if (cells != FILL_CELLS_ALL) {
        memcpy(inside, surface, words * sizeof *inside);
        fill_keep_inside(inside, solid, words);
    }
    add_cells(to, w, cells == FILL_CELLS_INSIDE ? inside : solid, cells == FILL_CELLS_LABELLED ? inside : NULL);
}

static tribox_status fill_beam(const void *about, void *room, size_t beam, beam_solid *solid, beam_found *found)
{
    const outside *const o = about;
    const tile_set *const set = o->set;
    outside_room *const r = room;
    const size_t records = o->beams->first[beam + 1] - o->beams->first[beam];
    const fill_cells cells = o->beams->cells;
    const size_t words = tile_word_count(set) * (cells == FILL_CELLS_ALL ? 1 : 2);
    uint64_t *to = records ? more_room(r->solid, &r->most, records, words * sizeof *to) : NULL;
    if (records && !to)
        return MESSAGE_NO_MEMORY;
    r->solid = records ? to : r->solid;
    for (size_t t = beam * o->beams->tiles; t < (beam + 1) * o->beams->tiles; t++) {
        const tribox_window w = tile_cells_of(set, t);
        const uint32_t record = o->record_of[t];
        if (record != NO_RECORD) {
            const tribox_status status = fill_tile(o, record, &w, r, to, found);
            if (status)
                return status;
            add_tile_cells(solid, &w, cells, r->surface, to, to + words / 2);
            to += words;
        } else if (!has_tile(o, t)) {
            add_cells(solid, &w, NULL, NULL);
            found->inside += cells_of(&w);
        }
    }
    return TRIBOX_OK;
}

const beam_filling beam_outside = {open_outside, close_outside, sizeof(outside_room), start_room, fill_beam, end_room};
