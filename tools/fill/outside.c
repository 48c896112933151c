/* outside.c - labels tiles by several threads, then fills them beam by beam. */
#define _POSIX_C_SOURCE 200809L
#include "outside.h"

#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "tribox_threads.h"

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
    if (r->tile)
        tile_room_free(r->tile);
    free(r->surface);
    free(r->scratch);
    free(r->solid);
    free(r->mask);
    free(r);
}

static void *start_room(const void *about)
{
    const outside *const o = about;
    const tile_set *const set = o->beams->set;
    outside_room *const r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->tile = tile_room_new(set, 0, set->count);
    r->surface = malloc(tile_word_count(set) * sizeof *r->surface);
    r->scratch = malloc(tribox_fill_labels_bytes((const uint32_t[3]){set->tile, set->tile, set->tile}));
    if (r->tile && r->surface && r->scratch)
        return r;
    end_room(r);
    return NULL;
}

/* ------------------------------------------------------------------------------------------------------------------- first pass */

typedef struct labelling {
    outside *o;
    progress *bar;
} labelling;

static void *start_labelling(void *data)
{
    const labelling *const l = data;
    return start_room(l->o);
}

static int label_tile(void *data, void *place, size_t record)
{
    const labelling *const l = data;
    const tile_set *const set = l->o->beams->set;
    outside_room *const r = place;
    const tribox_window w = tile_cells_of(set, (size_t)set->records[record].tile);
    tribox_report report;
    tribox_status status = TRIBOX_OK;
    for (int face = 0; face < 6; face++) {
        r->faces[face] = malloc(outside_face_cells(&w, face) * sizeof *r->faces[face]);
        status = r->faces[face] ? status : MESSAGE_NO_MEMORY;
    }
    if (!status)
        status = tile_words_take(set, record, record + 1, r->tile, &(tile_words){w, r->surface}, &report);
    return status ? (int)status : (int)tribox_fill_labels(w.size, r->surface, r->scratch, r->faces, &r->labels);
}

static int add_tile(void *data, void *place, size_t record)
{
    const labelling *const l = data;
    outside_room *const r = place;
    const bool is_added = outside_labels_add(&l->o->labels, record, r->faces, r->labels);
    free_faces(r);
    progress_tell(l->bar, (double)(record + 1) / (double)l->o->beams->set->count);
    return is_added ? 0 : (int)MESSAGE_NO_MEMORY;
}

tribox_status outside_start(const beams *b, unsigned threads, progress *bar, outside *o)
{
    const crew_work work = {.threads = threads,
                            .count = b->set->count,
                            .begin = start_labelling,
                            .end = end_room,
                            .step = label_tile,
                            .tell = add_tile};
    o->beams = b;
    const int status = outside_labels_start(b->set, &o->labels) ? crew_do(&work, &(labelling){o, bar}) : (int)MESSAGE_NO_MEMORY;
    if (!status)
        outside_labels_finish(&o->labels);
    return (tribox_status)status;
}

void outside_end(outside *o) { outside_labels_free(&o->labels); }

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
    const labelled_tile *const tile = &o->labels.tiles[record];
    const size_t words = tribox_mask_words(tile->count) + 1;
    uint64_t *const mask = more_room(r->mask, &r->mask_words, words, sizeof *mask);
    if (!mask)
        return false;
    r->mask = mask;
    memset(mask, 0, words * sizeof *mask);
    for (uint32_t n = 0; n < tile->count; n++)
        mask[n / 64] |= (uint64_t)outside_has_label(&o->labels, tile->from + n) << n % 64;
    return true;
}

static tribox_status fill_tile(const outside *o, size_t record, const tribox_window *w, outside_room *r, uint64_t *solid,
                               beam_found *found)
{
    uint32_t *const no_faces[6] = {NULL}, count = 0;
    tribox_report report = {0, 0};
    size_t inside = 0;
    tribox_status status = tile_words_take(o->beams->set, record, record + 1, r->tile, &(tile_words){*w, r->surface}, &report);
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
    tile_cells *const to = &solid->tiles[solid->count++];
    *to = (tile_cells){.words = words, .inside = inside, .row_words = tribox_mask_words(w->size[0])};
    for (int a = 0; a < 3; a++) {
        to->first[a] = w->first[a];
        to->size[a] = w->size[a];
    }
}

/* The cells of a tile that go on. inside: room for them where they are asked for. */
static void add_tile_cells(beam_solid *to, const tribox_window *w, fill_cells cells, const uint64_t *surface, const uint64_t *solid,
                           uint64_t *inside)
{
    const size_t words = tribox_window_words(w->size);
    if (cells != FILL_CELLS_ALL) {
        memcpy(inside, surface, words * sizeof *inside);
        beam_keep_inside(inside, solid, words);
    }
    add_cells(to, w, cells == FILL_CELLS_INSIDE ? inside : solid, cells == FILL_CELLS_LABELLED ? inside : NULL);
}

static tribox_status fill_beam(const void *about, void *room, size_t beam, beam_solid *solid, beam_found *found)
{
    const outside *const o = about;
    const tile_set *const set = o->beams->set;
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
        const uint32_t record = o->labels.record_of[t];
        if (record != NO_RECORD) {
            const tribox_status status = fill_tile(o, record, &w, r, to, found);
            if (status)
                return status;
            add_tile_cells(solid, &w, cells, r->surface, to, to + words / 2);
            to += words;
        } else if (!outside_has_tile(&o->labels, t)) {
            add_cells(solid, &w, NULL, NULL);
            found->inside += cells_of(&w);
        }
    }
    return TRIBOX_OK;
}

beam_filling outside_filling(const outside *o) { return (beam_filling){o, start_room, fill_beam, end_room}; }
