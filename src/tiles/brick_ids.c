/* brick_ids.c - bricks handed on with their ids, which are taken out of those of the tile. */
#include "brick_call.h"

int tribox_brick_ids_take(void *call, const uint32_t at[3], const uint64_t bits[8])
{
    const tribox_bricks_call *const s = call;
    const tribox_window *const tile = &s->ids.tile;
    const size_t i = 8 * at[0] - tile->first[0], j = 8 * at[1] - tile->first[1], k = 8 * at[2] - tile->first[2];
    const size_t row = tile->size[0], layer = row * tile->size[1];
    const tribox_brick_rows rows = {s->ids.of_tile + k * layer + j * row + i, row, layer};
    s->plan.kernel->cells->take_ids(&rows, bits, s->ids.of_brick);
    return s->ids.sink.take(s->ids.sink.data, at, bits, s->ids.of_brick);
}
