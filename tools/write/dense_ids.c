/* dense_ids.c - an id for each cell of a dense format, int32, -1 where no cell is set: all in memory until they are written. */
#include <stdlib.h>

#include "brick_writer.h"
#include "console/memory.h"
#include "console/message.h"
#include "lowest_bit.h"
#include "read/little.h"

static uint64_t cells_of(const tribox_grid *grid) { return (uint64_t)grid->size[0] * grid->size[1] * grid->size[2]; }

static int open_ids(brick_out *out)
{
    char needed[16], there[16];
    const uint64_t cells = cells_of(&out->cells.grid), available = memory_available();
    if (cells > available / sizeof(int32_t))
        return message_failure("%s: the ids of all cells take %s of memory in this format and %s are available; write .npz or .vdb",
                               out->file->path, memory_text(cells * sizeof(int32_t), needed), memory_text(available, there));
    int32_t *const ids = malloc(cells * sizeof *ids);
    if (!ids)
        return message_failure("%s: out of memory for its ids", out->file->path);
    for (uint64_t c = 0; c < cells; c++)
        ids[c] = -1;
    out->state = ids;
    out->cells.ids = ids;
    return EXIT_CODE_OK;
}

static int put_ids(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    int32_t *const ids = out->state;
    const uint32_t *const size = out->cells.grid.size, *from = out->ids;
    for (uint32_t k = 0; k < 8; k++)
        for (uint64_t word = bits[k]; word; word &= word - 1) {
            const uint32_t bit = lowest_bit(word);
            const size_t row = (size_t)(8 * at[2] + k) * size[1] + 8 * at[1] + bit / 8;
            ids[row * size[0] + 8 * at[0] + bit % 8] = (int32_t)*from++;
        }
    return EXIT_CODE_OK;
}

static int end_ids(brick_out *out, progress *bar)
{
    enum { CHUNK = 1 << 12 };
    unsigned char bytes[4 * CHUNK];
    const int32_t *const ids = out->state;
    const volume_frame *const frame = out->format->frame;
    const uint64_t cells = cells_of(&out->cells.grid);
    if (frame->before)
        frame->before(out->to, &out->cells);
    for (uint64_t c = 0, count; c < cells && !ferror(out->to); c += count) {
        count = cells - c < CHUNK ? cells - c : CHUNK;
        for (uint64_t n = 0; n < count; n++)
            little_put32(bytes + 4 * n, (uint32_t)ids[c + n]);
        fwrite(bytes, 4, (size_t)count, out->to);
        progress_tell(bar, (double)(c + count) / (double)cells);
    }
    if (frame->after)
        frame->after(out->to);
    return EXIT_CODE_OK;
}

static void drop_ids(brick_out *out) { free(out->state); }

const brick_writer dense_ids = {.open = open_ids, .put = put_ids, .end = end_ids, .drop = drop_ids};
