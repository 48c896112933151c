/* cell_colours.c - finds the colour of a cell: its brick, and how many of that brick's cells come before it. */
#include "colours.h"

#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/system.h"
#include "write/voxels.h"

enum { SIDE = 8 };

static size_t place_of(const cell_colours *c, const uint32_t at[3])
{
    return ((size_t)at[2] * c->size[1] + at[1]) * c->size[0] + at[0];
}

rgb *cell_colours_add(cell_colours *c, const uint32_t at[3], const uint64_t bits[8], uint64_t cells)
{
    coloured_brick *const bricks = memory_grow(c->bricks, c->count + 1, &c->room, sizeof *bricks);
    c->bricks = bricks ? bricks : c->bricks;
    rgb *const of = bricks ? memory_grow(c->of, (size_t)(c->cells + cells), &c->cells_room, sizeof *of) : NULL;
    c->of = of ? of : c->of;
    if (!of)
        return NULL;
    coloured_brick *const b = &bricks[c->count++];
    *b = (coloured_brick){.at = {at[0], at[1], at[2]}, .first = c->cells};
    memcpy(b->bits, bits, sizeof b->bits);
    c->cells += cells;
    return of + b->first;
}

int cell_colours_make_palette(cell_colours *c, const char *path)
{
    if (!palette_make(c->of, c->cells, &c->palette))
        return message_failure("%s: out of memory for its palette", path);
    if (c->palette.place)
        message_say(
            "note: %s has the %d colours of its palette for more that its cells have: those close to one another are their mean",
            path, c->palette.count);
    return EXIT_CODE_OK;
}

bool cell_colours_place(cell_colours *c, const uint32_t cells[3])
{
    for (int a = 0; a < 3; a++)
        c->size[a] = (cells[a] + SIDE - 1) / SIDE;
    const size_t places = (size_t)c->size[0] * c->size[1] * c->size[2];
    c->number = c->count < UINT32_MAX ? malloc(places * sizeof *c->number) : NULL;
    if (!c->number)
        return false;
    memset(c->number, 0xff, places * sizeof *c->number);
    for (size_t b = 0; b < c->count; b++)
        c->number[place_of(c, c->bricks[b].at)] = (uint32_t)b;
    return true;
}

const rgb *cell_colours_of_brick(const cell_colours *c, const uint32_t at[3])
{
    return c->of + c->bricks[c->number[place_of(c, at)]].first;
}

rgb cell_colours_at(const cell_colours *c, const uint32_t cell[3])
{
    const uint32_t at[3] = {cell[0] / SIDE, cell[1] / SIDE, cell[2] / SIDE};
    const coloured_brick *const b = &c->bricks[c->number[place_of(c, at)]];
    const uint32_t k = cell[2] % SIDE, bit = SIDE * (cell[1] % SIDE) + cell[0] % SIDE;
    const uint64_t lower = b->bits[k] & ((UINT64_C(1) << bit) - 1);
    return c->of[b->first + voxels_count(b->bits, k) + voxels_count(&lower, 1)];
}

void cell_colours_free(cell_colours *c)
{
    free(c->bricks);
    free(c->of);
    free(c->number);
    palette_free(&c->palette);
    *c = (cell_colours){.count = 0};
}
