/* cmd_merge.c - tribox merge: the parts that tribox voxelize --shard wrote become the whole, bit for bit. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "write/brick_out.h"
#include "write/file_out.h"
#include "console/message.h"
#include "console/options.h"
#include "console/output.h"
#include "write/part.h"
#include "console/processors.h"
#include "voxelize/result_options.h"
#include "voxelize/voxelize_report.h"

static const char help[] = "tribox merge - the parts of a voxelization become one file\n"
                           "\n"
                           "Usage: tribox merge PART... -o FILE [OPTION...]\n"
                           "\n"
                           "PART... are the files of all shards that 'tribox voxelize --shard I/N' wrote, in any order. The\n"
                           "result is that of a voxelization in one piece, bit for bit. Parts are read as they are needed and\n"
                           "not held in memory.\n"
                           "\n" RESULT_HELP OPTIONS_HELP_HELP "\n"
                           "Exit codes: 0 success; 1 failure (a file, parts that do not fit together); 2 wrong command line.\n"
                           "\n"
                           "Example (.npy takes a byte per cell, .raw a bit):\n"
                           "  tribox merge big.*.part -o big.raw --preview big.png\n";

static const option_entry options[] = {RESULT_ENTRIES, {NULL, 0, false}};

typedef struct request {
    const char **parts; /* paths, with room for all words */
    size_t count;
    result_request result;
} request;

static int take(void *context, int which, const char *value)
{
    request *const r = context;
    if (which != OPTION_OPERAND)
        return result_take(&r->result, which, value);
    r->parts[r->count++] = value;
    return EXIT_CODE_OK;
}

static int check_request(request *r, const options_found *found)
{
    if (!r->count)
        return message_usage("no parts given");
    if (!r->result.out_path)
        return message_usage("no output given; give -o FILE");
    return result_check(&r->result, found, false);
}

static int report(const request *r, const voxels *v, size_t parts, uint64_t occupied)
{
    if (!r->result.has_summary)
        return EXIT_CODE_OK;
    if (r->result.wants_json) {
        json j = json_to(stdout);
        json_open_object(&j, NULL);
        json_whole(&j, "parts", parts);
        voxelize_json_grid(&j, v, voxels_are_shifted(v));
        json_whole(&j, "occupied", occupied);
        json_string(&j, "output", r->result.out_path);
        if (r->result.preview_path)
            json_string(&j, "preview", r->result.preview_path);
        json_close(&j);
    } else {
        printf("parts        %zu\n", parts);
        voxelize_print_grid(v, voxels_are_shifted(v));
        printf("occupied     %" PRIu64 " cells\nwritten      %s\n", occupied, r->result.out_path);
        if (r->result.preview_path)
            printf("preview      %s\n", r->result.preview_path);
    }
    return output_flush();
}

static int write_files(const request *r, const voxels *v)
{
    file_out out, picture;
    int code = EXIT_CODE_OK;
    if (r->result.format->check_grid)
        code = r->result.format->check_grid(r->result.out_path, &v->grid);
    if (!code)
        volume_note_shift(r->result.format, r->result.out_path, v);
    if (!code)
        code = file_out_open(&out, r->result.out_path);
    if (code)
        return code;
    code = file_out_open(&picture, r->result.preview_path);
    if (!code) {
        progress bar = progress_start("writing", !r->result.is_quiet);
        code = brick_out_voxels(r->result.format, &r->result.options, &out, v, &bar);
        progress_end(&bar);
        if (!code)
            code = file_out_keep(&out);
        if (!code)
            code = preview_draw(&picture, v, &r->result.look, processors_here(), !r->result.is_quiet);
        file_out_drop(&picture);
    }
    file_out_drop(&out);
    return code;
}

static int merge(const request *r, part *parts, size_t count)
{
    int code = part_join(parts, count);
    if (code)
        return code;
    voxels_slab *slabs = malloc(count * sizeof *slabs);
    if (!slabs)
        return message_failure("out of memory for %zu parts", count);
    size_t filled = 0;
    for (size_t i = 0; i < count; i++) {
        voxels_slab *slab = &slabs[filled];
        part_layers(&parts[i].header.whole, parts[i].header.shard, &slab->first, &slab->layers);
        slab->bits = part_bits(&parts[i]);
        filled += slab->layers > 0;
    }
    voxels v = part_voxels(&parts[0].header.whole);
    v.slab = slabs;
    v.slabs = filled;
    const uint64_t occupied = voxels_occupied(&v);
    code = write_files(r, &v);
    free(slabs);
    return code ? code : report(r, &v, count, occupied);
}

static int merge_files(const request *r)
{
    int code = EXIT_CODE_OK;
    part *parts = malloc(r->count * sizeof *parts);
    if (!parts)
        return message_failure("out of memory for %zu parts", r->count);
    size_t opened = 0;
    for (; opened < r->count; opened++) {
        code = part_open(&parts[opened], r->parts[opened]);
        if (code)
            break;
    }
    if (!code)
        code = merge(r, parts, r->count);
    while (opened)
        part_close(&parts[--opened]);
    free(parts);
    return code;
}

int cmd_merge(int count, char **words)
{
    request r = {.parts = malloc((size_t)(count + 1) * sizeof *r.parts), .result.look = PREVIEW_LOOK_DEFAULT};
    if (!r.parts)
        return message_failure("out of memory for %d arguments", count);
    options_found found;
    int code = options_read(count, words, options, take, &r, &found);
    if (!code && found.wants_help)
        code = output_text(help);
    else if (!code)
        code = check_request(&r, &found);
    if (!code && !found.wants_help)
        code = merge_files(&r);
    free(r.parts);
    return code;
}
