/*
 * ids.c - what does it cost to know the lowest triangle of each cell, or all of them? A window at once, in memory that is new and
 * in memory that is not, and bricks, tile by tile. CPU time.
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
                            "Times voxels and bricks of a mesh without ids, with the lowest triangle of each cell, and with all.\n"
                            "  MESH        a mesh file; $TRIBOX_MESHES may name a folder to look in\n"
                            "  --rounds N  rounds, of which the least times count; without it 5\n"
                            "  --cells N   along the longest side; without it 64, 256 and 1024\n";

enum { SIDE = 128, SIDE_IDS = 64, LISTED_MOST = 1 << 28 };

typedef struct settings {
    uint64_t rounds, cells;
    mesh_list meshes;
} settings;

/* Of a row of the table, in seconds. */
typedef struct answer {
    double window, cells, loop, window_ids, window_lists, bricks, bricks_ids, bricks_lists;
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

static int take_lists(void *cells, const uint32_t at[3], const uint64_t bits[8], const uint32_t starts[513], const uint32_t *list)
{
    *(uint64_t *)cells += list[starts[512] - 1];
    return take(cells, at, bits);
}

/* Both passes, in memory that is not new but in the first round. */
static bool run_lists(const tribox_soup *soup, const tribox_grid *grid, uint64_t rounds, answer *a)
{
    const size_t cells = (size_t)grid->size[0] * grid->size[1] * grid->size[2];
    size_t *const starts = malloc((cells + 1) * sizeof *starts);
    bool is = starts && !tribox_cell_lists(soup, grid, NULL, NULL, starts, NULL);
    uint32_t *const list = is ? malloc((starts[cells] + 1) * sizeof *list) : NULL;
    for (uint64_t round = 0; list && round <= rounds; round++) {
        const double from = processor_time();
        is = is && !tribox_cell_lists(soup, grid, NULL, NULL, starts, NULL) &&
             !tribox_cell_lists(soup, grid, NULL, NULL, starts, list);
        keep_least(&a->window_lists, from);
    }
    is = is && list;
    free(list);
    free(starts);
    return is;
}

/* What anyone writes in place of tribox_window_cells. Returns how many cells are set. */
static size_t list_by_loop(const uint64_t *occupied, const uint32_t size[3], uint32_t (*to)[3])
{
    const uint32_t words = (size[0] + 63) / 64;
    size_t count = 0;
    for (uint32_t k = 0; k < size[2]; k++)
        for (uint32_t j = 0; j < size[1]; j++)
            for (uint32_t w = 0; w < words; w++)
                for (uint64_t left = *occupied++; left; left &= left - 1) { /* no bit is set past the end of a row */
                    to[count][0] = 64 * w + (uint32_t)__builtin_ctzll(left);
                    to[count][1] = j;
                    to[count++][2] = k;
                }
    return count;
}

/* Into the same memory, which is not new. */
static bool run_cells(const uint64_t *occupied, const uint32_t size[3], uint64_t rounds, answer *a)
{
    const size_t count = tribox_window_cells(occupied, size, NULL);
    uint32_t(*const cells)[3] = malloc((count + 1) * sizeof *cells);
    bool is = cells && list_by_loop(occupied, size, cells) == count;
    for (uint64_t round = 0; is && round < rounds; round++) {
        double from = processor_time();
        is = tribox_window_cells(occupied, size, cells) == count;
        keep_least(&a->cells, from);
        from = processor_time();
        is = is && list_by_loop(occupied, size, cells) == count;
        keep_least(&a->loop, from);
    }
    free(cells);
    return is;
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
    is = is && run_cells(occupied, grid->size, rounds, a);
    free(occupied);
    free(ids);
    return is;
}

static size_t longest_list(const size_t *starts, size_t count)
{
    size_t longest = 0;
    for (size_t t = 0; t < count; t++)
        longest = starts[t + 1] - starts[t] > longest ? starts[t + 1] - starts[t] : longest;
    return longest;
}

/* Bits, ids or lists: where the least time goes says which. */
static bool run_bricks(const tribox_soup *soup, const tribox_grid *grid, answer *a, double *least)
{
    const uint32_t side = least == &a->bricks ? SIDE : SIDE_IDS;
    const tribox_tiles all = {side, 0, tribox_tile_count(grid->size, side)};
    const double from = processor_time();
    size_t *const starts = malloc((all.count + 1) * sizeof *starts);
    bool is = starts && !tribox_tile_lists(soup, grid, &all, NULL, starts, NULL);
    void *const scratch = !is                         ? NULL
                          : least == &a->bricks_lists ? malloc(tribox_bricks_lists_bytes(side, longest_list(starts, all.count)))
                                                      : malloc(tribox_bricks_ids_bytes(side));
    uint32_t *const list = is ? malloc((starts[all.count] + 1) * sizeof *list) : NULL;
    uint64_t cells = 0;
    const tribox_sink sink = {take, &cells};
    const tribox_ids_sink ids_sink = {take_ids, &cells};
    const tribox_lists_sink lists_sink = {take_lists, &cells};
    is = list && scratch && !tribox_tile_lists(soup, grid, &all, NULL, starts, list) &&
         !(least == &a->bricks       ? tribox_bricks(soup, grid, &all, starts, list, NULL, scratch, &sink, NULL)
           : least == &a->bricks_ids ? tribox_bricks_ids(soup, grid, &all, starts, list, NULL, scratch, &ids_sink, NULL)
                                     : tribox_bricks_lists(soup, grid, &all, starts, list, NULL, scratch, &lists_sink, NULL));
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
    if ((double)grid.size[0] * grid.size[1] * grid.size[2] <= LISTED_MOST)
        is = is && run_lists(&m->soup, &grid, rounds, &a);
    for (uint64_t round = 0; is && round < rounds; round++)
        is = run_bricks(&m->soup, &grid, &a, &a.bricks) && run_bricks(&m->soup, &grid, &a, &a.bricks_ids) &&
             run_bricks(&m->soup, &grid, &a, &a.bricks_lists);
    if (!is)
        return message_failure("%u cells: not enough memory", (unsigned)resolution) == 0;
    printf("  %5u %9.1f %6.2f %6.2f %9.1f %6.2f %9.1f %6.1f %9.1f %6.2f %9.1f %9.1f %6.2f %9.1f %6.2f\n", (unsigned)resolution,
           1e3 * a.window, 1e3 * a.cells, 1e3 * a.loop, 1e3 * a.window_ids, a.window_ids / a.window, 1e3 * first, first / a.window,
           1e3 * a.window_lists, a.window_lists / a.window_ids, 1e3 * a.bricks, 1e3 * a.bricks_ids, a.bricks_ids / a.bricks,
           1e3 * a.bricks_lists, a.bricks_lists / a.bricks_ids);
    fflush(stdout);
    return true;
}

static bool run_mesh(const char *path, const settings *s)
{
    static const uint32_t cells[] = {64, 256, 1024};
    mesh m;
    if (!mesh_list_read(path, &m))
        return false;
    printf("\n%s, %zu triangles\n  %5s %9s %6s %6s %9s %6s %9s %6s %9s %6s %9s %9s %6s %9s %6s\n", path, m.soup.count, "cells",
           "window", "cells", "loop", "ids", "x", "new", "x", "lists", "x ids", "bricks", "ids", "x", "lists", "x ids");
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
    printf(
        "ms of CPU time; a window's bits, to list its cells, and by a plain loop; with ids, and times that without: in memory\n"
        "that is not new and that is; all triangles of each cell, and times ids, unless there are too many cells (0); bricks with\n"
        "their tiles' lists, of tiles of %d, with ids of %d\n",
        SIDE, SIDE_IDS);
    for (size_t n = 0; n < s.meshes.count; n++)
        if (!run_mesh(s.meshes.path[n], &s))
            return EXIT_CODE_FAILURE;
    return EXIT_CODE_OK;
}
