/*
 * test_ids_f64.c - the lowest number of a triangle of doubles for each cell, in scenes that are hard for doubles, against the
 * oracle asked about each triangle alone: all kernels, in parts that come in any order, in windows as in the whole.
 */
#include "common/harness.h"
#include "grid_scenes_f64.h"
#include "id_case.h"

enum { PAIRS_A_ROUND = 1000, CELLS = 1000, LONG = 1000 };

static window_f64 asked;
static id_case ids_of;
static uint64_t one[WINDOW_CELLS + 1];

static tribox_status ask(void *data, size_t from, size_t to, uint32_t first, uint64_t *occupied, uint32_t *ids,
                         tribox_report *report)
{
    const window_f64 *const w = data;
    const tribox_mesh mesh = {
        .positions = w->triangle + from, .vertices = 3 * (to - from), .count = to - from, .position_bytes = 8};
    return tribox_mesh_voxelize_ids(&mesh, first, &w->grid, &w->at, &w->options, occupied, ids, report);
}

static void check(random_source *r)
{
    if (random_int(r, 2))
        window_f64_draw(&asked, r);
    else
        window_f64_open(&asked);
    id_case_open(&ids_of, &asked.at);
    for (size_t t = 0; t < asked.count; t++) {
        window_f64_expect(&asked, t, 1, TRIBOX_AXES_ALL, one);
        id_case_expect(&ids_of, one, (int64_t)t);
    }
    for (int kernel = 0; kernel < kernels; kernel++) {
        asked.options = (tribox_options){.kernel = names[kernel]};
        snprintf(doing, sizeof doing, "%s of doubles, kernel %s", asked.scene, asked.options.kernel);
        id_case_check(&ids_of, r, asked.count, ask, &asked);
    }
}

CASE(test_scenes)
{
    for (size_t s = 0; s < scene_f64_count(); s++) {
        const scene_f64 *const scene = scene_f64_at(s);
        random_source r = random_named(args.seed, scene->name);
        if (args.scenes && strcmp(args.scenes, scene->name))
            continue;
        asked.scene = scene->name;
        asked.seed = args.seed;
        for (size_t round = 0; round < arguments_rounds(&args, PAIRS_A_ROUND); round++) {
            draw_grid_f64(&r, scene, CELLS, &asked.grid);
            const bool is_few = asked.grid.size[0] > LONG || random_int(&r, 2);
            const int count = is_few ? random_int_between(&r, 1, 6) : random_int_between(&r, 20, 60);
            for (asked.count = 0; asked.count < (size_t)count; asked.count++)
                draw_triangle_f64(&r, &asked.grid, asked.triangle[asked.count]);
            check(&r);
        }
    }
}

PROGRAM(RUN(test_scenes))
