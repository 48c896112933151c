/* gather.c - cells that a format needs all at once, in memory until all bricks are there: their words, or an id of each. */
#include <stdlib.h>

#include "brick_out.h"
#include "console/system.h"
#include "console/message.h"
#include "read/little.h"

typedef struct gathering {
    voxels_slab slab;
    uint64_t *words, *inside; /* inside: NULL without labels */
    int32_t *ids;
} gathering;

static uint64_t cells_of(const tribox_grid *grid) { return (uint64_t)grid->size[0] * grid->size[1] * grid->size[2]; }

void gather_drop(brick_out *out)
{
    gathering *const g = out->state;
    free(g->words);
    free(g->inside);
    free(g->ids);
    free(g);
}

/* Refuses so many bytes for each of so many, `what`, where they do not fit into memory. */
static int begin(brick_out *out, uint64_t count, uint64_t bytes, const char *what)
{
    char needed[16], there[16];
    const uint32_t *const size = out->cells.grid.size;
    const uint64_t available = memory_available();
    if (count > available / bytes)
        return message_failure("%s: %s%u x %u x %u cells take %s of memory in this format and %s are available; write .npz or .vdb",
                               out->file->path, what, size[0], size[1], size[2], memory_text(count * bytes, needed),
                               memory_text(available, there));
    out->state = calloc(1, sizeof(gathering));
    return out->state ? EXIT_CODE_OK : message_failure("%s: out of memory", out->file->path);
}

static int lack_memory(brick_out *out)
{
    gather_drop(out);
    return message_failure("%s: out of memory for its cells", out->file->path);
}

int gather_open(brick_out *out)
{
    const tribox_grid *const grid = &out->cells.grid;
    const uint64_t words = (uint64_t)voxels_layer_words(grid) * grid->size[2];
    const bool has_labels = out->options.has_labels;
    const int code = begin(out, words, sizeof(uint64_t) * (has_labels ? 2 : 1), "");
    if (code)
        return code;
    gathering *const g = out->state;
    g->words = calloc(words, sizeof *g->words);
    g->inside = has_labels ? calloc(words, sizeof *g->inside) : NULL;
    if (!g->words || (has_labels && !g->inside))
        return lack_memory(out);
    g->slab = (voxels_slab){.layers = grid->size[2], .bits = g->words, .inside = g->inside};
    out->cells.slab = &g->slab;
    out->cells.slabs = 1;
    return EXIT_CODE_OK;
}

int gather_put(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    const gathering *const g = out->state;
    bricks_lay(&out->cells.grid, g->words, at, bits);
    if (g->inside)
        bricks_lay(&out->cells.grid, g->inside, at, out->inside);
    return EXIT_CODE_OK;
}

static int open_ids(brick_out *out)
{
    const uint64_t cells = cells_of(&out->cells.grid);
    const int code = begin(out, cells, sizeof(int32_t), "the ids of ");
    if (code)
        return code;
    gathering *const g = out->state;
    g->ids = malloc(cells * sizeof *g->ids);
    if (!g->ids)
        return lack_memory(out);
    for (uint64_t c = 0; c < cells; c++)
        g->ids[c] = -1;
    out->cells.ids = g->ids;
    return EXIT_CODE_OK;
}

static int put_ids(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    const gathering *const g = out->state;
    int32_t *const ids = g->ids;
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
    const int32_t *const ids = out->cells.ids;
    const volume_frame *const frame = out->format->writer->frame;
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

const brick_writer gather_ids = {.open = open_ids, .put = put_ids, .end = end_ids, .drop = gather_drop};
