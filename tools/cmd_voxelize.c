/* cmd_voxelize.c - tribox voxelize: the cells of a grid that a mesh overlaps, as a file for other programs. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <string.h>

#include "console/message.h"
#include "console/numbers.h"
#include "console/option_reader.h"
#include "console/options.h"
#include "console/output.h"
#include "write/file_out.h"
#include "write/part.h"
#include "console/processors.h"
#include "voxelize/voxelize_work.h"

static const char help[] = "tribox voxelize - which cells of a grid does a mesh overlap?\n"
                           "\n"
                           "Usage: tribox voxelize MESH --resolution N -o FILE [OPTION...]\n"
                           "       tribox voxelize MESH --cell S[,S,S] -o FILE [OPTION...]\n"
                           "\n"
                           "Marks the cells of the surface, not those that it encloses. Cells are closed: a face on a plane of\n"
                           "the grid is in the cells of both sides. MESH is as for 'tribox overlap'.\n"
                           "\n"
                           "      --format WORD       stl, f32 or f64, whatever the name of MESH; standard input needs it\n"
                           "      --shift X,Y,Z|auto  subtract this from MESH first, in double; auto: near its corner\n"
                           "  -r, --resolution N      N cubic cells along the longest side of the mesh\n"
                           "  -c, --cell S[,S,S]      length of a cell, or its lengths along x, y and z\n"
                           "      --origin X,Y,Z      lower corner of the grid; default: that of the mesh\n"
                           "      --size NX,NY,NZ     number of cells; default: as many as hold the mesh\n" RESULT_HELP
                           "  -t, --threads T         1 to 256; default: one for each processor. The answer is the same\n"
                           "      --shard I/N         only part I, 1 to N, of N: whole layers, with memory for these alone.\n"
                           "                          'tribox merge' joins the N files\n" OPTIONS_TEST_HELP OPTIONS_HELP_HELP "\n"
                           "Exit codes: 0 success; 1 failure (a file, memory, the output); 2 wrong command line.\n"
                           "\n"
                           "Examples ('man tribox' has the details):\n"
                           "  tribox voxelize bunny.ply --resolution 256 -o bunny.npy --preview bunny.png --up y\n"
                           "  tribox voxelize part.stl --cell 0.5 --origin -100,-100,0 --size 400,400,200 -o part.raw\n"
                           "  parallel tribox voxelize big.ply --resolution 4096 --shard {}/8 -o big.{}.part ::: $(seq 8)\n"
                           "  tribox merge big.*.part -o big.raw\n"
                           "  generate | tribox voxelize - --format f32 -r 64 -o - --out-format npy | consume\n";

enum {
    OPTION_FORMAT = RESULT_END,
    OPTION_SHIFT,
    OPTION_RESOLUTION,
    OPTION_CELL,
    OPTION_ORIGIN,
    OPTION_SIZE,
    OPTION_THREADS,
    OPTION_SHARD,
    OPTION_ACCURACY,
    OPTION_AXES,
    OPTION_KERNEL
};

static const option_entry options[] = {RESULT_ENTRIES,
                                       [OPTION_FORMAT] = {"format", 0, true},
                                       [OPTION_SHIFT] = {"shift", 0, true},
                                       [OPTION_RESOLUTION] = {"resolution", 'r', true},
                                       [OPTION_CELL] = {"cell", 'c', true},
                                       [OPTION_ORIGIN] = {"origin", 0, true},
                                       [OPTION_SIZE] = {"size", 0, true},
                                       [OPTION_THREADS] = {"threads", 't', true},
                                       [OPTION_SHARD] = {"shard", 0, true},
                                       [OPTION_ACCURACY] = {"accuracy", 0, true},
                                       [OPTION_AXES] = {"axes", 0, true},
                                       [OPTION_KERNEL] = {"kernel", 0, true},
                                       {NULL, 0, false}};

enum { CELLS_MAX = INT32_MAX };

static int read_cell(const char *text, double cell[3], unsigned *decimals)
{
    const bool is_one = !strpbrk(text, NUMBERS_BLANKS ",");
    if (!numbers_read(text, "--cell", is_one ? "S" : "SX,SY,SZ", is_one ? 1 : 3, cell, decimals))
        return EXIT_CODE_USAGE;
    if (is_one) {
        cell[1] = cell[2] = cell[0];
        *decimals *= 7;
    }
    for (int a = 0; a < 3; a++)
        if (!(cell[a] > 0))
            return message_usage("--cell: %.9g is not greater than 0", cell[a]);
    return EXIT_CODE_OK;
}

static int read_shard(const char *text, uint32_t *shard, uint32_t *shards)
{
    char number[16];
    const char *slash = strchr(text, '/');
    const size_t length = slash ? (size_t)(slash - text) : 0;
    if (!slash || length >= sizeof number)
        return message_usage("--shard: '%s' is not I/N, such as 3/8", text);
    memcpy(number, text, length);
    number[length] = '\0';
    const int code = numbers_read_whole(slash + 1, "--shard I/N, its N", CELLS_MAX, shards);
    return code ? code : numbers_read_whole(number, "--shard I/N, its I", *shards, shard);
}

static int take(void *request, int which, const char *value)
{
    voxelize_request *const r = request;
    switch (which) {
    case OPTION_OPERAND:
        return options_take_mesh(value, &r->mesh_path);
    case OPTION_FORMAT:
        return triangle_format_read(value, &r->format);
    case OPTION_SHIFT:
        return mesh_shift_read(value, &r->shift);
    case OPTION_RESOLUTION:
        return numbers_read_whole(value, "--resolution", CELLS_MAX, &r->grid.resolution);
    case OPTION_CELL:
        return read_cell(value, r->grid.cell, &r->grid.cell_decimals);
    case OPTION_ORIGIN:
        r->grid.has_origin = true;
        return numbers_read(value, "--origin", "X,Y,Z", 3, r->grid.origin, &r->grid.origin_decimals) ? EXIT_CODE_OK
                                                                                                     : EXIT_CODE_USAGE;
    case OPTION_SIZE:
        r->grid.has_size = true;
        return numbers_read_sizes(value, "--size", CELLS_MAX, r->grid.size);
    case OPTION_THREADS:
        return numbers_read_whole(value, "--threads", THREADS_MAX, &r->threads);
    case OPTION_SHARD:
        r->is_part = true;
        return read_shard(value, &r->shard, &r->shards);
    default:
        return which < RESULT_END ? result_take(&r->result, which, value) : options_read_test(options[which].name, value, &r->test);
    }
}

/* What every command line needs, and what excludes each other. */
static int check_request(voxelize_request *r, const options_found *found)
{
    const bool has_resolution = options_has(found, OPTION_RESOLUTION), has_cell = options_has(found, OPTION_CELL);
    const char *out = r->result.out_path;
    if (!r->mesh_path)
        return message_usage("no mesh file given");
    if (triangle_format_check(r->mesh_path, r->format))
        return EXIT_CODE_USAGE;
    if (has_resolution == has_cell)
        return message_usage(has_cell ? "--resolution and --cell exclude each other"
                                      : "no grid given; give --resolution or --cell");
    if (!out)
        return message_usage("no output given; give -o FILE");
    if (!file_out_is_stdout(out) && r->is_part != part_is_name(out))
        return message_usage(r->is_part ? "-o: '%s' does not end in .part, as the file of a shard must"
                                        : "-o: '%s' is the name of a part, which needs --shard",
                             out);
    if (r->is_part && r->result.preview_path)
        return message_usage("--preview needs all layers: give it to 'tribox merge'");
    return result_check(&r->result, found, r->is_part);
}

int cmd_voxelize(int count, char **words)
{
    voxelize_request r = {.threads = processors_here(), .shard = 1, .shards = 1, .result.look = PREVIEW_LOOK_DEFAULT};
    options_found found;
    int code = options_read(count, words, options, take, &r, &found);
    if (!code && !found.wants_help)
        code = check_request(&r, &found);
    if (code)
        return code;
    return found.wants_help ? output_text(help) : voxelize_work(&r);
}
