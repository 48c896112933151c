/* cmd_voxelize.c - tribox voxelize: the cells of a grid that a mesh overlaps, as a file for other programs. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <string.h>

#include "voxelize/layers.h"
#include "console/message.h"
#include "console/numbers.h"
#include "console/option_reader.h"
#include "console/options.h"
#include "console/output.h"
#include "write/part.h"
#include "console/processors.h"
#include "voxelize/voxelize_work.h"

static const char help[] = "tribox voxelize - which cells of a grid does a mesh overlap?\n"
                           "\n"
                           "Usage: tribox voxelize MESH --resolution N -o OUT.(npy|binvox|vox|raw) [OPTION...]\n"
                           "       tribox voxelize MESH --cell S[,S,S] -o OUT.(npy|binvox|vox|raw) [OPTION...]\n"
                           "       tribox voxelize MESH ... --shard I/N -o OUT.part [OPTION...]\n"
                           "\n"
                           "MESH is a file that libassimp reads: PLY, STL, OBJ, OFF, glTF and about 40 other formats. Mesh and\n"
                           "grid share one length unit, whichever. Cells are closed: a face on a plane of the grid is in the\n"
                           "cells of both its sides. Only the surface is marked, not what it encloses.\n"
                           "\n"
                           "The grid:\n"
                           "  --resolution N            N cubic cells along the longest side of the mesh\n"
                           "  --cell S[,S,S]            the length of a cell, or its lengths along x, y and z\n"
                           "  --origin X,Y,Z            the lower corner; default: that of the mesh\n"
                           "  --size NX,NY,NZ           how many cells; default: as many as hold the mesh\n"
                           "\n"
                           "The answer:\n"
                           "  -o FILE                   .npy: NumPy, bool, array[k, j, i]; .binvox; .vox: MagicaVoxel;\n"
                           "                            .raw: the bits alone. 'man tribox' has the formats\n"
                           "  --preview FILE.png        a picture of the cells\n"
                           "  --up AXIS                 what is up in it: x, y, z, or -x, -y, -z. Default: z\n"
                           "  --json                    the summary as a JSON object\n"
                           "  --quiet                   no summary and no progress\n"
                           "\n"
                           "The work:\n"
                           "  --threads T               how many threads; default: one for each processor. Changes no bit\n"
                           "  --shard I/N               only part I of N, from 1 to N: whole layers, memory for these alone.\n"
                           "                            'tribox merge' joins the N files\n"
                           "  --accuracy WORD           exact (default), conservative or fast\n"
                           "  --axes WORD,...           only some axes: box (3), plane (1), edges (9); default: all\n"
                           "  --kernel NAME             avx512, avx2, sse2, neon or scalar; default: the best here\n"
                           "  --help                    this text\n"
                           "\n"
                           "Files appear under their names when all of them is written, never in part.\n"
                           "\n"
                           "Exit codes: 0 success; 1 failure (a file, memory, a kernel that cannot run here);\n"
                           "2 wrong command line.\n"
                           "\n"
                           "Examples:\n"
                           "  tribox voxelize bunny.ply --resolution 256 -o bunny.npy --preview bunny.png --up y\n"
                           "  tribox voxelize part.stl --cell 0.5 --origin -100,-100,0 --size 400,400,200 -o part.raw\n"
                           "  parallel tribox voxelize big.ply --resolution 4096 --shard {}/8 -o big.{}.part ::: $(seq 8)\n"
                           "  tribox merge big.*.part -o big.npy\n";

enum {
    OPTION_RESOLUTION,
    OPTION_CELL,
    OPTION_ORIGIN,
    OPTION_SIZE,
    OPTION_OUT,
    OPTION_PREVIEW,
    OPTION_UP,
    OPTION_JSON,
    OPTION_QUIET,
    OPTION_THREADS,
    OPTION_SHARD,
    OPTION_ACCURACY,
    OPTION_AXES,
    OPTION_KERNEL
};

static const option_entry options[] = {[OPTION_RESOLUTION] = {"resolution", 'r', true},
                                       [OPTION_CELL] = {"cell", 'c', true},
                                       [OPTION_ORIGIN] = {"origin", 0, true},
                                       [OPTION_SIZE] = {"size", 0, true},
                                       [OPTION_OUT] = {"out", 'o', true},
                                       [OPTION_PREVIEW] = {"preview", 'p', true},
                                       [OPTION_UP] = {"up", 0, true},
                                       [OPTION_JSON] = {"json", 'j', false},
                                       [OPTION_QUIET] = {"quiet", 'q', false},
                                       [OPTION_THREADS] = {"threads", 't', true},
                                       [OPTION_SHARD] = {"shard", 0, true},
                                       [OPTION_ACCURACY] = {"accuracy", 0, true},
                                       [OPTION_AXES] = {"axes", 0, true},
                                       [OPTION_KERNEL] = {"kernel", 0, true},
                                       {NULL, 0, false}};

enum { CELLS_MOST = INT32_MAX };

static int read_cell(const char *text, float cell[3])
{
    const bool is_one = !strpbrk(text, NUMBERS_BLANKS ",");
    if (!numbers_read(text, "--cell", is_one ? "S" : "SX,SY,SZ", is_one ? 1 : 3, cell))
        return EXIT_CODE_USAGE;
    if (is_one)
        cell[1] = cell[2] = cell[0];
    for (int a = 0; a < 3; a++)
        if (!(cell[a] > 0))
            return message_usage("--cell: %.9g is not greater than 0", (double)cell[a]);
    return EXIT_CODE_OK;
}

static int read_shard(const char *text, uint32_t *shard, uint32_t *shards)
{
    char number[16];
    const char *slash = strchr(text, '/');
    const size_t length = slash ? (size_t)(slash - text) : 0;
    if (!slash || length >= sizeof number)
        return message_usage("--shard: '%s' is not I/N, as 3/8", text);
    memcpy(number, text, length);
    number[length] = '\0';
    const int code = numbers_read_whole(slash + 1, "--shard I/N, its N", CELLS_MOST, shards);
    return code ? code : numbers_read_whole(number, "--shard I/N, its I", *shards, shard);
}

static int take(void *request, int which, const char *value)
{
    voxelize_request *const r = request;
    switch (which) {
    case OPTION_OPERAND:
        return options_take_mesh(value, &r->mesh_path);
    case OPTION_RESOLUTION:
        return numbers_read_whole(value, "--resolution", CELLS_MOST, &r->grid.resolution);
    case OPTION_CELL:
        return read_cell(value, r->grid.cell);
    case OPTION_ORIGIN:
        r->grid.has_origin = true;
        return numbers_read(value, "--origin", "X,Y,Z", 3, r->grid.origin) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
    case OPTION_SIZE:
        r->grid.has_size = true;
        return numbers_read_sizes(value, "--size", CELLS_MOST, r->grid.size);
    case OPTION_OUT:
        r->out_path = value;
        return EXIT_CODE_OK;
    case OPTION_PREVIEW:
        r->preview_path = value;
        return EXIT_CODE_OK;
    case OPTION_UP:
        return preview_read_up(value, &r->up);
    case OPTION_THREADS:
        return numbers_read_whole(value, "--threads", LAYERS_THREADS_MOST, &r->threads);
    case OPTION_SHARD:
        r->is_part = true;
        return read_shard(value, &r->shard, &r->shards);
    case OPTION_JSON:
        r->wants_json = true;
        return EXIT_CODE_OK;
    case OPTION_QUIET:
        r->is_quiet = true;
        return EXIT_CODE_OK;
    default:
        return options_read_test(options[which].name, value, &r->test);
    }
}

/* What every command line needs, and what excludes each other. */
static int check_request(voxelize_request *r, const options_found *found)
{
    const bool has_resolution = options_has(found, OPTION_RESOLUTION), has_cell = options_has(found, OPTION_CELL);
    if (!r->mesh_path)
        return message_usage("no mesh file given");
    if (has_resolution == has_cell)
        return message_usage(has_cell ? "--resolution and --cell exclude each other"
                                      : "no grid given: --resolution or --cell is needed");
    if (!r->out_path)
        return message_usage("no output given: -o FILE is needed");
    if (r->is_part != part_is_name(r->out_path))
        return message_usage(r->is_part ? "-o: '%s' does not end in .part, as the file of a shard has to"
                                        : "-o: '%s' is the name of a part, which needs --shard",
                             r->out_path);
    if (r->is_part && r->preview_path)
        return message_usage("--preview needs all layers: give it to 'tribox merge'");
    if (options_has(found, OPTION_UP) && !r->preview_path)
        return message_usage("--up needs --preview");
    if (r->wants_json && r->is_quiet)
        return message_usage("--json and --quiet exclude each other");
    if (!r->is_part && !(r->format = volume_format_of(r->out_path)))
        return EXIT_CODE_USAGE;
    return preview_check(r->preview_path, "--preview");
}

int cmd_voxelize(int count, char **words)
{
    voxelize_request r = {.threads = processors_here(), .shard = 1, .shards = 1, .up = PICTURE_UP_Z};
    options_found found;
    int code = options_read(count, words, options, take, &r, &found);
    if (!code && !found.wants_help)
        code = check_request(&r, &found);
    if (code)
        return code;
    return found.wants_help ? output_text(help) : voxelize_work(&r);
}
