/*
 * test_ids.c - the lowest number of a triangle for each cell, of every kind of triangle in every kind of grid, against the oracle
 * asked about each triangle alone: all kernels, in parts that come in any order, as soups and meshes, in windows. By other axes and
 * accuracies it is the lowest of those that set the bit alone.
 */
#include "common/harness.h"
#include "grid_kinds.h"
#include "id_case.h"
#include "occupancy.h"
#include "triangle_kinds.h"

enum { PAIRS_A_ROUND = 50000, CELLS_MAX = 4000, ASKED_MAX = 8000, FEW = 40 };

/* What is asked of triangles of floats, in one of four forms. */
typedef enum form { SOUP, MESH, INDEXED, DOUBLES, FORMS } form;
typedef struct question {
    grid_planes at;
    triangle_list triangles;
    float corners[TRIANGLE_LIST_MAX][3][3];
    double wide[TRIANGLE_LIST_MAX][3][3];
    uint32_t indices[3 * TRIANGLE_LIST_MAX];
    tribox_window window;
    tribox_options options;
    form form;
} question;

static question asked;
static id_case ids_of;
static uint64_t one[CELLS_MAX];

static tribox_status ask(void *data, size_t from, size_t to, uint32_t first, uint64_t *occupied, uint32_t *ids,
                         tribox_report *report)
{
    const question *const q = data;
    if (q->form == SOUP) {
        const tribox_soup soup = triangle_list_part(&q->triangles, from, to - from, (const int[]){0, 1, 2});
        return tribox_voxelize_ids(&soup, first, &q->at.grid, &q->window, &q->options, occupied, ids, report);
    }
    tribox_mesh mesh = {.positions = q->form == DOUBLES ? (const void *)(q->wide + from) : q->corners + from,
                        .vertices = 3 * (to - from),
                        .count = to - from,
                        .position_bytes = q->form == DOUBLES ? 8 : 4};
    if (q->form == INDEXED)
        mesh = (tribox_mesh){.positions = q->corners,
                             .vertices = 3 * q->triangles.count,
                             .indices = q->indices + 3 * from,
                             .index_bytes = 4,
                             .count = to - from};
    return tribox_mesh_voxelize_ids(&mesh, first, &q->at.grid, &q->window, &q->options, occupied, ids, report);
}

static void lay_meshes(question *q)
{
    for (size_t t = 0; t < q->triangles.count; t++) {
        triangle_list_get(&q->triangles, t, q->corners[t]);
        for (uint32_t n = 0; n < 9; n++)
            q->wide[t][n / 3][n % 3] = (double)q->corners[t][n / 3][n % 3];
        for (uint32_t j = 0; j < 3; j++)
            q->indices[3 * t + j] = (uint32_t)(3 * t) + j;
    }
}

static void draw_window(random_source *r, const tribox_grid *grid, tribox_window *w)
{
    const int kind = random_int(r, 3);
    for (int a = 0; a < 3; a++) {
        const bool is_whole = kind == 0 || (kind == 1 && a < 2);
        w->first[a] = is_whole ? 0 : (uint32_t)random_int(r, (int)grid->size[a]);
        w->size[a] = is_whole ? grid->size[a] : (uint32_t)random_int_between(r, 1, (int)(grid->size[a] - w->first[a]));
    }
}

static void tell(const char *scene, const question *q)
{
    snprintf(doing, sizeof doing, "%s, form %d, accuracy %d, axes %u, kernel %s", scene, (int)q->form, (int)q->options.accuracy,
             q->options.axes, q->options.kernel);
}

/* Bits of the whole grid into those of the window. */
static void cut_window(const question *q, const uint64_t *whole, uint64_t *occupied)
{
    const tribox_window *const w = &q->window;
    const size_t row = (w->size[0] + 63) / 64;
    memset(occupied, 0, row * w->size[1] * w->size[2] * sizeof *occupied);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++)
                if (grid_planes_bit(&q->at, whole, (int)(w->first[0] + i), (int)(w->first[1] + j), (int)(w->first[2] + k)))
                    occupied[(k * w->size[1] + j) * row + i / 64] |= UINT64_C(1) << i % 64;
}

/* By the oracle, asked about each triangle alone. */
static void expect_exact(const question *q)
{
    static uint64_t whole[CELLS_MAX];
    id_case_open(&ids_of, &q->window);
    for (size_t t = 0; t < q->triangles.count; t++) {
        memset(whole, 0, q->at.words * sizeof *whole);
        occupancy_add(&q->at, (const_vertices)q->corners[t], TRIBOX_AXES_ALL, whole);
        cut_window(q, whole, one);
        id_case_expect(&ids_of, one, (int64_t)t);
    }
}

/* By the bits of each triangle alone. */
static void expect_alone(const question *q)
{
    id_case_open(&ids_of, &q->window);
    for (size_t t = 0; t < q->triangles.count; t++) {
        const tribox_soup soup = triangle_list_part(&q->triangles, t, 1, (const int[]){0, 1, 2});
        memset(one, 0, sizeof one);
        assert_int_equal(tribox_voxelize(&soup, &q->at.grid, &q->window, &q->options, one, NULL), TRIBOX_OK);
        id_case_expect(&ids_of, one, (int64_t)t);
    }
}

static void check(random_source *r, const char *scene)
{
    question *const q = &asked;
    lay_meshes(q);
    draw_window(r, &q->at.grid, &q->window);
    expect_exact(q);
    for (int kernel = 0; kernel < kernels; kernel++)
        for (q->form = SOUP; q->form < FORMS; q->form++) {
            q->options = (tribox_options){.kernel = names[kernel]};
            tell(scene, q);
            id_case_check(&ids_of, r, q->triangles.count, ask, q);
        }
    q->form = SOUP;
    q->options.accuracy = (tribox_accuracy)random_int(r, 3);
    q->options.axes = (unsigned)random_int_between(r, 1, AXIS_SETS);
    q->options.kernel = names[random_int(r, kernels)];
    tell(scene, q);
    expect_alone(q);
    id_case_check(&ids_of, r, q->triangles.count, ask, q);
}

static void draw_triangles(random_source *r, const triangle_kind *kind)
{
    const int most = random_int(r, 2) ? random_int_between(r, 1, FEW) : random_int_between(r, 200, 400);
    size_t cost = 0;
    for (asked.triangles.count = 0; asked.triangles.count < (size_t)most && cost < ASKED_MAX;) {
        float u[3][3];
        draw_triangle(r, kind, &asked.at, u);
        cost += occupancy_cost(&asked.at, (const_vertices)u, TRIBOX_AXES_ALL);
        triangle_list_put(&asked.triangles, (const_vertices)u);
    }
}

CASE(test_kinds)
{
    for (size_t s = 0; s <= triangle_kind_count(); s++) {
        const triangle_kind *const kind = s < triangle_kind_count() ? triangle_kind_at(s) : NULL;
        const char *const scene = kind ? kind->name : "mesh";
        random_source r = random_named(args.seed, scene);
        if (args.scenes && strcmp(args.scenes, scene))
            continue;
        for (size_t round = 0; round < arguments_rounds(&args, PAIRS_A_ROUND); round++)
            for (size_t g = 0; g < grid_kind_count(); g++) {
                draw_grid_of_kind(&r, grid_kind_at(g), CELLS_MAX, &asked.at);
                asked.triangles.count = 0;
                if (kind)
                    draw_triangles(&r, kind);
                else
                    draw_mesh(&r, &asked.at, &asked.triangles);
                check(&r, scene);
            }
    }
}

PROGRAM(RUN(test_kinds))
