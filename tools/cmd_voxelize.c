/* cmd_voxelize.c - tribox voxelize: the cells of a grid that a mesh overlaps, as a file for other programs. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <string.h>

#include "console/known_word.h"
#include "console/message.h"
#include "console/numbers.h"
#include "console/options.h"
#include "console/output.h"
#include "console/system.h"
#include "partition/partition.h"
#include "read/mesh_file.h"
#include "voxelize/voxelize_work.h"
#include "write/file_out.h"

static const char help[] =
    "tribox voxelize - which cells of a grid does a mesh overlap?\n"
    "\n"
    "Usage: tribox voxelize MESH --resolution N|--cell S[,S,S] -o FILE|--count [OPTION...]\n"
    "       tribox voxelize FOLDER... -o FILE|--count [OPTION...]\n"
    "\n"
    "Marks the cells of the surface, and with --fill those inside. Cells contain their borders: a face on\n"
    "a plane of the grid marks the cells on both sides. MESH is as for 'tribox overlap'; FOLDER is made\n"
    "by 'tribox partition'; several of one grid count as one. MESH and sparse files may exceed memory.\n"
    "\n" GRID_HELP RESULT_HELP "      --count             write no file, only count cells and bricks\n"
    "      --thin              a surface of about half the cells that does not leak across faces\n"
    "      --fill WORD         outside: also cells not reached from outside through free cells;\n"
    "                          parity: also cells inside, by rays along x; needs MESH;\n"
    "                          middles: only cells whose middle is inside, by parity\n"
    "      --labels            with --fill: cells of the surface are 1, those inside 2\n"
    "      --inside-only       with --fill: only the cells inside, not those of the surface\n"
    "      --colours           colours of MESH (not STL, .f32), in the file and the picture\n"
    "      --ids               the lowest triangle of each cell\n"
    "  -m, --memory SIZE       bytes, or 512M, 4G; a larger MESH is sorted first; default: what is free\n"
    "  -t, --threads T         1 to 256; default: one for each processor. The answer is the same\n"
    "      --shard I/N         part I (1 to N) of N, of about equal work, as a .npz for 'tribox merge'\n" OPTIONS_TEST_HELP
        OPTIONS_HELP_HELP "\n"
    "Exit codes: 0 success; 1 failure (a file, memory, the output); 2 wrong command line.\n"
    "\n"
    "Examples ('man tribox' has the details):\n"
    "  tribox voxelize bunny.ply --resolution 256 -o bunny.npy --preview bunny.png --up y\n"
    "  tribox voxelize part.stl --cell 0.5 --fill outside --labels -o part.nrrd\n"
    "  generate | tribox voxelize - --format f32 -r 64 -o - --out-format npy | consume\n";

/* Behind those that merge has too. */
enum {
    OPTION_GRID = RESULT_END,
    OPTION_COUNT = OPTION_GRID + GRID_END,
    OPTION_THIN,
    OPTION_FILL,
    OPTION_LABELS,
    OPTION_INSIDE_ONLY,
    OPTION_COLOURS,
    OPTION_IDS,
    OPTION_MEMORY,
    OPTION_SHARD,
    OPTION_ACCURACY,
    OPTION_AXES,
    OPTION_KERNEL
};

static const option_entry options[] = {RESULT_ENTRIES(voxelize_request),
                                       GRID_ENTRIES(OPTION_GRID),
                                       [OPTION_COUNT] = {"count", 0, OPTION_SETS(voxelize_request, is_count)},
                                       [OPTION_THIN] = {"thin", 0, OPTION_SETS(voxelize_request, is_thin)},
                                       [OPTION_FILL] = {"fill", 0, true},
                                       [OPTION_LABELS] = {"labels", 0, false},
                                       [OPTION_INSIDE_ONLY] = {"inside-only", 0, false},
                                       [OPTION_COLOURS] = {"colours", 0, OPTION_SETS(voxelize_request, has_colours)},
                                       [OPTION_IDS] = {"ids", 0, OPTION_SETS(voxelize_request, result.options.has_ids)},
                                       [OPTION_MEMORY] = {"memory", 'm', true},
                                       [OPTION_SHARD] = {"shard", 0, true},
                                       [OPTION_ACCURACY] = {"accuracy", 0, true},
                                       [OPTION_AXES] = {"axes", 0, true},
                                       [OPTION_KERNEL] = {"kernel", 0, true},
                                       {"threads", 't', OPTION_COUNTS_THREADS(voxelize_request, threads)},
                                       {NULL, 0, false}};

static int read_shard(const char *text, uint32_t *shard, uint32_t *shards)
{
    char number[16];
    const char *slash = strchr(text, '/');
    const size_t length = slash ? (size_t)(slash - text) : 0;
    if (!slash || length >= sizeof number)
        return message_usage("--shard: '%s' is not I/N, such as 3/8", text);
    memcpy(number, text, length);
    number[length] = '\0';
    const int code = numbers_read_whole(slash + 1, "--shard I/N, its N", GRID_CELLS_MAX, shards);
    return code ? code : numbers_read_whole(number, "--shard I/N, its I", *shards, shard);
}

static int read_fill(const char *word, voxelize_fill *fill)
{
    static const voxelize_fill fills[] = {FILL_OUTSIDE, FILL_PARITY, FILL_MIDDLES};
    unsigned n;
    const int code = choice_read("--fill", word, strlen(word), "outside parity middles", NULL, &n);
    if (!code)
        *fill = fills[n];
    return code;
}

static int take(void *request, int which, const char *value)
{
    voxelize_request *const r = request;
    switch (which) {
    case OPTION_OPERAND:
        return EXIT_CODE_OK;
    case OPTION_FILL:
        return read_fill(value, &r->fill);
    case OPTION_LABELS:
        r->cells = FILL_CELLS_LABELLED;
        r->result.options.has_labels = true;
        return EXIT_CODE_OK;
    case OPTION_INSIDE_ONLY:
        r->cells = FILL_CELLS_INSIDE;
        return EXIT_CODE_OK;
    case OPTION_MEMORY:
        return numbers_read_memory(value, &r->memory);
    case OPTION_SHARD:
        r->has_shard = true;
        return read_shard(value, &r->shard, &r->shards);
    default:
        return which < RESULT_END     ? result_take(&r->result, which, value)
               : which < OPTION_COUNT ? grid_take(&r->from, which - OPTION_GRID, value)
                                      : options_read_test(options[which].name, value, &r->test);
    }
}

/* A partition has its grid and its mesh, and lists of all axes. */
static int check_partition(const voxelize_request *r, const options_found *found)
{
    if (grid_refuse(&r->from, found, options, OPTION_GRID))
        return EXIT_CODE_USAGE;
    if (options_has(found, OPTION_MEMORY))
        return message_usage("%s is a partition, which is sorted: leave out --memory", r->from.mesh_path);
    if (r->test.axes && r->test.axes != TRIBOX_AXES_ALL)
        return message_usage("%s is a partition, which is for all axes: leave out --axes", r->from.mesh_path);
    if (r->fill == FILL_PARITY || r->fill == FILL_MIDDLES)
        return message_usage("%s is a partition, which lacks what lies before its grid: --fill %s needs the mesh itself",
                             r->from.mesh_path, r->fill == FILL_PARITY ? "parity" : "middles");
    return EXIT_CODE_OK;
}

static int check_input(const voxelize_request *r, const options_found *found)
{
    size_t folders = 0;
    while (folders < r->count && partition_is_folder(r->paths[folders]))
        folders++;
    if (r->count > 1 && folders < r->count)
        return folders
                   ? message_usage("'%s' is no partition: several are taken as one mesh, or one mesh at a time", r->paths[folders])
                   : options_refuse_file(r->paths[1]);
    return folders ? check_partition(r, found) : grid_check(&r->from, found, OPTION_GRID);
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
static int check_cells(const voxelize_request *r, const options_found *found)
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
static int check_count(voxelize_request *r, const options_found *found)
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
    if (r->cells == FILL_CELLS_LABELLED && !volume_holds(format, "labels"))
        return message_usage("--labels: %s holds no labels; write %s, or give --inside-only", format->word,
                             volume_words("labels").text);
    if (r->has_colours && !volume_holds(format, "colours"))
        return message_usage("--colours: .%s holds none; write %s", format->word, volume_endings("colours").text);
    if (r->result.options.has_ids && !volume_holds(format, "ids"))
        return message_usage("--ids: .%s holds none; write %s", format->word, volume_endings("ids").text);
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
    if (options_has(found, OPTION_MEMORY) && !voxelize_can_sort(r))
        return message_usage("--memory sorts a larger mesh by tiles, which is for exact cells of the surface or of --fill outside: "
                             "leave out --memory, or --accuracy, --axes, --colours, --thin or another --fill");
    for (size_t n = 0; n < sizeof lacks / sizeof *lacks; n++)
        if (options_has(found, lacks[n].option) && partition_is_folder(r->from.mesh_path))
            return message_usage("%s is a partition, which %s needs the mesh itself", r->from.mesh_path, lacks[n].line);
    return EXIT_CODE_OK;
}

static int answer(void *request, const options_found *found)
{
    voxelize_request *const r = request;
    r->paths = found->operands;
    r->count = found->count;
    r->from.mesh_path = r->count ? r->paths[0] : NULL;
    int code = check_input(r, found);
    if (!code)
        code = check_conflicts(r, found);
    if (!code)
        code = check_thin(r);
    if (!code)
        code = check_cells(r, found);
    if (!code)
        code = r->is_count ? check_count(r, found) : check_output(r, found);
    return code ? code : voxelize_work(r);
}

int cmd_voxelize(int count, char **words)
{
    voxelize_request r = {.threads = processors_here(), .shard = 1, .shards = 1, .result.look = PREVIEW_LOOK_DEFAULT};
    return options_answer(&(options_command){help, options, take, answer}, count, words, &r);
}
