/*
 * cmd_merge.c - tribox merge: the parts that tribox voxelize --shard wrote become the whole, bit for bit; or a file of the whole
 * becomes one of another format.
 */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "colours/colours.h"
#include "console/interrupt.h"
#include "console/message.h"
#include "console/options.h"
#include "console/output.h"
#include "console/system.h"
#include "voxelize/result_options.h"
#include "write/volume.h"
#include "write/file_out.h"
#include "write/part.h"
#include "write/voxels.h"

typedef struct merge_request {
    const char *const *parts; /* paths */
    size_t count;
    uint32_t threads;
    result_request result;
} merge_request;

static int report(const merge_request *r, const voxels *v, size_t parts, uint64_t bricks, uint64_t occupied)
{
    if (!r->result.has_summary)
        return EXIT_CODE_OK;
    if (r->result.wants_json) {
        json j = json_to(stdout);
        json_open_object(&j, NULL);
        json_whole(&j, "parts", parts);
        voxelize_json_grid(&j, v, voxels_are_shifted(v));
        json_whole(&j, "occupied", occupied);
        json_whole(&j, "bricks", bricks);
        result_json(&j, &r->result);
        json_close(&j);
    } else {
        printf("parts        %zu\n", parts);
        voxelize_print_grid(v, voxels_are_shifted(v));
        printf("occupied     %" PRIu64 " cells\nbricks       %" PRIu64 "\n", occupied, bricks);
        result_print(&r->result);
    }
    return output_flush();
}

/* Where the bricks of all parts go. */
typedef struct merging {
    const merge_request *r;
    voxels cells;
    brick_out out;
    const part_whole *whole;
    cell_colours colours; /* of all set cells, if they have some */
    uint64_t *words;      /* for the picture; NULL for none */
    progress bar;
    uint64_t all, done; /* bricks */
} merging;

static int take_brick(void *data, const part_brick *brick)
{
    enum { TELL_EACH = 4096 };
    merging *const m = data;
    if (m->words)
        bricks_lay(m->cells.grid.size, m->words, brick->at, brick->bits);
    if (++m->done % TELL_EACH == 0)
        progress_tell(&m->bar, (double)m->done / (double)m->all);
    m->out.ids = brick->ids;
    m->out.inside = brick->inside;
    return brick_out_put(&m->out, brick->at, brick->bits);
}

static int read_parts(merging *m, part *parts, size_t count)
{
    int code = EXIT_CODE_OK;
    m->bar = progress_start_of("merging", "bricks", (double)m->all);
    for (size_t i = 0; i < count && !code; i++)
        code = part_read(&parts[i], m->r->threads, take_brick, m);
    progress_end(&m->bar);
    return code;
}

static int write_bricks(merging *m, part *parts, size_t count, file_out *out)
{
    const result_request *const result = &m->r->result;
    volume_options how = result->options;
    how.has_ids = m->whole->has_ids;
    how.has_labels = m->whole->has_labels;
    int code = brick_out_open(&m->out, result->format, &how, out, &m->cells);
    if (code)
        return code;
    m->out.threads = m->r->threads;
    code = read_parts(m, parts, count);
    if (!code) {
        progress bar = progress_start("writing");
        code = brick_out_end(&m->out, &bar);
        progress_end(&bar);
    }
    brick_out_drop(&m->out);
    return code ? code : file_out_keep(out);
}

static int write_files(merging *m, part *parts, size_t count)
{
    const result_request *const result = &m->r->result;
    file_out out = {.path = NULL}, picture = out;
    volume_note_shift(result->format, result->out_path, &m->cells);
    int code = file_out_open(&out, result->out_path);
    if (!code)
        code = file_out_open(&picture, result->preview_path);
    if (!code)
        code = write_bricks(m, parts, count, &out);
    if (!code)
        code = result_draw(result, &m->cells, m->words, m->r->threads, &picture);
    file_out_drop(&picture);
    file_out_drop(&out);
    return code;
}

/* Nothing is dropped without a word. */
static int check_more(const merge_request *r, const part *parts)
{
    const volume_format *const format = r->result.format;
    const part_whole *const whole = &parts[0].header.whole;
    const char *const more = whole->has_ids ? "ids" : whole->has_labels ? "labels" : whole->has_colours ? "colours" : NULL;
    if (!more)
        return EXIT_CODE_OK;
    if (r->result.options.is_mask && !whole->has_colours)
        return message_failure("%s: has %s, a grid of whole numbers: leave out --vdb-grid", parts[0].path, more);
    return volume_holds(format, more) ? EXIT_CODE_OK
                                      : message_failure("%s: has %s, and .%s holds none: write %s, or voxelize without --%s",
                                                        parts[0].path, more, format->word, volume_endings(more).text, more);
}

static int take_colours(void *data, const part_brick *brick)
{
    merging *const m = data;
    rgb *const of = cell_colours_add(&m->colours, brick->at, brick->bits, brick->cells);
    if (!of)
        return message_failure("out of memory for the colours of the cells");
    memcpy(of, brick->colours, brick->cells * sizeof *of);
    return EXIT_CODE_OK;
}

/* Formats need all of them before they get the first brick. */
static int read_colours(merging *m, part *whole)
{
    const result_request *const result = &m->r->result;
    int code = part_read(whole, m->r->threads, take_colours, m);
    if (!code && !cell_colours_place(&m->colours, m->cells.grid.size))
        code = message_failure("out of memory for the colours of the cells");
    if (!code && volume_holds(result->format, "of a palette"))
        code = cell_colours_make_palette(&m->colours, result->out_path);
    m->cells.colours = &m->colours;
    return code;
}

static const char fewer[] = "choose a sparse format, -o FILE.npz or .vdb, without a picture";

static int merge(const merge_request *r, part *parts, size_t count)
{
    const bool is_whole = count == 1 && !parts[0].header.shard;
    int code = is_whole ? EXIT_CODE_OK : part_join(parts, count);
    if (code)
        return code;
    const part_whole *const whole = &parts[0].header.whole;
    merging m = {.r = r, .cells = whole->cells, .whole = whole};
    for (size_t i = 0; i < count; i++)
        m.all += parts[i].bricks;
    code = check_more(r, parts);
    if (!code && r->result.format->writer->check_grid)
        code = r->result.format->writer->check_grid(r->result.out_path, &m.cells.grid);
    if (!code && whole->has_colours)
        code = read_colours(&m, parts);
    if (!code)
        code = result_take_words(&r->result, &m.cells.grid, fewer, fewer, &m.words);
    if (!code)
        code = write_files(&m, parts, count);
    free(m.words);
    cell_colours_free(&m.colours);
    uint64_t occupied = 0;
    for (size_t i = 0; i < count; i++)
        occupied += parts[i].cells;
    return code ? code : report(r, &m.cells, count, m.all, occupied);
}

static int merge_parts(const merge_request *r)
{
    int code = EXIT_CODE_OK;
    part *parts = malloc(r->count * sizeof *parts);
    if (!parts)
        return message_failure("out of memory for %zu parts", r->count);
    interrupt_advise("nothing was written, the parts stay good; run it again");
    for (size_t i = 0; i < r->count && !code; i++)
        code = part_open(&parts[i], r->parts[i]);
    if (!code)
        code = merge(r, parts, r->count);
    free(parts);
    return code;
}

static const char help[] =
    "tribox merge - join the parts of a voxelization into one file, or convert a whole one\n"
    "\n"
    "Usage: tribox merge PART... -o FILE [OPTION...]\n"
    "\n"
    "PART... are the .npz files of 'tribox voxelize --shard I/N' for all shards, in any order. The\n"
    "result is that of a voxelization in one piece, bit for bit. If FILE is sparse, little memory is\n"
    "needed. A whole .npz, from 'tribox voxelize' or Python, becomes a file of another format.\n"
    "\n" RESULT_HELP "  -t, --threads T         1 to 256; default: one for each processor. The file is the same\n" OPTIONS_HELP_HELP
    "\n"
    "Exit codes: 0 success; 1 failure (a file, parts that do not fit together); 2 wrong command line.\n"
    "\n"
    "Example:\n"
    "  tribox merge big.*.npz -o big.npz\n";

static const option_entry options[] = {
    RESULT_ENTRIES(merge_request), {"threads", 't', OPTION_COUNTS_THREADS(merge_request, threads)}, {NULL, 0, false}};

static int take(void *request, int which, const char *value)
{
    return which == OPTION_OPERAND ? EXIT_CODE_OK : result_take(&((merge_request *)request)->result, which, value);
}

static int answer(void *request, const options_found *found)
{
    merge_request *const r = request;
    r->parts = found->operands;
    r->count = found->count;
    if (!r->count)
        return message_usage("no parts given");
    if (!r->result.out_path)
        return message_usage("no output given; give -o FILE");
    const int code = result_check(&r->result, found, "part", r->parts, r->count);
    return code ? code : merge_parts(r);
}

int cmd_merge(int count, char **words)
{
    merge_request r = {.threads = processors_here(), .result.look = PREVIEW_LOOK_DEFAULT};
    return options_answer(&(options_command){help, options, take, answer}, count, words, &r);
}
