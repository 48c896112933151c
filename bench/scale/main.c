/*
 * main.c - what do bricks cost against dense bits? CPU time, page faults included, and memory, by resolution.
 *
 * The ways take turns, round after round, each in a process of its own. Their cells have to be the same, and the bricks of dense
 * bits those that were kept, or the program fails.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/grid_about.h"
#include "common/header.h"
#include "common/mesh_list.h"
#include "common/whole.h"
#include "console/message.h"
#include "console/option_reader.h"
#include "scale_ways.h"

enum { RESOLUTIONS_MAX = 16 };

typedef struct settings {
    uint64_t rounds, tile;
    const char *kernel;
    uint32_t resolution[RESOLUTIONS_MAX];
    size_t resolutions;
    mesh_list meshes;
} settings;

static const char usage[] =
    "Usage: scale [--resolution N,N,...] [--rounds N] [--tile N] [--kernel NAME] [--quick] MESH...\n"
    "Times a mesh as dense bits of calloc and on large pages, and as bricks that are kept, or counted, and prints a table.\n"
    "  MESH             a mesh file; $TRIBOX_MESHES may name a folder to look in\n"
    "  --resolution N   cells along the longest side, or several; without it 1024,2048,4096,16384\n"
    "  --rounds N       rounds, of which the least times count; without it 5\n"
    "  --tile N         cells of a tile along an axis, a multiple of 8; without it 128\n"
    "  --kernel NAME    without it the widest\n"
    "  --quick          256 cells, one round\n";

/* Whether dense bits of 2^31 words would do. */
static bool is_for_dense(const tribox_grid *grid) { return tribox_window_words(grid->size) <= (size_t)1 << 31; }

static void print_way(const char *name, const scale_answer *a, const scale_answer *dense)
{
    printf("  %-8s %9.3f %8.3f %9.2f %9.1f", name, a->seconds, a->listing, 1e9 * a->seconds / (double)a->cells, a->megabytes);
    if (dense)
        printf(" %9.2f %9.1f", dense->seconds / a->seconds, dense->megabytes / a->megabytes);
    printf("\n");
}

/* The least time of each way, and the memory of the last round. */
static bool find_least(const scale_question *q, uint64_t rounds, bool has_dense, scale_answer least[WAYS])
{
    for (uint64_t round = 0; round < rounds; round++)
        for (scale_way way = has_dense ? WAY_DENSE : WAY_KEPT; way < WAYS; way++) {
            scale_answer a;
            if (!scale_answer_find(way, q, &a))
                return message_failure("%ux%ux%u cells: no answer; is there memory for it?", (unsigned)q->grid.size[0],
                                       (unsigned)q->grid.size[1], (unsigned)q->grid.size[2]) == 0;
            if (!round || a.seconds < least[way].seconds)
                least[way] = a;
        }
    return true;
}

static bool is_same(const scale_answer *a, const scale_answer *b)
{
    return a->cells == b->cells && a->bricks == b->bricks && a->sum == b->sum;
}

static bool run_grid(const mesh *m, uint32_t resolution, const settings *s)
{
    const scale_question q = {
        .soup = &m->soup, .grid = grid_about(m, resolution), .tile = (uint32_t)s->tile, .options = {.kernel = s->kernel}};
    static const char *const names[WAYS] = {"dense", "large", "kept", "counted"};
    const bool has_dense = is_for_dense(&q.grid);
    scale_answer least[WAYS];
    if (!find_least(&q, s->rounds, has_dense, least))
        return false;
    const scale_answer *const kept = &least[WAY_KEPT], *const counted = &least[WAY_COUNTED], *const dense = &least[WAY_DENSE];
    if (kept->cells != counted->cells || kept->bricks != counted->bricks ||
        (has_dense && (!is_same(kept, dense) || !is_same(kept, &least[WAY_LARGE]))))
        return message_failure("%u cells: the ways differ", (unsigned)resolution) == 0;
    printf(" %5u: %ux%ux%u cells, %llu set, %llu bricks, %zu pairs of triangle and tile, sum %016llx\n", (unsigned)resolution,
           (unsigned)q.grid.size[0], (unsigned)q.grid.size[1], (unsigned)q.grid.size[2], (unsigned long long)kept->cells,
           (unsigned long long)kept->bricks, kept->pairs, (unsigned long long)kept->sum);
    for (scale_way way = has_dense ? WAY_DENSE : WAY_KEPT; way < WAYS; way++)
        print_way(names[way], &least[way], has_dense && way != WAY_DENSE ? dense : NULL);
    fflush(stdout);
    return true;
}

static bool run_mesh(const char *path, const settings *s)
{
    mesh m;
    if (!mesh_list_read(path, &m))
        return false;
    printf("\n%s, %zu triangles\n  %-8s %9s %8s %9s %9s %9s %9s\n", mesh_list_name(path), m.soup.count, "", "CPU s", "lists",
           "ns a cell", "MB", "x faster", "x smaller");
    bool is_run = true;
    for (size_t i = 0; is_run && i < s->resolutions; i++)
        is_run = run_grid(&m, s->resolution[i], s);
    mesh_free(&m);
    return is_run;
}

enum { OPTION_RESOLUTION, OPTION_ROUNDS, OPTION_TILE, OPTION_KERNEL, OPTION_QUICK };
static const option_entry options[] = {{"resolution", 0, true}, {"rounds", 0, true}, {"tile", 0, true},
                                       {"kernel", 0, true},     {"quick", 0, false}, {NULL, 0, false}};

static int take_resolutions(settings *s, const char *value)
{
    s->resolutions = 0;
    while (s->resolutions < RESOLUTIONS_MAX) {
        const size_t length = strcspn(value, ",");
        char number[32] = "";
        uint64_t resolution;
        memcpy(number, value, length < sizeof number ? length : sizeof number - 1);
        const int code = whole_read(number, "resolution", 8, 1 << 20, &resolution);
        if (code)
            return code;
        s->resolution[s->resolutions++] = (uint32_t)resolution;
        if (!value[length])
            break;
        value += length + 1;
    }
    return EXIT_CODE_OK;
}

static int take(void *request, int which, const char *value)
{
    settings *const s = request;
    switch (which) {
    case OPTION_RESOLUTION:
        return take_resolutions(s, value);
    case OPTION_ROUNDS:
        return whole_read(value, "rounds", 1, 101, &s->rounds);
    case OPTION_TILE:
        return whole_read(value, "tile", 8, 1024, &s->tile);
    case OPTION_KERNEL:
        s->kernel = tribox_kernel_name(&(tribox_options){.kernel = value});
        return s->kernel ? EXIT_CODE_OK : message_usage("--kernel: there is no '%s' here; see tribox info", value);
    case OPTION_QUICK:
        s->resolution[0] = 256;
        s->resolutions = 1;
        s->rounds = 1;
        return EXIT_CODE_OK;
    default:
        return mesh_list_take(&s->meshes, value);
    }
}

int main(int argc, char **argv)
{
    options_found found;
    settings s = {
        .rounds = 5, .tile = 128, .kernel = tribox_kernel_name(NULL), .resolution = {1024, 2048, 4096, 16384}, .resolutions = 4};
    message_set_program("scale");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    if (!s.meshes.count)
        return message_usage("name a mesh file");
    const run r = {argc, argv, 0, machine_here()};
    header_text(stdout, "", &r);
    printf("kernel     %s\ntiles      %u cells along each axis\n", s.kernel, (unsigned)s.tile);
    fflush(stdout);
    for (size_t i = 0; i < s.meshes.count; i++)
        if (!run_mesh(s.meshes.path[i], &s))
            return EXIT_CODE_FAILURE;
    return EXIT_CODE_OK;
}
