/*
 * elsewhere.c - ns a triangle on every kernel here, where there is little more than a clock: emulated processors, WebAssembly. Also
 * the voxels of the scene whose ties are many. Takes scenes by name; no masks are looked at.
 */
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/draw.h"
#include "console/clock.h"
#include "tribox.h"

enum { TRIANGLES = 4096, IN_CELLS = 64, CELLS = 64, ROUNDS = 60, KERNELS_MOST = 8, WAYS = 4 };

static const char *const way_names[WAYS] = {"exact", "conservative", "fast", "voxels"};

static float streams[9][TRIANGLES];
static uint64_t mask[TRIANGLES / 64];
static uint64_t occupied[CELLS * CELLS * (CELLS / 64)];

/* Of any size from 2^-20 to 2^20, number by number: what float leaves open is half of them. */
static void draw_wild(generator *g, float u[3][3])
{
    for (int n = 0; n < 9; n++)
        u[n / 3][n % 3] = ldexpf(random_between(g, -1, 1), (int)random_below(g, 41) - 20);
}

static const struct {
    const char *name;
    draw_triangle *draw;
} scenes[] = {
    {"paper", draw_paper}, {"lattice", draw_lattice}, {"tenths", draw_tenths}, {"touching", draw_touching}, {"wild", draw_wild}};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

static void draw_scene(size_t s)
{
    generator g = {s + 1};
    for (size_t t = 0; t < TRIANGLES; t++) {
        float u[3][3];
        scenes[s].draw(&g, u);
        for (int n = 0; n < 9; n++)
            streams[n][t] = u[n % 3][n / 3];
    }
}

/* One pass; the number of triangles that it was about. */
static size_t pass(int way, const char *kernel)
{
    static const tribox_box box = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};
    static const tribox_grid grid = {{-2, -2, -2}, {0.0625, 0.0625, 0.0625}, {CELLS, CELLS, CELLS}};
    const tribox_options options = {.accuracy = way < 3 ? (tribox_accuracy)way : TRIBOX_EXACT, .kernel = kernel};
    const tribox_soup soup = {.x = {streams[0], streams[1], streams[2]},
                              .y = {streams[3], streams[4], streams[5]},
                              .z = {streams[6], streams[7], streams[8]},
                              .count = way < 3 ? TRIANGLES : IN_CELLS};
    const tribox_status status =
        way < 3 ? tribox_overlap(&soup, &box, &options, mask, NULL) : tribox_voxelize(&soup, &grid, NULL, &options, occupied, NULL);
    if (status != TRIBOX_OK) {
        fprintf(stderr, "%s: %s\n", kernel, tribox_status_text(status));
        exit(1);
    }
    return soup.count;
}

/* ns a triangle, of as many passes as take two milliseconds. */
static double sample(int way, const char *kernel)
{
    size_t triangles = 0;
    const double start = clock_seconds();
    double seconds = 0;
    for (; seconds < 0.002; seconds = clock_seconds() - start)
        triangles += pass(way, kernel);
    return 1e9 * seconds / (double)triangles;
}

static void measure(size_t s)
{
    double least[KERNELS_MOST][WAYS];
    draw_scene(s);
    for (int round = 0; round < ROUNDS; round++)
        for (size_t k = 0; k < KERNELS_MOST && tribox_kernel_list(k); k++)
            for (int way = 0; way < WAYS; way++) {
                const double ns = sample(way, tribox_kernel_list(k));
                least[k][way] = round ? fmin(least[k][way], ns) : ns;
            }
    for (size_t k = 0; k < KERNELS_MOST && tribox_kernel_list(k); k++) {
        printf("%-9s %-8s", scenes[s].name, tribox_kernel_list(k));
        for (int way = 0; way < WAYS; way++)
            printf(" %s %.*f", way_names[way], way < 3 ? 2 : 0, least[k][way]);
        puts("");
    }
}

int main(int argc, char **argv)
{
    for (size_t s = 0; s < SCENES; s++)
        if (argc < 2 || !strcmp(argv[1], scenes[s].name))
            measure(s);
    return 0;
}
