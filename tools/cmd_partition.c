/* cmd_partition.c - tribox partition: the triangles of a mesh sorted by tiles of a grid, for shards that read their own alone. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <inttypes.h>
#include <stdio.h>

#include "console/clock.h"
#include "console/interrupt.h"
#include "console/system.h"
#include "console/message.h"
#include "console/numbers.h"
#include "console/options.h"
#include "console/output.h"
#include "partition/partition_make.h"
#include "voxelize/result_options.h"
#include "write/file_out.h"

static const char *positions(const partition_header *h) { return h->position_bytes == sizeof(double) ? "float64" : "float32"; }

static void print_summary(const partition_answer *a)
{
    const partition_header *const h = &a->header;
    printf("mesh         %s", a->r->paths[0]);
    if (a->r->count > 1)
        printf(" and %zu more", a->r->count - 1);
    printf("\ntriangles    %" PRIu64 "\npositions    %s\n", h->triangles, positions(h));
    voxelize_print_grid(&a->cells, a->is_shifted);
    printf("tiles        %" PRIu64 " of %u cells along a side, of %zu in the grid\n", h->records, h->tile,
           tribox_tile_count(h->size, h->tile));
    printf("sorted       %" PRIu64 " triangles, %.3f for each of the mesh\n", h->places, (double)h->places / (double)h->triangles);
    if (h->number_bytes)
        puts("ids          the number of each triangle");
    printf("time         %.3f s with %" PRIu32 " thread%s, %.1f ns a triangle\nwritten      %s\n", a->seconds, a->r->threads,
           a->r->threads == 1 ? "" : "s", 1e9 * a->seconds / (double)h->triangles, a->r->out_path);
}

static void print_json(const partition_answer *a)
{
    const partition_header *const h = &a->header;
    json j = json_to(stdout);
    json_open_object(&j, NULL);
    json_string(&j, "mesh", a->r->paths[0]);
    json_whole(&j, "inputs", a->r->count);
    json_whole(&j, "triangles", h->triangles);
    json_string(&j, "positions", positions(h));
    json_whole(&j, "not_finite", h->not_finite);
    voxelize_json_grid(&j, &a->cells, a->is_shifted);
    json_whole(&j, "tile", h->tile);
    json_whole(&j, "tiles", tribox_tile_count(h->size, h->tile));
    json_whole(&j, "filled_tiles", h->records);
    json_whole(&j, "sorted", h->places);
    if (h->number_bytes)
        json_bool(&j, "ids", true);
    json_whole(&j, "spilled_bytes", a->spilled);
    json_whole(&j, "threads", a->r->threads);
    json_number(&j, "seconds", 6, a->seconds);
    json_string(&j, "output", a->r->out_path);
    json_close(&j);
}

static int report(const partition_answer *a)
{
    if (a->r->wants_json)
        print_json(a);
    else if (!a->r->is_quiet)
        print_summary(a);
    return output_flush();
}

/* From the meshes to the folder and the summary. Returns an exit_code. */
static int partition_work(const partition_request *r)
{
    partition_answer a = {.r = r};
    const double start = clock_seconds();
    interrupt_advise("nothing was written; run it again");
    const int code = partition_make(&a);
    a.seconds = clock_seconds() - start;
    return code ? code : report(&a);
}

/* ----------------------------------------------------------------------------------------------------------------- command line */

static const char help[] = "tribox partition - sort the triangles of a mesh into the tiles of a grid\n"
                           "\n"
                           "Usage: tribox partition MESH... --resolution N|--cell S[,S,S] -o FOLDER [OPTION...]\n"
                           "       tribox partition FOLDER... -o FOLDER [OPTION...]\n"
                           "\n"
                           "'tribox voxelize FOLDER --shard I/N' then reads only the triangles of its own tiles. FOLDER must not\n"
                           "exist yet. MESH is as for 'tribox overlap'; several meshes count as one, and so do several\n"
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

enum { OPTION_MEMORY = GRID_END };

static const option_entry options[] = {GRID_ENTRIES(0),
                                       [OPTION_MEMORY] = {"memory", 'm', true},
                                       {"threads", 't', OPTION_COUNTS_THREADS(partition_request, threads)},
                                       {"out", 'o', OPTION_NAMES(partition_request, out_path)},
                                       {"ids", 0, OPTION_SETS(partition_request, has_ids)},
                                       {"json", 'j', OPTION_SETS(partition_request, wants_json)},
                                       {"quiet", 'q', OPTION_SETS(partition_request, is_quiet)},
                                       {NULL, 0, false}};

static int take(void *request, int which, const char *value)
{
    partition_request *const r = request;
    return which == OPTION_OPERAND  ? EXIT_CODE_OK
           : which == OPTION_MEMORY ? numbers_read_memory(value, &r->memory)
                                    : grid_take(&r->from, which, value);
}

/* Partitions have their grid. */
static int check_partitions(const partition_request *r, const options_found *found)
{
    const int code = grid_refuse(&r->from, found, options, 0);
    if (!code && r->has_ids)
        return message_usage("%s is a folder, so a partition, which has ids or has none: leave out --ids", r->from.mesh_path);
    return code;
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

static int answer(void *request, const options_found *found)
{
    partition_request *const r = request;
    r->paths = found->operands;
    r->count = found->count;
    r->from.mesh_path = r->count ? r->paths[0] : NULL;
    const int code = check_input(r, found);
    if (code)
        return code;
    if (!r->out_path)
        return message_usage("no output given; give -o FOLDER");
    if (file_out_is_stdout(r->out_path) || !r->out_path[0])
        return message_usage("-o: '%s' is not the name of a folder", r->out_path);
    return partition_work(r);
}

int cmd_partition(int count, char **words)
{
    partition_request r = {.threads = processors_here()};
    return options_answer(&(options_command){help, options, take, answer}, count, words, &r);
}
