/* fill_tiles.c - the two ways of filling tile by tile. */
#define _POSIX_C_SOURCE 200809L
#include "fill_tiles.h"

#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"
#include "write/voxels.h"

/* ---------------------------------------------------------------------------------------------------------- words and bricks */

enum { SIDE = 8 };

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

uint32_t tiles_along(const tile_set *set, int a)
{
    const uint32_t size = set->task.grid.size[a];
    return size / set->tile + (size % set->tile != 0);
}

tribox_window tile_cells_of(const tile_set *set, size_t t)
{
    const uint32_t *const size = set->task.grid.size;
    tribox_window w;
    for (int a = 0; a < 3; a++) {
        const uint32_t along = tiles_along(set, a);
        w.first[a] = (uint32_t)(t % along) * set->tile;
        w.size[a] = least(set->tile, size[a] - w.first[a]);
        t /= along;
    }
    return w;
}

/* Where bricks are laid: words of a window that begins at multiples of 8 cells. */
typedef struct tile_words {
    const tribox_window *window;
    uint64_t *words;
} tile_words;

static int lay_brick(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    (void)ids;
    const tile_words *const t = data;
    const uint32_t *const first = t->window->first;
    bricks_lay(t->window->size, t->words,
               (const uint32_t[3]){at[0] - first[0] / SIDE, at[1] - first[1] / SIDE, at[2] - first[2] / SIDE}, bits);
    return 0;
}

tribox_status tile_words_take(const tile_set *set, size_t from, size_t to, tile_room *room, const tribox_window *window,
                              uint64_t *words, tribox_report *report)
{
    memset(words, 0, tribox_window_words(window->size) * sizeof *words);
    return tile_set_run(set, from, to, room, &(tile_sink){lay_brick, &(tile_words){window, words}}, report);
}

/* The words of 64 x 8 x 8 cells: eight bricks side by side. Rows and layers beyond the cells are 0. */
typedef struct brick_row {
    uint64_t word[SIDE][SIDE]; /* of layer k and row j */
    uint64_t any, all;         /* bits of any word, and of all of them */
} brick_row;

static void read_words(const tile_cells *c, const uint64_t *words, size_t w, uint32_t j, uint32_t k, brick_row *b)
{
    const uint32_t rows = least(SIDE, c->window.size[1] - j), layers = least(SIDE, c->window.size[2] - k);
    memset(b, 0, sizeof *b);
    b->all = rows == SIDE && layers == SIDE ? ~UINT64_C(0) : 0;
    for (uint32_t z = 0; z < layers; z++)
        for (uint32_t y = 0; y < rows; y++) {
            b->word[z][y] = words ? words[((size_t)(k + z) * c->window.size[1] + j + y) * c->row_words + w] : ~UINT64_C(0);
            b->any |= b->word[z][y];
            b->all &= b->word[z][y];
        }
}

/* The cells from bit `from` on, up to eight. */
static bool cut_brick(const brick_row *b, uint32_t from, uint32_t cells, uint64_t bits[SIDE])
{
    const uint64_t mask = cells < SIDE ? (UINT64_C(1) << cells) - 1 : 0xff;
    uint64_t any = 0;
    if ((b->all >> from & mask) == 0xff) {
        memset(bits, 0xff, SIDE * sizeof *bits);
        return true;
    }
    for (int z = 0; z < SIDE; z++) {
        bits[z] = 0;
        for (int y = 0; y < SIDE; y++)
            bits[z] |= (b->word[z][y] >> from & mask) << SIDE * y;
        any |= bits[z];
    }
    return any != 0;
}

/* The bricks of eight rows in eight layers. */
static int cut_rows(const tile_cells *c, uint32_t j, uint32_t k, const filled_sink *sink, uint64_t *bricks)
{
    brick_row b = {.any = 0}, of_inside = {.any = 0};
    for (uint32_t i = 0; i < c->window.size[0]; i += SIDE) {
        const uint32_t at[3] = {(c->window.first[0] + i) / SIDE, (c->window.first[1] + j) / SIDE, (c->window.first[2] + k) / SIDE};
        const uint32_t bit = c->shift + i;
        uint64_t bits[SIDE], inside[SIDE];
        if (!i || bit % 64 == 0) {
            read_words(c, c->words, bit / 64, j, k, &b);
            if (c->inside)
                read_words(c, c->inside, bit / 64, j, k, &of_inside);
        }
        if (!b.any || !cut_brick(&b, bit % 64, c->window.size[0] - i, bits))
            continue;
        ++*bricks;
        if (sink && c->inside)
            cut_brick(&of_inside, bit % 64, c->window.size[0] - i, inside);
        if (sink && sink->take(sink->data, at, bits, c->inside ? inside : bits))
            return 1;
    }
    return 0;
}

/* The bricks that have a set cell, by z, then y, then x. Returns what the sink did, 0 to go on. */
static int cut_cells(const tile_cells *cells, const filled_sink *sink, uint64_t *bricks)
{
    int code = 0;
    for (uint32_t k = 0; k < cells->window.size[2] && !code; k += SIDE)
        for (uint32_t j = 0; j < cells->window.size[1] && !code; j += SIDE)
            code = cut_rows(cells, j, k, sink, bricks);
    return code;
}

/* --------------------------------------------------------------------------------------------------------------------- beams */

static bool beams_of(const tile_set *set, fill_cells cells, beams *b)
{
    *b = (beams){.set = set, .tiles = tiles_along(set, 0), .cells = cells};
    b->count = (size_t)tiles_along(set, 1) * tiles_along(set, 2);
    b->first = malloc((b->count + 1) * sizeof *b->first);
    size_t record = 0;
    for (size_t n = 0; b->first && n <= b->count; n++) {
        while (record < set->count && set->records[record].tile < n * b->tiles)
            record++;
        b->first[n] = record;
    }
    return b->first;
}

typedef struct beam_job {
    const beams *beams;
    const beam_filling *filling;
    void *about;
    const filled_sink *sink;
    progress *bar;
    beam_found found;
} beam_job;

/* Where a beam is filled. */
typedef struct beam_place {
    const beam_filling *filling;
    void *room;
    beam_solid solid;
    beam_found found;
} beam_place;

static void end_place(void *place)
{
    beam_place *const p = place;
    if (p->room)
        p->filling->end(p->room);
    free(p->room);
    free(p->solid.tiles);
}

static bool begin_place(void *data, void *place)
{
    beam_job *const j = data;
    beam_place *const p = place;
    p->filling = j->filling;
    p->solid.tiles = malloc(j->beams->tiles * sizeof *p->solid.tiles);
    p->room = calloc(1, j->filling->room_bytes);
    return p->solid.tiles && p->room && j->filling->start(j->about, p->room);
}

static int fill_beam(void *data, void *place, size_t beam)
{
    const beam_job *const j = data;
    beam_place *const p = place;
    p->solid.count = 0;
    p->found = (beam_found){.bricks = 0};
    return (int)j->filling->fill(j->about, p->room, beam, &p->solid, &p->found);
}

static int hand_on(void *data, void *place, size_t beam)
{
    beam_job *const j = data;
    beam_place *const p = place;
    for (size_t n = 0; n < p->solid.count; n++)
        if (cut_cells(&p->solid.tiles[n], j->sink, &p->found.bricks))
            return TRIBOX_STOPPED;
    j->found.report.overlapping += p->found.report.overlapping;
    j->found.report.undecided += p->found.report.undecided;
    j->found.bricks += p->found.bricks;
    j->found.inside += p->found.inside;
    j->found.odd_rows += p->found.odd_rows;
    progress_tell(j->bar, (double)(beam + 1) / (double)j->beams->count);
    return 0;
}

static int fill_beams(beam_job *j, unsigned threads)
{
    const crew_work work = {.threads = threads,
                            .count = j->beams->count,
                            .is_told_in_order = true,
                            .place_bytes = sizeof(beam_place),
                            .begin = begin_place,
                            .end = end_place,
                            .step = fill_beam,
                            .tell = hand_on};
    return crew_do(&work, j);
}

tribox_status fill_tiles(const tile_set *set, const double x[2], fill_cells cells, unsigned threads, const filled_sink *sink,
                         progress *bar, beam_found *found)
{
    beams b;
    beam_job j = {.beams = &b, .filling = x ? &beam_parity : &beam_outside, .sink = sink, .bar = bar};
    *found = j.found;
    if (!beams_of(set, cells, &b))
        return MESSAGE_NO_MEMORY;
    int status = (int)j.filling->open(&b, x, threads, bar, &j.about);
    if (!status)
        status = fill_beams(&j, threads);
    j.filling->close(j.about);
    free(b.first);
    *found = j.found;
    return (tribox_status)status;
}
