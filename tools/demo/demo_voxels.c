/* demo_voxels.c - voxelizes the mesh of the demo. */
#define _POSIX_C_SOURCE 200809L
#include "demo_voxels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/processors.h"
#include "picture/preview.h"
#include "read/mesh_look.h"
#include "timing/measure.h"
#include "timing/verify.h"
#include "voxelize/grid_choice.h"
#include "voxelize/layers.h"

enum { RESOLUTION = 128, ROUNDS = 5 };

typedef struct result {
    const tribox_soup *soup;
    tribox_grid grid;
    size_t occupied;
    unsigned threads;
    double seconds; /* of the best round */
} result;

static tribox_status voxelize(const result *r, const tribox_options *options, unsigned threads, uint64_t *bits)
{
    const voxel_task task = voxel_task_of_soup(r->soup, &r->grid, options);
    return voxelize_in_threads(&task, 0, r->grid.size[2], threads, bits, NULL, NULL, NULL);
}

static void clear(const contestant *self, uint64_t *bits)
{
    const result *const r = self->question;
    memset(bits, 0, tribox_window_words(r->grid.size) * sizeof *bits);
}

static bool run(const contestant *self, uint64_t *bits, tribox_report *report)
{
    const result *const r = self->question;
    (void)report;
    return !voxelize(r, &self->options, r->threads, bits);
}

static bool find_truth(const void *question, unsigned axes, uint64_t *bits)
{
    const result *const r = question;
    memset(bits, 0, tribox_window_words(r->grid.size) * sizeof *bits);
    return !voxelize(r, &(tribox_options){.axes = axes, .kernel = "scalar"}, 1, bits);
}

static int time_voxels(result *r, uint64_t *bits)
{
    static samples taken;
    char wrong[VERIFY_TEXT];
    score answer;
    generator order = {0};
    const contestant all = {
        .name = "voxels", .run = run, .prepare = clear, .question = r, .promise = PROMISE_EXACT, .pairs = 1, .has_threads = true};
    const truth from = {find_truth, r, tribox_window_words(r->grid.size)};
    if (!verify(&all, 1, &from, &answer, wrong))
        return message_failure("%s; nothing is timed", wrong);
    measure(&all, 1, (effort){.rounds = ROUNDS, .seconds = 1e9}, &order, bits, &taken);
    r->occupied = answer.overlapping;
    r->seconds = 1e-9 * measure_spread(&taken, 0).least;
    return EXIT_CODE_OK;
}

static int draw(const uint64_t *bits, const result *r, file_out *picture)
{
    const voxels_slab slab = {.layers = r->grid.size[2], .bits = bits};
    const voxels v = {.grid = r->grid, .slab = &slab, .slabs = 1};
    return preview_draw(picture, &v, &PREVIEW_LOOK_DEFAULT, r->threads, true);
}

static void print(const result *r, const char *path)
{
    const double ns = 1e9 * r->seconds / (double)r->soup->count;
    printf("\nVoxels of the mesh: %u x %u x %u cells, %zu of them occupied; %.2f ms, %.1f ns per triangle\n", r->grid.size[0],
           r->grid.size[1], r->grid.size[2], r->occupied, 1e3 * r->seconds, ns);
    printf("exact, %u thread%s%s%s\n", r->threads, r->threads == 1 ? "" : "s", path ? "; drawn in " : "", path ? path : "");
}

static void print_json(json *to, const result *r, const char *path)
{
    json_open_object(to, "voxels");
    json_open_array(to, "size");
    for (int a = 0; a < 3; a++)
        json_whole(to, NULL, r->grid.size[a]);
    json_close(to);
    json_whole(to, "occupied", r->occupied);
    json_whole(to, "threads", r->threads);
    json_whole(to, "rounds", ROUNDS);
    json_number(to, "seconds", 6, r->seconds);
    json_string(to, "picture", path);
    json_close(to);
}

int demo_voxels(const tribox_soup *soup, file_out *picture, json *to)
{
    mesh m = {.soup = *soup, .triangles = soup->count};
    result r = {.soup = soup, .threads = processors_here()};
    mesh_look_all(r.threads, &m);
    int code = grid_choose(&(grid_choice){.resolution = RESOLUTION}, "the mesh of the demo", &m, &r.grid);
    if (code)
        return code;
    uint64_t *bits = malloc(tribox_window_words(r.grid.size) * sizeof *bits);
    if (!bits)
        return message_failure("out of memory for the voxels of the mesh");
    code = time_voxels(&r, bits);
    const char *path = picture->path;
    if (!code)
        code = draw(bits, &r, picture);
    free(bits);
    if (code)
        return code;
    if (to)
        print_json(to, &r, path);
    else
        print(&r, path);
    return EXIT_CODE_OK;
}
