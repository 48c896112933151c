/* cmd_partition.c - tribox partition: the triangles of a mesh sorted by tiles of a grid, for shards that read their own alone. */
#include "cmd.h"

#include "console/message.h"
#include "console/options.h"
#include "console/output.h"
#include "partition/partition_work.h"
#include "write/file_out.h"

static const char help[] = "tribox partition - sort the triangles of a mesh into the tiles of a grid\n"
                           "\n"
                           "Usage: tribox partition MESH --resolution N -o FOLDER [OPTION...]\n"
                           "       tribox partition MESH --cell S[,S,S] -o FOLDER [OPTION...]\n"
                           "\n"
                           "'tribox voxelize FOLDER --shard I/N' then reads the triangles of its own tiles and no others. FOLDER\n"
                           "must not be there yet. MESH is as for 'tribox overlap'.\n"
                           "\n" GRID_HELP "  -o, --out FOLDER        where the sorted triangles go\n"
                           "  -j, --json              print the summary as a JSON object\n"
                           "  -q, --quiet             print no summary and no progress\n" OPTIONS_HELP_HELP "\n"
                           "Exit codes: 0 success; 1 failure (a file, memory, the output); 2 wrong command line.\n"
                           "\n"
                           "Example:\n"
                           "  tribox partition big.ply --resolution 16384 -o big.tiles\n"
                           "  parallel tribox voxelize big.tiles --shard {}/64 -o big.{}.part ::: $(seq 64)\n"
                           "  tribox merge big.*.part -o big.npz\n";

enum { OPTION_OUT = GRID_END, OPTION_JSON, OPTION_QUIET };

static const option_entry options[] = {GRID_ENTRIES(0),
                                       [OPTION_OUT] = {"out", 'o', true},
                                       [OPTION_JSON] = {"json", 'j', false},
                                       [OPTION_QUIET] = {"quiet", 'q', false},
                                       {NULL, 0, false}};

static int take(void *request, int which, const char *value)
{
    partition_request *const r = request;
    switch (which) {
    case OPTION_OPERAND:
        return options_take_mesh(value, &r->from.mesh_path);
    case OPTION_OUT:
        r->out_path = value;
        return EXIT_CODE_OK;
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

static int check_request(const partition_request *r, const options_found *found)
{
    const int code = grid_check(&r->from, found, 0);
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
    partition_request r = {.out_path = NULL};
    options_found found;
    int code = options_read(count, words, options, take, &r, &found);
    if (!code && !found.wants_help)
        code = check_request(&r, &found);
    if (code)
        return code;
    return found.wants_help ? output_text(help) : partition_work(&r);
}
