/*
 * ids.c - what does it cost to know the triangle of each cell? A window at once, in memory that is new and in memory that is not,
 * and bricks, tile by tile. CPU time.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "common/grid_about.h"
#include "common/header.h"
#include "common/mesh_list.h"
#include "common/whole.h"
#include "console/message.h"
#include "console/option_reader.h"

static const char usage[] = "Usage: ids [--rounds N] [--cells N] MESH...\n"
                            "Times voxels and bricks of a mesh without ids, and with the lowest triangle of each cell.\n"
                            "  MESH        a mesh file; $TRIBOX_MESHES may name a folder to look in\n"
                            "  --rounds N  rounds, of which the least times count; without it 5\n"
                            "  --cells N   along the longest side; without it 64, 256 and 1024\n";

enum { SIDE = 128, SIDE_IDS = 64 };

typedef struct settings {
    uint64_t rounds, cells;
    mesh_list meshes;
} settings;

/* Of a row of the table, in seconds. */
typedef struct answer {
    double window, window_ids, bricks, bricks_ids;
} answer;

static double processor_time(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void keep_least(double *least, double from)
{
    const double seconds = processor_time() - from;
    *least = *least > 0 && *least < seconds ? *least : seconds;
}

static int take(void *cells, const uint32_t at[3], const uint64_t bits[8])
{
    (void)at;
    *(uint64_t *)cells += bits[0];
    return 0;
}

static int take_ids(void *cells, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    *(uint64_t *)cells += ids[0];
    return take(cells, at, bits);
}

/* first: with ids, of memory that was never touched. */
static bool run_window(const tribox_soup *soup, const tribox_grid *grid, uint64_t rounds, double *first, answer *a)
{
    const size_t words = tribox_window_words(grid->size);
    uint64_t *const occupied = calloc(words, sizeof *occupied);
    uint32_t *const ids = malloc((size_t)grid->size[0] * grid->size[1] * grid->size[2] * sizeof *ids);
    bool is = occupied && ids;
    for (uint64_t round = 0; is && round <= rounds; round++) {
        memset(occupied, 0, words * sizeof *occupied);
        double from = processor_time();
        is = !tribox_voxelize(soup, grid, NULL, NULL, occupied, NULL);
        keep_least(&a->window, from);
        memset(occupied, 0, words * sizeof *occupied);
        from = processor_time();
        is = is && !tribox_voxelize_ids(soup, 0, grid, NULL, NULL, occupied, ids, NULL);
        keep_least(round ? &a->window_ids : first, from);
    }
    free(occupied);
    free(ids);
    return is;
}

static bool run_bricks(const tribox_soup *soup, const tribox_grid *grid, uint32_t side, double *least)
{
    const tribox_tiles all = {side, 0, tribox_tile_count(grid->size, side)};
    const double from = processor_time();
    size_t *const starts = malloc((all.count + 1) * sizeof *starts);
    void *const scratch = malloc(side == SIDE ? tribox_bricks_bytes(side) : tribox_bricks_ids_bytes(side));
    bool is = starts && scratch && !tribox_tile_lists(soup, grid, &all, NULL, starts, NULL);
    uint32_t *const list = is ? malloc((starts[all.count] + 1) * sizeof *list) : NULL;
    uint64_t cells = 0;
    const tribox_sink sink = {take, &cells};
    const tribox_ids_sink ids_sink = {take_ids, &cells};
    is = list && !tribox_tile_lists(soup, grid, &all, NULL, starts, list) &&
         !(side == SIDE ? tribox_bricks(soup, grid, &all, starts, list, NULL, scratch, &sink, NULL)
                        : tribox_bricks_ids(soup, grid, &all, starts, list, NULL, scratch, &ids_sink, NULL));
    free(list);
    free(scratch);
    free(starts);
    keep_least(least, from);
    return is;
}

static bool run_grid(const mesh *m, uint32_t resolution, uint64_t rounds)
{
    const tribox_grid grid = grid_about(m, resolution);
    answer a = {.window = 0};
    double first = 0;
    bool is = run_window(&m->soup, &grid, rounds, &first, &a);
    for (uint64_t round = 0; is && round < rounds; round++)
        is = run_bricks(&m->soup, &grid, SIDE, &a.bricks) && run_bricks(&m->soup, &grid, SIDE_IDS, &a.bricks_ids);
    if (!is)
        return message_failure("%u cells: not enough memory", (unsigned)resolution) == 0;
    printf("  %5u %9.1f %9.1f %6.2f %9.1f %6.1f %9.1f %9.1f %6.2f\n", (unsigned)resolution, 1e3 * a.window, 1e3 * a.window_ids,
           a.window_ids / a.window, 1e3 * first, first / a.window, 1e3 * a.bricks, 1e3 * a.bricks_ids, a.bricks_ids / a.bricks);
    fflush(stdout);
    return true;
}

static bool run_mesh(const char *path, const settings *s)
{
    static const uint32_t cells[] = {64, 256, 1024};
    mesh m;
    if (!mesh_list_read(path, &m))
        return false;
    printf("\n%s, %zu triangles\n  %5s %9s %9s %6s %9s %6s %9s %9s %6s\n", path, m.soup.count, "cells", "window", "ids", "x", "new",
           "x", "bricks", "ids", "x");
    bool is_run = true;
    for (size_t n = 0; is_run && n < (s->cells ? 1 : sizeof cells / sizeof *cells); n++)
        is_run = run_grid(&m, s->cells ? (uint32_t)s->cells : cells[n], s->rounds);
    mesh_free(&m);
    return is_run;
}

enum { OPTION_ROUNDS, OPTION_CELLS };
static const option_entry options[] = {{"rounds", 0, true}, {"cells", 0, true}, {NULL, 0, false}};

static int take_option(void *request, int which, const char *value)
{
    settings *const s = request;
    switch (which) {
    case OPTION_ROUNDS:
        return whole_read(value, "rounds", 1, 101, &s->rounds);
    case OPTION_CELLS:
        return whole_read(value, "cells", 8, 2048, &s->cells);
    default:
        return mesh_list_take(&s->meshes, value);
    }
}

int main(int argc, char **argv)
{
    options_found found;
    settings s = {.rounds = 5};
    message_set_program("ids");
    const int code = options_read(argc, argv, options, take_option, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    if (!s.meshes.count)
        return message_usage("name a mesh file");
    const run r = {argc, argv, 0, machine_here()};
    header_text(stdout, "", &r);
    printf("ms of CPU time; with ids, and times that without: a window, in memory that is not new and that is; bricks with their "
           "lists,\n"
           "of tiles of %d, with ids of %d\n",
           SIDE, SIDE_IDS);
    for (size_t n = 0; n < s.meshes.count; n++)
        if (!run_mesh(s.meshes.path[n], &s))
            return EXIT_CODE_FAILURE;
    return EXIT_CODE_OK;
}
