/* brick_out.c - hands bricks to the format, and keeps an eye on the stream. */
#define _POSIX_C_SOURCE 200809L
#include "brick_out.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/interrupt.h"
#include "console/message.h"
#include "files/files.h"

enum { CHUNK = 1 << 16 };

/* A name in the folder of the output, or in a place for such files. To be freed; NULL without memory. */
static char *name_within(const file_out *out)
{
    if (out->target)
        return file_out_beside(out->target, false);
    char *const folder = new_file_passing_folder(), *const name = folder ? malloc(strlen(folder) + sizeof "/x") : NULL;
    if (name)
        strcat(strcpy(name, folder), "/x");
    free(folder);
    char *const beside = name ? file_out_beside(name, false) : NULL;
    free(name);
    return beside;
}

FILE *spool_open(const file_out *out)
{
    char *const name = name_within(out);
    if (!name)
        return message_failure("%s: out of memory", out->path), NULL;
    interrupt_hold(); /* until it has no name */
    FILE *const spool = new_file_open_nameless(name);
    const int reason = errno;
    interrupt_release();
    if (!spool) {
        char *const slash = strrchr(name, '/');
        if (slash)
            *slash = '\0';
        message_failure("%s: cannot write there: %s", out->target ? out->path : name, strerror(reason));
    }
    free(name);
    return spool;
}

/* Appends all of it to the output. Returns an exit_code. */
static int spool_copy(FILE *spool, const file_out *out)
{
    unsigned char chunk[CHUNK];
    size_t length;
    if (ferror(spool) || fflush(spool) || fseeko(spool, 0, SEEK_SET))
        return file_out_failure(out);
    while (!ferror(out->stream) && (length = fread(chunk, 1, sizeof chunk, spool)) > 0)
        fwrite(chunk, 1, length, out->stream);
    return ferror(spool) || ferror(out->stream) ? file_out_failure(out) : EXIT_CODE_OK;
}

/* Bricks after which the stream is asked whether it failed, which takes a lock. */
enum { LOOK_EVERY = 256 };

static int write_dense(const volume_format *format, const file_out *file, const voxels *v, unsigned threads, progress *bar)
{
    if (format->writer->frame)
        return dense_write(format->writer->frame, file, v, threads, bar);
    return format->writer->write(file->stream, v, bar) ? EXIT_CODE_OK : file_out_failure(file);
}

static int end_dense(brick_out *out, progress *bar) { return write_dense(out->format, out->file, &out->cells, out->threads, bar); }

static const brick_writer dense = {.open = gather_open, .put = gather_put, .end = end_dense, .drop = gather_drop};

static const brick_writer *writer(const brick_out *out)
{
    return out->format->writer->bricks ? out->format->writer->bricks : out->options.has_ids ? &gather_ids : &dense;
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

/* Bricks of voxels. */
typedef struct goal {
    brick_out *out;
    const voxels *v;
} goal;

static int put(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    const goal *const g = data;
    uint64_t inside[8];
    if (g->out->options.has_labels)
        bricks_inside(g->v, at, inside);
    g->out->inside = inside;
    return brick_out_put(g->out, at, bits);
}

static int cut_voxels(const volume_format *format, const volume_options *options, file_out *file, const voxels *v, uint32_t tile,
                      uint64_t *bricks, progress *bar)
{
    brick_out out;
    int code = brick_out_open(&out, format, options, file, v);
    if (code)
        return code;
    code = bricks_cut(v, tile, put, &(goal){&out, v}, bar);
    *bricks = out.bricks;
    if (!code)
        code = brick_out_end(&out, bar);
    brick_out_drop(&out);
    return code;
}

int brick_out_voxels(const volume_format *format, const volume_options *options, file_out *file, const voxels *v, uint32_t tile,
                     unsigned threads, uint64_t *bricks, progress *bar)
{
    if (!format->writer->bricks)
        return write_dense(format, file, v, threads, bar);
    if (!format->writer->bricks->shell)
        return cut_voxels(format, options, file, v, tile, bricks, bar);
    brick_out out = {.format = format, .file = file, .to = file->stream, .cells = *v};
    const int code = shell_end(&out, bar);
    *bricks = 0;
    return code ? code : check_stream(&out);
}
