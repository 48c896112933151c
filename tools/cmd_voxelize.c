/* cmd_voxelize.c - tribox voxelize: the cells of a grid that a mesh overlaps, as a file for other programs. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/numbers.h"
#include "console/option_reader.h"
#include "console/options.h"
#include "console/output.h"
#include "console/processors.h"
#include "read/reading.h"
#include "voxelize/request_checks.h"

static const char help[] =
    "tribox voxelize - which cells of a grid does a mesh overlap?\n"
    "\n"
    "Usage: tribox voxelize MESH --resolution N|--cell S[,S,S] -o FILE|--count [OPTION...]\n"
    "       tribox voxelize FOLDER... -o FILE|--count [OPTION...]\n"
    "\n"
    "Marks the cells of the surface, and with --fill those inside. Cells contain their borders: a face on\n"
    "a plane of the grid marks the cells on both sides. MESH is as for 'tribox overlap'; FOLDER is what\n"
    "'tribox partition' wrote; several of one grid are one mesh. Sparse files may be larger than memory.\n"
    "\n" GRID_HELP RESULT_HELP "      --count             write no file, only count cells and bricks\n"
    "      --thin              a surface of about half the cells that does not leak across faces\n"
    "      --fill WORD         outside: also cells not reached from outside through free cells;\n"
    "                          parity: also what rays along x enter, which needs MESH;\n"
    "                          middles: only cells whose middle is inside, by parity\n"
    "      --labels            with --fill: cells of the surface are 1, those inside 2\n"
    "      --inside-only       with --fill: only the cells inside, not those of the surface\n"
    "      --colours           of MESH (not STL, .f32), in the file and the picture\n"
    "      --ids               the lowest triangle of each cell\n"
    "  -t, --threads T         1 to 256; default: one for each processor. The answer is the same\n"
    "      --shard I/N         part I (1 to N) of N, of about equal work, as a .npz for 'tribox merge'\n" OPTIONS_TEST_HELP
        OPTIONS_HELP_HELP "\n"
    "Exit codes: 0 success; 1 failure (a file, memory, the output); 2 wrong command line.\n"
    "\n"
    "Examples ('man tribox' has the details):\n"
    "  tribox voxelize bunny.ply --resolution 256 -o bunny.npy --preview bunny.png --up y\n"
    "  tribox voxelize part.stl --cell 0.5 --fill outside --labels -o part.nrrd\n"
    "  tribox voxelize big.ply --resolution 16384 -o big.npz\n"
    "  generate | tribox voxelize - --format f32 -r 64 -o - --out-format npy | consume\n";

static const option_entry options[] = {RESULT_ENTRIES,
                                       GRID_ENTRIES(OPTION_GRID),
                                       [OPTION_COUNT] = {"count", 0, false},
                                       [OPTION_THIN] = {"thin", 0, false},
                                       [OPTION_FILL] = {"fill", 0, true},
                                       [OPTION_LABELS] = {"labels", 0, false},
                                       [OPTION_INSIDE_ONLY] = {"inside-only", 0, false},
                                       [OPTION_COLOURS] = {"colours", 0, false},
                                       [OPTION_IDS] = {"ids", 0, false},
                                       [OPTION_THREADS] = {"threads", 't', true},
                                       [OPTION_SHARD] = {"shard", 0, true},
                                       [OPTION_ACCURACY] = {"accuracy", 0, true},
                                       [OPTION_AXES] = {"axes", 0, true},
                                       [OPTION_KERNEL] = {"kernel", 0, true},
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
    *fill = !strcmp(word, "outside")   ? FILL_OUTSIDE
            : !strcmp(word, "parity")  ? FILL_PARITY
            : !strcmp(word, "middles") ? FILL_MIDDLES
                                       : FILL_NONE;
    return *fill != FILL_NONE ? EXIT_CODE_OK : message_usage("--fill: '%s' is none of outside, parity and middles", word);
}

static int take(void *request, int which, const char *value)
{
    voxelize_request *const r = request;
    switch (which) {
    case OPTION_OPERAND:
        r->from.mesh_path = r->count ? r->from.mesh_path : value;
        r->paths[r->count++] = value;
        return EXIT_CODE_OK;
    case OPTION_COUNT:
        r->is_count = true;
        return EXIT_CODE_OK;
    case OPTION_THIN:
        r->is_thin = true;
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
    case OPTION_COLOURS:
        r->has_colours = true;
        return EXIT_CODE_OK;
    case OPTION_IDS:
        r->result.options.has_ids = true;
        return EXIT_CODE_OK;
    case OPTION_THREADS:
        return numbers_read_whole(value, "--threads", THREADS_MAX, &r->threads);
    case OPTION_SHARD:
        r->has_shard = true;
        return read_shard(value, &r->shard, &r->shards);
    default:
        return which < RESULT_END     ? result_take(&r->result, which, value)
               : which < OPTION_COUNT ? grid_take(&r->from, which - OPTION_GRID, value)
                                      : options_read_test(options[which].name, value, &r->test);
    }
}

int cmd_voxelize(int count, char **words)
{
    voxelize_request r = {.paths = malloc((size_t)(count + 1) * sizeof *r.paths),
                          .threads = processors_here(),
                          .shard = 1,
                          .shards = 1,
                          .result.look = PREVIEW_LOOK_DEFAULT};
    if (!r.paths)
        return message_failure("out of memory for %d arguments", count);
    options_found found;
    int code = options_read(count, words, options, take, &r, &found);
    if (!code && !found.wants_help)
        code = request_check(&r, &found, options);
    reading_show(!r.result.is_quiet);
    if (!code)
        code = found.wants_help ? output_text(help) : voxelize_work(&r);
    free(r.paths);
    return code;
}
