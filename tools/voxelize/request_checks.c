/* request_checks.c - refuses, in one line, what does not go together. */
#include "request_checks.h"

#include <string.h>

#include "console/message.h"
#include "partition/partition.h"
#include "write/file_out.h"

/* A partition has its grid and its mesh, and lists of all axes. */
static int check_partition(const voxelize_request *r, const options_found *found, const option_entry *options)
{
    for (int which = OPTION_GRID; which < OPTION_GRID + GRID_END; which++)
        if (options_has(found, which))
            return message_usage(
                "%s is a folder, so a partition, which has its grid: leave out --%s; or give meshes by their names",
                r->from.mesh_path, options[which].name);
    if (r->test.axes && r->test.axes != TRIBOX_AXES_ALL)
        return message_usage("%s is a partition, which is for all axes: leave out --axes", r->from.mesh_path);
    if (r->fill == FILL_PARITY || r->fill == FILL_MIDDLES)
        return message_usage("%s is a partition, which lacks what lies before its grid: --fill %s needs the mesh itself",
                             r->from.mesh_path, r->fill == FILL_PARITY ? "parity" : "middles");
    return EXIT_CODE_OK;
}

static int check_input(const voxelize_request *r, const options_found *found, const option_entry *options)
{
    size_t folders = 0;
    while (folders < r->count && partition_is_folder(r->paths[folders]))
        folders++;
    if (r->count > 1 && folders < r->count)
        return message_usage(folders ? "'%s' is no partition: several are taken as one mesh, or one mesh at a time"
                                     : "one mesh at a time: '%s' is one file too many",
                             r->paths[folders ? folders : 1]);
    return folders ? check_partition(r, found, options) : grid_check(&r->from, found, OPTION_GRID);
}

/* A thin surface is told exactly. */
static int check_thin(const voxelize_request *r)
{
    if (!r->is_thin)
        return EXIT_CODE_OK;
    if (r->test.accuracy != TRIBOX_EXACT || (r->test.axes && r->test.axes != TRIBOX_AXES_ALL))
        return message_usage("--thin is exact and of all axes: leave out --accuracy and --axes");
    if (r->fill == FILL_MIDDLES)
        return message_usage("--fill middles has no cells of the surface: leave out --thin, or give --fill parity");
    return EXIT_CODE_OK;
}

/* Which of the cells of a fill are wanted. */
static int check_cells(const voxelize_request *r, const options_found *found, const option_entry *options)
{
    if (r->cells == FILL_CELLS_ALL)
        return EXIT_CODE_OK;
    const char *const name = options[options_has(found, OPTION_LABELS) ? OPTION_LABELS : OPTION_INSIDE_ONLY].name;
    if (r->fill == FILL_NONE)
        return message_usage("--%s is about a filled mesh: give --fill outside or --fill parity", name);
    if (r->fill == FILL_MIDDLES)
        return message_usage("--fill middles has no cells of the surface: leave out --%s, or give --fill parity", name);
    return EXIT_CODE_OK;
}

/* To count nothing is written. */
static int check_count(voxelize_request *r, const options_found *found, const option_entry *options)
{
    for (int which = 0; which <= OPTION_IDS; which++) {
        const bool is_for_files = which < RESULT_END || which == OPTION_LABELS || which >= OPTION_COLOURS;
        if (options_has(found, which) && is_for_files && which != RESULT_JSON)
            return message_usage("--count only prints: leave out --%s", options[which].name);
    }
    r->result.has_summary = true;
    return EXIT_CODE_OK;
}

/* What a format holds of cells besides that they are there. */
static int check_format(const voxelize_request *r)
{
    const volume_format *const format = r->result.format;
    if (r->cells == FILL_CELLS_LABELLED && !volume_takes_labels(format))
        return message_usage("--labels: %s holds no labels; write %s, or give --inside-only", format->word,
                             volume_words(volume_takes_labels).text);
    if (r->has_colours && !volume_takes_colours(format))
        return message_usage("--colours: .%s holds none; write %s", format->word, volume_endings(volume_takes_colours).text);
    if (r->result.options.has_ids && !volume_takes_ids(format))
        return message_usage("--ids: .%s holds none; write %s", format->word, volume_endings(volume_takes_ids).text);
    return EXIT_CODE_OK;
}

static int check_output(voxelize_request *r, const options_found *found)
{
    const char *const out = r->result.out_path;
    if (!out)
        return message_usage("no output given; give -o FILE, or --count");
    result_guess_up(&r->result, r->from.mesh_path);
    int code = result_check(&r->result, found, "mesh", r->paths, r->count);
    if (!code)
        code = check_format(r);
    if (!code && r->has_shard && strcmp(r->result.format->word, "npz"))
        return message_usage("a shard is written as .npz, not as %s: -o FILE.npz", r->result.format->word);
    return code;
}

/* Options that exclude each other, and why. */
static const struct conflict {
    int one, other;
    const char *line;
} conflicts[] = {{OPTION_THIN, OPTION_SHARD, "--thin needs all cells at once: leave out --shard"},
                 {OPTION_FILL, OPTION_SHARD, "--fill needs all cells at once: leave out --shard"},
                 {OPTION_COLOURS, OPTION_SHARD, "--colours needs all cells at once: leave out --shard"},
                 {OPTION_SHARD, RESULT_PREVIEW, "--preview needs all cells: give it to 'tribox merge'"},
                 {OPTION_LABELS, OPTION_INSIDE_ONLY, "--labels and --inside-only exclude each other"},
                 {OPTION_LABELS, RESULT_VDB_GRID, "--labels and --vdb-grid exclude each other: labels are a grid of whole numbers"},
                 {OPTION_IDS, RESULT_VDB_GRID, "--ids and --vdb-grid exclude each other: ids are a grid of whole numbers"},
                 {OPTION_COLOURS, OPTION_FILL, "--colours are those of the surface, cells inside have none: leave out --fill"},
                 {OPTION_IDS, OPTION_FILL, "--ids are those of the surface, cells inside have none: leave out --fill"},
                 {OPTION_COLOURS, OPTION_THIN, "--colours are those of all triangles of a cell: leave out --thin"},
                 {OPTION_IDS, OPTION_THIN, "--ids are those of all triangles of a cell: leave out --thin"},
                 {OPTION_IDS, OPTION_COLOURS, "--ids and --colours exclude each other: run it for each"}};

/* What a partition lacks. */
static const struct lack {
    int option;
    const char *line;
} lacks[] = {{OPTION_THIN, "is for tiles: --thin"}, {OPTION_COLOURS, "lacks the colours of its mesh: --colours"}};

static int check_conflicts(const voxelize_request *r, const options_found *found)
{
    for (size_t n = 0; n < sizeof conflicts / sizeof *conflicts; n++)
        if (options_has(found, conflicts[n].one) && options_has(found, conflicts[n].other))
            return message_usage("%s", conflicts[n].line);
    for (size_t n = 0; n < sizeof lacks / sizeof *lacks; n++)
        if (options_has(found, lacks[n].option) && partition_is_folder(r->from.mesh_path))
            return message_usage("%s is a partition, which %s needs the mesh itself", r->from.mesh_path, lacks[n].line);
    return EXIT_CODE_OK;
}

int request_check(voxelize_request *r, const options_found *found, const option_entry *options)
{
    int code = check_input(r, found, options);
    if (!code)
        code = check_conflicts(r, found);
    if (!code)
        code = check_thin(r);
    if (!code)
        code = check_cells(r, found, options);
    return code ? code : r->is_count ? check_count(r, found, options) : check_output(r, found);
}
