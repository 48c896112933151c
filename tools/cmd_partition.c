/* cmd_partition.c - tribox partition: the triangles of a mesh sorted by tiles of a grid, for shards that read their own alone. */
#include "cmd.h"

#include <stdlib.h>

#include "console/memory.h"
#include "console/message.h"
#include "console/numbers.h"
#include "console/options.h"
#include "console/output.h"
#include "console/processors.h"
#include "partition/partition.h"
#include "partition/partition_work.h"
#include "write/file_out.h"

static const char help[] = "tribox partition - sort the triangles of a mesh into the tiles of a grid\n"
                           "\n"
                           "Usage: tribox partition MESH... --resolution N|--cell S[,S,S] -o FOLDER [OPTION...]\n"
                           "       tribox partition FOLDER... -o FOLDER [OPTION...]\n"
                           "\n"
                           "'tribox voxelize FOLDER --shard I/N' then reads only the triangles of its own tiles. FOLDER must not\n"
                           "exist yet. MESH is as for 'tribox overlap'; several meshes are taken as one, and so are several\n"
                           "partitions of one grid. Binary .stl, .ply, .f32 and .f64 may be larger than memory.\n"
                           "\n" GRID_HELP "  -o, --out FOLDER        where the sorted triangles go\n"
                           "      --ids               keep the numbers of the triangles, for 'tribox voxelize FOLDER --ids'\n"
                           "  -m, --memory SIZE       bytes, or 512M, 1G, to use for sorting; default: half of what is free\n"
                           "  -t, --threads T         1 to 256; default: one for each processor. The result is the same\n"
                           "  -j, --json              print the summary as a JSON object\n"
                           "  -q, --quiet             print no summary and no progress\n" OPTIONS_HELP_HELP "\n"
                           "Exit codes: 0 success; 1 failure (a file, memory, the output); 2 wrong command line.\n"
                           "\n"
                           "Example:\n"
                           "  tribox partition big.ply --resolution 16384 -o big.tiles\n"
                           "  parallel tribox voxelize big.tiles --shard {}/64 -o big.{}.npz ::: $(seq 64)\n"
                           "  tribox merge big.*.npz -o big.npz\n";

enum { OPTION_OUT = GRID_END, OPTION_IDS, OPTION_MEMORY, OPTION_THREADS, OPTION_JSON, OPTION_QUIET };

static const option_entry options[] = {GRID_ENTRIES(0),
                                       [OPTION_OUT] = {"out", 'o', true},
                                       [OPTION_IDS] = {"ids", 0, false},
                                       [OPTION_MEMORY] = {"memory", 'm', true},
                                       [OPTION_THREADS] = {"threads", 't', true},
                                       [OPTION_JSON] = {"json", 'j', false},
                                       [OPTION_QUIET] = {"quiet", 'q', false},
                                       {NULL, 0, false}};

static int take(void *request, int which, const char *value)
{
    partition_request *const r = request;
    switch (which) {
    case OPTION_OPERAND:
        r->from.mesh_path = r->count ? r->from.mesh_path : value;
        r->paths[r->count++] = value;
        return EXIT_CODE_OK;
    case OPTION_OUT:
        r->out_path = value;
        return EXIT_CODE_OK;
    case OPTION_IDS:
        r->has_ids = true;
        return EXIT_CODE_OK;
    case OPTION_MEMORY:
        return memory_read(value, &r->memory) ? EXIT_CODE_OK
                                              : message_usage("--memory: '%s' is no size, such as 512M or 1G", value);
    case OPTION_THREADS:
        return numbers_read_whole(value, "--threads", THREADS_MAX, &r->threads);
    case OPTION_JSON:
        r->wants_json = true;
        return EXIT_CODE_OK;
    case OPTION_QUIET:
        r->is_quiet = true;
        return EXIT_CODE_OK;
    default:
        return grid_take(&r->from, which, value);
    }
}

/* Partitions have their grid. */
static int check_partitions(const partition_request *r, const options_found *found)
{
    for (int which = 0; which < GRID_END; which++)
        if (options_has(found, which))
            return message_usage(
                "%s is a folder, so a partition, which has its grid: leave out --%s; or give meshes by their names",
                r->from.mesh_path, options[which].name);
    if (r->has_ids)
        return message_usage("%s is a folder, so a partition, which has ids or has none: leave out --ids", r->from.mesh_path);
    return EXIT_CODE_OK;
}

static int check_input(const partition_request *r, const options_found *found)
{
    const bool is_folder = r->count && partition_is_folder(r->paths[0]);
    for (size_t i = 1; i < r->count; i++) {
        if (partition_is_folder(r->paths[i]) != is_folder)
            return message_usage("%s is a %s and %s is a %s: give meshes alone or partitions alone", r->paths[0],
                                 is_folder ? "partition" : "mesh", r->paths[i], is_folder ? "mesh" : "partition");
        if (triangle_format_check(r->paths[i], r->from.format))
            return EXIT_CODE_USAGE;
    }
    return is_folder ? check_partitions(r, found) : grid_check(&r->from, found, 0);
}

static int check_request(const partition_request *r, const options_found *found)
{
    const int code = check_input(r, found);
    if (code)
        return code;
    if (!r->out_path)
        return message_usage("no output given; give -o FOLDER");
    if (file_out_is_stdout(r->out_path) || !r->out_path[0])
        return message_usage("-o: '%s' is not the name of a folder", r->out_path);
    if (r->wants_json && r->is_quiet)
        return message_usage("--json and --quiet exclude each other");
    return EXIT_CODE_OK;
}

int cmd_partition(int count, char **words)
{
    partition_request r = {.paths = malloc((size_t)(count + 1) * sizeof *r.paths), .threads = processors_here()};
    if (!r.paths)
        return message_failure("out of memory for %d arguments", count);
    options_found found;
    int code = options_read(count, words, options, take, &r, &found);
    if (!code && !found.wants_help)
        code = check_request(&r, &found);
    if (!code)
        code = found.wants_help ? output_text(help) : partition_work(&r);
    free(r.paths);
    return code;
}
