/* cmd_merge.c - tribox merge: the parts that tribox voxelize --shard wrote become the whole, bit for bit. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "write/file_out.h"
#include "console/message.h"
#include "console/option_reader.h"
#include "console/options.h"
#include "console/output.h"
#include "write/part.h"
#include "picture/preview.h"
#include "console/processors.h"
#include "write/volume.h"
#include "voxelize/voxelize_report.h"

static const char help[] = "tribox merge - the parts of a voxelization become one file\n"
                           "\n"
                           "Usage: tribox merge PART... -o OUT.(npy|binvox|vox|raw) [OPTION...]\n"
                           "\n"
                           "PART... are the files of all shards that 'tribox voxelize --shard I/N' wrote, in any order.\n"
                           "The result is, bit for bit, that of a voxelization in one piece. Parts are read as they are\n"
                           "needed and take no memory of their own.\n"
                           "\n"
                           "  -o FILE                   as for 'tribox voxelize'\n"
                           "  --preview FILE.png        a picture of the cells\n"
                           "  --up AXIS                 what is up in it: x, y, z, or -x, -y, -z. Default: z\n"
                           "  --json                    the summary as a JSON object\n"
                           "  --quiet                   no summary and no progress\n"
                           "  --help                    this text\n"
                           "\n"
                           "Exit codes: 0 success; 1 failure (a file, parts that do not fit); 2 wrong command line.\n"
                           "\n"
                           "Example:\n"
                           "  tribox merge big.*.part -o big.npy --preview big.png\n";

enum { OPTION_OUT, OPTION_PREVIEW, OPTION_UP, OPTION_JSON, OPTION_QUIET };

static const option_entry options[] = {
    [OPTION_OUT] = {"out", 'o', true},    [OPTION_PREVIEW] = {"preview", 'p', true}, [OPTION_UP] = {"up", 0, true},
    [OPTION_JSON] = {"json", 'j', false}, [OPTION_QUIET] = {"quiet", 'q', false},    {NULL, 0, false}};

typedef struct request {
    const char **parts; /* paths, with room for all words */
    size_t count;
    const char *out_path, *preview_path;
    const volume_format *format;
    picture_up up;
    bool wants_json, is_quiet, has_up;
} request;

static int take(void *context, int which, const char *value)
{
    request *const r = context;
    switch (which) {
    case OPTION_OPERAND:
        r->parts[r->count++] = value;
        return EXIT_CODE_OK;
    case OPTION_OUT:
        r->out_path = value;
        return EXIT_CODE_OK;
    case OPTION_PREVIEW:
        r->preview_path = value;
        return EXIT_CODE_OK;
    case OPTION_UP:
        r->has_up = true;
        return preview_read_up(value, &r->up);
    case OPTION_JSON:
        r->wants_json = true;
        return EXIT_CODE_OK;
    default:
        r->is_quiet = true;
        return EXIT_CODE_OK;
    }
}

static int check_request(request *r)
{
    if (!r->count)
        return message_usage("no parts given");
    if (!r->out_path)
        return message_usage("no output given: -o FILE is needed");
    if (r->has_up && !r->preview_path)
        return message_usage("--up needs --preview");
    if (r->wants_json && r->is_quiet)
        return message_usage("--json and --quiet exclude each other");
    if (!(r->format = volume_format_of(r->out_path)))
        return EXIT_CODE_USAGE;
    return preview_check(r->preview_path, "--preview");
}

static int report(const request *r, const tribox_grid *grid, size_t parts, uint64_t occupied)
{
    if (r->wants_json) {
        json j = json_to(stdout);
        json_open_object(&j, NULL);
        json_whole(&j, "parts", parts);
        voxelize_json_grid(&j, grid);
        json_whole(&j, "occupied", occupied);
        json_string(&j, "output", r->out_path);
        if (r->preview_path)
            json_string(&j, "preview", r->preview_path);
        json_close(&j);
    } else if (!r->is_quiet) {
        printf("parts        %zu\n", parts);
        voxelize_print_grid(grid);
        printf("occupied     %" PRIu64 " cells\nwritten      %s\n", occupied, r->out_path);
        if (r->preview_path)
            printf("preview      %s\n", r->preview_path);
    }
    return output_flush();
}

static int write_files(const request *r, const voxels *v)
{
    file_out out, picture;
    int code = EXIT_CODE_OK;
    if (r->format->check_grid)
        code = r->format->check_grid(r->out_path, &v->grid);
    if (!code)
        code = file_out_open(&out, r->out_path);
    if (code)
        return code;
    code = file_out_open(&picture, r->preview_path);
    if (!code) {
        progress bar = progress_start("writing", !r->is_quiet);
        r->format->write(out.stream, v, &bar);
        progress_end(&bar);
        code = file_out_keep(&out);
        if (!code)
            code = preview_draw(&picture, v, r->up, processors_here(), !r->is_quiet);
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
    const voxels v = {.grid = parts[0].header.whole.grid, .slab = slabs, .slabs = filled};
    const uint64_t occupied = voxels_occupied(&v);
    code = write_files(r, &v);
    free(slabs);
    return code ? code : report(r, &v.grid, count, occupied);
}

static int merge_files(request *r)
{
    int code = check_request(r);
    if (code)
        return code;
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
    request r = {.parts = malloc((size_t)(count + 1) * sizeof *r.parts), .up = PICTURE_UP_Z};
    if (!r.parts)
        return message_failure("out of memory for %d arguments", count);
    options_found found;
    int code = options_read(count, words, options, take, &r, &found);
    if (!code)
        code = found.wants_help ? output_text(help) : merge_files(&r);
    free(r.parts);
    return code;
}
