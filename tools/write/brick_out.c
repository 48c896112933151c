/* brick_out.c - hands bricks to the format, keeps an eye on the stream, and gathers words for dense formats. */
#define _POSIX_C_SOURCE 200809L
#include "brick_out.h"

#include <stdlib.h>

#include "brick_writer.h"
#include "brick_cutter.h"
#include "console/memory.h"
#include "console/message.h"
#include "dense_out.h"
#include "spool.h"

/* Bricks after which the stream is asked whether it failed, which takes a lock. */
enum { LOOK_EVERY = 256 };

/* The words of a dense format until all bricks are there. */
typedef struct gathering {
    voxels_slab slab;
    uint64_t *words, *inside; /* inside: NULL without labels */
} gathering;

static int take_words(brick_out *out, gathering *g)
{
    char needed[16], there[16];
    const tribox_grid *const grid = &out->cells.grid;
    const uint64_t words = (uint64_t)voxels_layer_words(grid) * grid->size[2], available = memory_available();
    const uint64_t bytes = sizeof *g->words * (out->options.has_labels ? 2 : 1); /* for each word */
    if (words > available / bytes)
        return message_failure("%s: %u x %u x %u cells take %s of memory in this format and %s are available; write .npz or .vdb",
                               out->file->path, grid->size[0], grid->size[1], grid->size[2], memory_text(words * bytes, needed),
                               memory_text(available, there));
    g->words = calloc(words, sizeof *g->words);
    g->inside = out->options.has_labels ? calloc(words, sizeof *g->inside) : NULL;
    return g->words && (g->inside || !out->options.has_labels)
               ? EXIT_CODE_OK
               : message_failure("%s: out of memory for its cells", out->file->path);
}

static void free_gathering(gathering *g)
{
    if (!g)
        return;
    free(g->words);
    free(g->inside);
    free(g);
}

static int open_dense(brick_out *out)
{
    gathering *const g = calloc(1, sizeof *g);
    const int code = g ? take_words(out, g) : message_failure("%s: out of memory", out->file->path);
    if (code) {
        free_gathering(g);
        return code;
    }
    g->slab = (voxels_slab){.layers = out->cells.grid.size[2], .bits = g->words, .inside = g->inside};
    out->cells.slab = &g->slab;
    out->cells.slabs = 1;
    out->state = g;
    return EXIT_CODE_OK;
}

static int put_dense(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    const gathering *const g = out->state;
    bricks_lay(&out->cells.grid, g->words, at, bits);
    if (g->inside)
        bricks_lay(&out->cells.grid, g->inside, at, out->inside);
    return EXIT_CODE_OK;
}

static int write_dense(const volume_format *format, const file_out *file, const voxels *v, unsigned threads, progress *bar)
{
    if (format->frame)
        return dense_write(format->frame, file, v, threads, bar);
    format->write(file->stream, v, bar);
    return EXIT_CODE_OK;
}

static int end_dense(brick_out *out, progress *bar) { return write_dense(out->format, out->file, &out->cells, out->threads, bar); }

static void drop_dense(brick_out *out) { free_gathering(out->state); }

static const brick_writer dense = {.open = open_dense, .put = put_dense, .end = end_dense, .drop = drop_dense};

static const brick_writer *writer(const brick_out *out)
{
    return out->format->bricks ? out->format->bricks : out->options.has_ids ? &dense_ids : &dense;
}

static bool is_spooled(const brick_out *out) { return out->to != out->file->stream; }

static int check_stream(const brick_out *out) { return ferror(out->to) ? file_out_failure(out->file) : EXIT_CODE_OK; }

int brick_out_open(brick_out *out, const volume_format *format, const volume_options *options, file_out *file, const voxels *about)
{
    *out = (brick_out){.format = format, .options = *options, .file = file, .to = file->stream, .cells = *about};
    out->cells.slab = NULL;
    out->cells.slabs = 0;
    if (writer(out)->goes_back && file_out_is_stdout(file->path))
        out->to = spool_open(file);
    if (!out->to)
        return EXIT_CODE_FAILURE;
    const int code = writer(out)->open(out);
    if (code && is_spooled(out))
        fclose(out->to);
    if (code)
        out->to = NULL;
    return code;
}

int brick_out_put(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    const int code = writer(out)->put(out, at, bits);
    const bool is_looked_at = ++out->bricks % LOOK_EVERY == 0;
    return code || !is_looked_at ? code : check_stream(out);
}

int brick_out_put_labelled(brick_out *out, const uint32_t at[3], const uint64_t bits[8], const uint64_t inside[8])
{
    out->inside = inside;
    return brick_out_put(out, at, bits);
}

int brick_out_end(brick_out *out, progress *bar)
{
    int code = writer(out)->end(out, bar);
    if (!code)
        code = check_stream(out);
    if (!code && is_spooled(out))
        code = spool_copy(out->to, out->file);
    if (!code)
        brick_out_drop(out);
    return code;
}

void brick_out_drop(brick_out *out)
{
    if (!out->to)
        return;
    writer(out)->drop(out);
    if (is_spooled(out))
        fclose(out->to);
    out->to = NULL;
}

static int put(void *out, const uint32_t at[3], const uint64_t bits[8]) { return brick_out_put(out, at, bits); }

/* Bricks of voxels with labels. */
typedef struct labelled_goal {
    brick_out *out;
    const voxels *v;
} labelled_goal;

static int put_labelled(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    const labelled_goal *const g = data;
    uint64_t inside[8];
    bricks_inside(g->v, at, inside);
    return brick_out_put_labelled(g->out, at, bits, inside);
}

static int cut_voxels(const volume_format *format, const volume_options *options, file_out *file, const voxels *v, uint32_t tile,
                      uint64_t *bricks, progress *bar)
{
    brick_out out;
    int code = brick_out_open(&out, format, options, file, v);
    if (code)
        return code;
    if (writer(&out)->whole)
        writer(&out)->whole(&out, v);
    else if (options->has_labels)
        code = bricks_cut(v, tile, put_labelled, &(labelled_goal){&out, v}, bar);
    else
        code = bricks_cut(v, tile, put, &out, bar);
    *bricks = out.bricks;
    if (!code)
        code = brick_out_end(&out, bar);
    brick_out_drop(&out);
    return code;
}

int brick_out_voxels(const volume_format *format, const volume_options *options, file_out *file, const voxels *v, uint32_t tile,
                     unsigned threads, uint64_t *bricks, progress *bar)
{
    return format->bricks ? cut_voxels(format, options, file, v, tile, bricks, bar) : write_dense(format, file, v, threads, bar);
}
