/* beam.c - which records of tiles are in each beam. */
#include "beam.h"

#include <stdlib.h>

static size_t along(const tile_set *set, int a)
{
    const uint32_t size = set->task.grid.size[a];
    return size / set->tile + (size % set->tile != 0);
}

bool beams_of(const tile_set *set, fill_cells cells, beams *b)
{
    *b = (beams){.set = set, .tiles = along(set, 0), .count = along(set, 1) * along(set, 2), .cells = cells};
    b->first = malloc((b->count + 1) * sizeof *b->first);
    size_t record = 0;
    for (size_t n = 0; b->first && n <= b->count; n++) {
        while (record < set->count && set->records[record].tile < n * b->tiles)
            record++;
        b->first[n] = record;
    }
    return b->first;
}

void beams_free(beams *b) { free(b->first); }
