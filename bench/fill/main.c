/*
 * main.c - what does filling cost against the surface? CPU time, page faults included: all memory was never touched before.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "common/grid_about.h"
#include "common/header.h"
#include "common/mesh_list.h"
#include "common/whole.h"
#include "console/message.h"
#include "console/option_reader.h"

enum { RESOLUTIONS = 2 };

typedef enum step { SURFACE, OUTSIDE, PARITY, STEPS } step;

typedef struct settings {
    uint64_t rounds;
    uint32_t resolution[RESOLUTIONS];
    mesh_list meshes;
} settings;

static const char usage[] =
    "Usage: fill [--rounds N] [--quick] MESH...\n"
    "Times the surface of a mesh, and what fills it, in grids of 512 and 1024 cells along the longest side.\n"
    "  MESH        a mesh file; $TRIBOX_MESHES may name a folder to look in\n"
    "  --rounds N  rounds, of which the least times count; without it 5\n"
    "  --quick     64 and 128 cells, one round\n";

static double processor_time(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef struct answer {
    double seconds[STEPS];
    size_t outside, parity, odd_rows;
} answer;

static bool find_answer(const mesh *m, const tribox_grid *grid, answer *a)
{
    const size_t words = tribox_window_words(grid->size);
    uint64_t *const occupied = calloc(words, sizeof *occupied), *solid[2] = {malloc(words * 8), malloc(words * 8)};
    void *const scratch = malloc(tribox_fill_bytes(grid->size));
    bool is = occupied && solid[0] && solid[1] && scratch;
    for (step s = SURFACE; is && s < STEPS; s++) {
        const double from = processor_time();
        is = !(s == SURFACE   ? tribox_voxelize(&m->soup, grid, NULL, NULL, occupied, NULL)
               : s == OUTSIDE ? tribox_fill_outside(grid->size, occupied, scratch, solid[0], &a->outside)
                              : tribox_fill_parity(&m->soup, grid, occupied, scratch, solid[1], &a->parity, &a->odd_rows));
        a->seconds[s] = processor_time() - from;
    }
    free(occupied);
    free(solid[0]);
    free(solid[1]);
    free(scratch);
    return is;
}

static bool run_grid(const mesh *m, uint32_t resolution, uint64_t rounds)
{
    const tribox_grid grid = grid_about(m, resolution);
    answer least = {.outside = 0}, a;
    for (uint64_t round = 0; round < rounds; round++) {
        if (!find_answer(m, &grid, &a))
            return message_failure("%u cells: cannot be filled; is there memory for it?", (unsigned)resolution) == 0;
        for (step s = SURFACE; s < STEPS; s++)
            a.seconds[s] = round && least.seconds[s] < a.seconds[s] ? least.seconds[s] : a.seconds[s];
        least = a;
    }
    const double surface = least.seconds[SURFACE];
    printf("  %5u %9.1f %9.1f %6.2f %9.1f %6.2f %12zu %12zu %9zu\n", (unsigned)resolution, 1e3 * surface,
           1e3 * least.seconds[OUTSIDE], least.seconds[OUTSIDE] / surface, 1e3 * least.seconds[PARITY],
           least.seconds[PARITY] / surface, least.outside, least.parity, least.odd_rows);
    fflush(stdout);
    return true;
}

static bool run_mesh(const char *path, const settings *s)
{
    mesh m;
    if (!mesh_list_read(path, &m))
        return false;
    printf("\n%s, %zu triangles\n  %5s %9s %9s %6s %9s %6s %12s %12s %9s\n", path, m.soup.count, "cells", "surface", "outside", "x",
           "parity", "x", "filled", "filled", "odd rows");
    bool is_run = true;
    for (int n = 0; is_run && n < RESOLUTIONS; n++)
        is_run = run_grid(&m, s->resolution[n], s->rounds);
    mesh_free(&m);
    return is_run;
}

enum { OPTION_ROUNDS, OPTION_QUICK };
static const option_entry options[] = {{"rounds", 0, true}, {"quick", 0, false}, {NULL, 0, false}};

static int take(void *request, int which, const char *value)
{
    settings *const s = request;
    switch (which) {
    case OPTION_ROUNDS:
        return whole_read(value, "rounds", 1, 101, &s->rounds);
    case OPTION_QUICK:
        s->resolution[0] = 64;
        s->resolution[1] = 128;
        s->rounds = 1;
        return EXIT_CODE_OK;
    default:
        return mesh_list_take(&s->meshes, value);
    }
}

int main(int argc, char **argv)
{
    options_found found;
    settings s = {.rounds = 5, .resolution = {512, 1024}};
    message_set_program("fill");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    if (!s.meshes.count)
        return message_usage("name a mesh file");
    const run r = {argc, argv, 0, machine_here()};
    header_text(stdout, "", &r);
    printf("ms of CPU time, and times the surface; cells that each way fills\n");
    for (size_t n = 0; n < s.meshes.count; n++)
        if (!run_mesh(s.meshes.path[n], &s))
            return EXIT_CODE_FAILURE;
    return EXIT_CODE_OK;
}
