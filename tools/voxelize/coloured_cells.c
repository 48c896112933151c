/* coloured_cells.c - tiles by threads, each into bricks of its own, which are put together in the order of the tiles. */
#define _POSIX_C_SOURCE 200809L
#include "coloured_cells.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "write/brick_cutter.h"
#include "write/lowest_bit.h"
#include "write/voxels.h"

/* The bricks of a tile, and room for more. */
typedef struct coloured_tile {
    coloured_brick *bricks;
    rgb *of;
    size_t count, room;
    size_t cells, cells_room;
} coloured_tile;

typedef struct colouring {
    const tile_set *set;
    const mesh_colours *colours;
    uint64_t *words;
    coloured_tile *tiles; /* one for each record of the set */
    progress *bar;
    pthread_mutex_t lock; /* of what follows */
    size_t next, done;
    tribox_report report;
    tribox_status status; /* the first that is not OK ends the work */
} colouring;

/* What takes the bricks of a tile. */
typedef struct taker {
    const colouring *c;
    coloured_tile *tile;
} taker;

static bool grow(void **list, size_t needed, size_t *room, size_t size)
{
    if (needed <= *room)
        return true;
    const size_t more = needed > 2 * *room ? needed : 2 * *room;
    void *const grown = realloc(*list, more * size);
    if (!grown)
        return false;
    *list = grown;
    *room = more;
    return true;
}

static bool make_room(coloured_tile *t, size_t cells)
{
    void *bricks = t->bricks, *of = t->of;
    const bool has_room =
        grow(&bricks, t->count + 1, &t->room, sizeof *t->bricks) && grow(&of, t->cells + cells, &t->cells_room, sizeof *t->of);
    t->bricks = bricks;
    t->of = of;
    return has_room;
}

/* Tiles begin with words, so that no two threads write to one. */
static int take_brick(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    const taker *const to = data;
    coloured_tile *const t = to->tile;
    if (!make_room(t, (size_t)voxels_count(bits, 8)))
        return 1;
    coloured_brick *const b = &t->bricks[t->count++];
    *b = (coloured_brick){.at = {at[0], at[1], at[2]}, .first = t->cells};
    memcpy(b->bits, bits, sizeof b->bits);
    for (unsigned k = 0; k < 8; k++)
        for (uint64_t word = bits[k]; word; word &= word - 1)
            t->of[t->cells++] = to->c->colours->of[ids[64 * k + lowest_bit(word)]];
    bricks_lay(&to->c->set->task.grid, to->c->words, at, bits);
    return 0;
}

static tribox_status run_tile(const colouring *c, size_t record, void *scratch, tribox_report *report)
{
    const tile_set *const set = c->set;
    const voxel_task *const t = &set->task;
    const tribox_tiles tiles = {set->tile, (size_t)set->records[record].tile, 1};
    const size_t *const starts = set->starts + tiles.first;
    taker to = {c, &c->tiles[record]};
    const tribox_ids_sink sink = {take_brick, &to};
    const tribox_status status =
        t->soup ? tribox_bricks_ids(t->soup, &t->grid, &tiles, starts, set->list, t->options, scratch, &sink, report)
                : tribox_mesh_bricks_ids(t->mesh, &t->grid, &tiles, starts, set->list, t->options, scratch, &sink, report);
    return status == TRIBOX_STOPPED ? MESSAGE_NO_MEMORY : status;
}

static bool take_record(colouring *c, size_t *record)
{
    pthread_mutex_lock(&c->lock);
    *record = c->next;
    const bool is_there = !c->status && c->next < c->set->count;
    c->next += is_there;
    pthread_mutex_unlock(&c->lock);
    return is_there;
}

static void tell(colouring *c, tribox_status status, const tribox_report *found)
{
    pthread_mutex_lock(&c->lock);
    c->status = c->status ? c->status : status;
    c->report.overlapping += found->overlapping;
    c->report.undecided += found->undecided;
    c->done++;
    progress_tell(c->bar, (double)c->done / (double)c->set->count);
    pthread_mutex_unlock(&c->lock);
}

/* A thread without memory leaves the work to the others; the first has to have it. */
static void work(void *data, unsigned thread)
{
    colouring *const c = data;
    void *const scratch = malloc(tribox_bricks_ids_bytes(c->set->tile));
    if (!scratch && !thread)
        tell(c, MESSAGE_NO_MEMORY, &(tribox_report){0, 0});
    for (size_t record; scratch && take_record(c, &record);) {
        tribox_report found = {0, 0};
        const tribox_status status = run_tile(c, record, scratch, &found);
        tell(c, status, &found);
    }
    free(scratch);
}

static void free_tiles(colouring *c)
{
    for (size_t r = 0; c->tiles && r < c->set->count; r++) {
        free(c->tiles[r].bricks);
        free(c->tiles[r].of);
    }
    free(c->tiles);
}

/* Tile after tile goes over, and its memory is given back. */
static bool join(colouring *c, cell_colours *to)
{
    for (size_t r = 0; r < c->set->count; r++) {
        to->count += c->tiles[r].count;
        to->cells += c->tiles[r].cells;
    }
    to->bricks = malloc((to->count + 1) * sizeof *to->bricks);
    to->of = malloc((size_t)(to->cells + 1) * sizeof *to->of);
    if (!to->bricks || !to->of)
        return false;
    uint64_t bricks = 0, cells = 0;
    for (size_t r = 0; r < c->set->count; r++) {
        coloured_tile *const t = &c->tiles[r];
        for (size_t b = 0; b < t->count; b++) {
            to->bricks[bricks] = t->bricks[b];
            to->bricks[bricks++].first += cells;
        }
        if (t->cells)
            memcpy(to->of + cells, t->of, t->cells * sizeof *t->of);
        cells += t->cells;
        free(t->bricks);
        free(t->of);
        *t = (coloured_tile){.count = 0};
    }
    return cell_colours_place(to, c->set->task.grid.size);
}

static int run(colouring *c, unsigned threads, cell_colours *cells)
{
    c->tiles = calloc(c->set->count + 1, sizeof *c->tiles);
    if (!c->tiles)
        return message_failure("out of memory for the colours of the cells");
    pthread_mutex_init(&c->lock, NULL);
    crew_run(threads, work, c);
    pthread_mutex_destroy(&c->lock);
    if (c->status && c->status != MESSAGE_NO_MEMORY)
        return message_status(c->status);
    return !c->status && join(c, cells) ? EXIT_CODE_OK : message_failure("out of memory for the colours of the cells");
}

int coloured_cells_make(const voxel_task *task, const mesh_colours *colours, unsigned threads, uint64_t *words, cell_colours *cells,
                        progress *bar, tribox_report *report)
{
    tile_set set;
    *cells = (cell_colours){.count = 0};
    int code = tile_set_of_task(task, false, threads, &set);
    if (code)
        return code;
    colouring c = {.set = &set, .colours = colours, .words = words, .bar = bar};
    code = run(&c, threads, cells);
    free_tiles(&c);
    tile_set_free(&set);
    if (code)
        cell_colours_free(cells);
    *report = c.report;
    return code;
}
