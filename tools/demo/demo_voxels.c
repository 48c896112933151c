/* demo_voxels.c - puts the mesh of the demo into a grid. */
#define _POSIX_C_SOURCE 200809L
#include "demo_voxels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/clock.h"
#include "voxelize/grid_choice.h"
#include "voxelize/layers.h"
#include "console/message.h"
#include "console/output.h"
#include "picture/preview.h"
#include "console/processors.h"

enum { RESOLUTION = 128, ROUNDS = 5 };

typedef struct result {
    tribox_grid grid;
    tribox_report report;
    unsigned threads;
    double seconds; /* of the best round */
} result;

static int voxelize(const tribox_soup *soup, uint64_t *bits, result *r)
{
    for (int round = 0; round < ROUNDS; round++) {
        memset(bits, 0, tribox_grid_words(&r->grid) * sizeof *bits);
        const double start = clock_seconds();
        const tribox_status status =
            voxelize_in_threads(soup, &r->grid, 0, r->grid.size[2], NULL, r->threads, bits, &r->report, NULL, NULL);
        const double seconds = clock_seconds() - start;
        if (status)
            return message_failure("%s", tribox_status_text(status));
        r->seconds = !round || seconds < r->seconds ? seconds : r->seconds;
    }
    return EXIT_CODE_OK;
}

static int draw(const uint64_t *bits, const result *r, file_out *picture)
{
    const voxels_slab slab = {0, r->grid.size[2], bits};
    const voxels v = {.grid = r->grid, .slab = &slab, .slabs = 1};
    return preview_draw(picture, &v, PICTURE_UP_Z, r->threads, true);
}

static void print(const tribox_soup *soup, const result *r, const char *path)
{
    const double ns = 1e9 * r->seconds / (double)soup->count;
    printf("Voxels of the mesh: %u x %u x %u cells, %zu of them overlap it; %.2f ms, %.1f ns per triangle\n", r->grid.size[0],
           r->grid.size[1], r->grid.size[2], r->report.overlapping, 1e3 * r->seconds, ns);
    printf("(exact, %u thread%s, best of %d rounds)%s%s\n\n", r->threads, r->threads == 1 ? "" : "s", ROUNDS,
           path ? ", drawn in " : "", path ? path : "");
}

static void print_json(const result *r, const char *path)
{
    printf("{\"size\": [%u, %u, %u], \"occupied\": %zu, \"threads\": %u, \"rounds\": %d, \"seconds\": %.6g, \"picture\": ",
           r->grid.size[0], r->grid.size[1], r->grid.size[2], r->report.overlapping, r->threads, ROUNDS, r->seconds);
    if (path)
        output_json_string(path);
    else
        printf("null");
    putchar('}');
}

int demo_voxels(const tribox_soup *soup, file_out *picture, bool wants_json)
{
    result r = {.threads = processors_here()};
    int code = grid_choose(&(grid_choice){.resolution = RESOLUTION}, "the mesh of the demo", soup, &r.grid);
    if (code)
        return code;
    uint64_t *bits = malloc(tribox_grid_words(&r.grid) * sizeof *bits);
    if (!bits)
        return message_failure("out of memory for the voxels of the mesh");
    code = voxelize(soup, bits, &r);
    const char *path = picture->path;
    if (!code)
        code = draw(bits, &r, picture);
    free(bits);
    if (code)
        return code;
    if (wants_json)
        print_json(&r, path);
    else
        print(soup, &r, path);
    return EXIT_CODE_OK;
}
