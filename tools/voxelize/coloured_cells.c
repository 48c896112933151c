/*
 * coloured_cells.c - tiles by threads, whose bricks come in one order, with the ids of their cells: colours are looked up by these.
 */
#define _POSIX_C_SOURCE 200809L
#include "coloured_cells.h"

#include <string.h>

#include "console/memory.h"
#include "console/message.h"
#include "tile_crew.h"
#include "write/brick_cutter.h"

typedef struct colouring {
    const tribox_grid *grid;
    const mesh_colours *colours;
    uint64_t *words;
    cell_colours *to;
    size_t room, cells_room;
} colouring;

static bool make_room(colouring *c, uint64_t cells)
{
    cell_colours *const to = c->to;
    void *const bricks = memory_grow(to->bricks, to->count + 1, &c->room, sizeof *to->bricks);
    to->bricks = bricks ? bricks : to->bricks;
    void *const of = bricks ? memory_grow(to->of, (size_t)(to->cells + cells), &c->cells_room, sizeof *to->of) : NULL;
    to->of = of ? of : to->of;
    return of;
}

static int take_brick(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    colouring *const c = data;
    cell_colours *const to = c->to;
    const uint64_t cells = voxels_count(bits, 8);
    if (!make_room(c, cells))
        return 1;
    coloured_brick *const b = &to->bricks[to->count++];
    *b = (coloured_brick){.at = {at[0], at[1], at[2]}, .first = to->cells};
    memcpy(b->bits, bits, sizeof b->bits);
    for (uint64_t n = 0; n < cells; n++)
        to->of[to->cells++] = c->colours->of[ids[n]];
    bricks_lay(c->grid, c->words, at, bits);
    return 0;
}

static int run(const tile_set *set, unsigned threads, colouring *c, progress *bar, tribox_report *report)
{
    tile_found found;
    const tribox_status status = tile_crew_run(set, 0, set->count, threads, &(tile_sink){take_brick, c}, bar, &found);
    *report = found.report;
    if (status && status != TRIBOX_STOPPED)
        return message_status(status);
    return !status && cell_colours_place(c->to, set->task.grid.size)
               ? EXIT_CODE_OK
               : message_failure("out of memory for the colours of the cells");
}

int coloured_cells_make(const voxel_task *task, const mesh_colours *colours, unsigned threads, uint64_t *words, cell_colours *cells,
                        progress *bar, tribox_report *report)
{
    tile_set set;
    *cells = (cell_colours){.count = 0};
    int code = tile_set_of_task(task, false, threads, &set);
    if (code)
        return code;
    colouring c = {.grid = &task->grid, .colours = colours, .words = words, .to = cells};
    code = run(&set, threads, &c, bar, report);
    tile_set_free(&set);
    if (code)
        cell_colours_free(cells);
    return code;
}
