/*
 * test_ids.c - the lowest number of a triangle for each cell, of every kind of triangle in every kind of grid, and in scenes that
 * are hard for doubles, against the oracle asked about each triangle alone: all kernels, in parts that come in any order, as soups
 * and meshes, in windows. By other axes and accuracies it is the lowest of those that set the bit alone.
 */
#include "common/harness.h"
#include "common/soup_or_mesh.h"
#include "common/window_bits.h"
#include "grid_kinds.h"
#include "grid_scenes_f64.h"
#include "occupancy.h"
#include "triangle_kinds.h"

enum {
    PAIRS_A_ROUND = 50000,
    PAIRS_A_SCENE = 1000,
    CELLS_MAX = 4000,
    CELLS_F64 = 1000,
    ASKED_MAX = 8000,
    FEW = 40,
    ID_CELLS = 20000,
    ID_NONE = -1
};

/* A window of a grid, and by z, y, x the lowest number of a triangle, or ID_NONE, that is expected of each cell. */
typedef struct id_case {
    tribox_window at;
    int64_t expected[ID_CELLS];
} id_case;

static id_case ids_of;

static size_t cells_of(const id_case *c) { return (size_t)c->at.size[0] * c->at.size[1] * c->at.size[2]; }

static bool is_set(const id_case *c, const uint64_t *occupied, size_t cell)
{
    const size_t row = cell / c->at.size[0];
    return window_bit(c->at.size, occupied, cell % c->at.size[0], row % c->at.size[1], row / c->at.size[1]);
}

/* No cell has a triangle. */
static void id_case_open(id_case *c, const tribox_window *at)
{
    c->at = *at;
    assert_true(cells_of(c) <= ID_CELLS);
    for (size_t n = 0; n < cells_of(c); n++)
        c->expected[n] = ID_NONE;
}

/* Triangle t, if no lower one was expected, in the cells whose bits are set. Triangles come by their numbers. */
static void id_case_expect(id_case *c, const uint64_t *occupied, int64_t t)
{
    for (size_t n = 0; n < cells_of(c); n++)
        if (c->expected[n] == ID_NONE && is_set(c, occupied, n))
            c->expected[n] = t;
}

/* A call: triangles from .. to - 1, of which `from` has the number `first`. */
typedef tribox_status id_call(void *data, size_t from, size_t to, uint32_t first, uint64_t *occupied, uint32_t *ids,
                              tribox_report *report);

/* One to three parts, cut anywhere; the second may come before the first. */
static void ask_in_parts(random_source *r, size_t count, uint32_t first, id_call *ask, void *data, uint64_t *occupied,
                         uint32_t *ids, size_t *set)
{
    size_t cut[4] = {0, (size_t)random_int(r, (int)count + 1), count, count};
    const int parts = random_int_between(r, 1, 2), from = random_int(r, 2);
    cut[1] = parts == 1 ? count : cut[1];
    *set = 0;
    for (int n = 0; n < parts; n++) {
        const int part = (n + from) % parts;
        tribox_report report;
        assert_int_equal(ask(data, cut[part], cut[part + 1], first + (uint32_t)cut[part], occupied, ids, &report), TRIBOX_OK);
        *set += report.overlapping;
    }
}

static void check_cells(const id_case *c, uint32_t first, const uint64_t *occupied, const uint32_t *ids, const uint32_t *before,
                        size_t set)
{
    size_t expected = 0;
    for (size_t n = 0; n < cells_of(c); n++) {
        const bool is_expected = c->expected[n] != ID_NONE;
        const uint32_t id = is_expected ? first + (uint32_t)c->expected[n] : before[n];
        expected += is_expected;
        if (is_set(c, occupied, n) != is_expected || ids[n] != id)
            fail_msg("%s: cell %zu of window %u x %u x %u is %s with %u where %lld and %u are expected, first %u", doing, n,
                     (unsigned)c->at.size[0], (unsigned)c->at.size[1], (unsigned)c->at.size[2],
                     is_set(c, occupied, n) ? "set" : "clear", (unsigned)ids[n], (long long)c->expected[n], (unsigned)id,
                     (unsigned)first);
    }
    assert_int_equal(set, expected);
}

/*
 * Asks for `count` triangles in parts, in any order, with numbers from anywhere, into memory that had anything and ends with a
 * page. Fails where bits, ids or the report are not as expected, or an id was written where no bit is.
 */
static void id_case_check(const id_case *c, random_source *r, size_t count, id_call *ask, void *data)
{
    const size_t bytes = cells_of(c) * sizeof(uint32_t);
    const guarded g = guarded_make(bytes + 1);
    uint32_t *const ids = guarded_tail(g, bytes), *const before = malloc(bytes + 1), poison = (uint32_t)random_bits(r);
    uint64_t *const occupied = calloc(tribox_window_words(c->at.size) + 1, sizeof *occupied);
    const int kind = random_int(r, 4);
    const uint32_t last = UINT32_MAX - (uint32_t)count, first = random_int(r, 2) ? 0 : random_int(r, 2) ? last : poison % last;
    size_t set;
    assert_non_null(before);
    assert_non_null(occupied);
    for (size_t n = 0; n < cells_of(c); n++)
        ids[n] = before[n] = kind == 0 ? 0 : kind == 1 ? UINT32_MAX : kind == 2 ? first : (uint32_t)random_bits(r);
    ask_in_parts(r, count, first, ask, data, occupied, ids, &set);
    check_cells(c, first, occupied, ids, before, set);
    free(occupied);
    free(before);
    guarded_free(g);
}

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
static uint64_t one[WINDOW_CELLS + 1];

static tribox_status ask(void *data, size_t from, size_t to, uint32_t first, uint64_t *occupied, uint32_t *ids,
                         tribox_report *report)
{
    const question *const q = data;
    soup_or_mesh of = {triangle_list_part(&q->triangles, from, to - from, (const int[]){0, 1, 2}),
                       q->form == DOUBLES ? mesh_of_corners(q->wide + from, to - from, 8)
                                          : mesh_of_corners(q->corners + from, to - from, 4),
                       q->form != SOUP};
    if (q->form == INDEXED) {
        of.mesh = mesh_of_corners(q->corners, q->triangles.count, 4);
        of.mesh.indices = q->indices + 3 * from;
        of.mesh.index_bytes = 4;
        of.mesh.count = to - from;
    }
    return CALL(voxelize_ids, &of, first, &q->at.grid, &q->window, &q->options, occupied, ids, report);
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
    memset(occupied, 0, tribox_window_words(w->size) * sizeof *occupied);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++)
                window_put(w->size, occupied, i, j, k,
                           window_bit(q->at.grid.size, whole, w->first[0] + i, w->first[1] + j, w->first[2] + k));
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

static window_f64 doubles;

static tribox_status ask_doubles(void *data, size_t from, size_t to, uint32_t first, uint64_t *occupied, uint32_t *ids,
                                 tribox_report *report)
{
    const window_f64 *const w = data;
    const tribox_mesh mesh = mesh_of_corners(w->triangle + from, to - from, 8);
    return tribox_mesh_voxelize_ids(&mesh, first, &w->grid, &w->at, &w->options, occupied, ids, report);
}

static void check_doubles(random_source *r)
{
    if (random_int(r, 2))
        window_f64_draw(&doubles, r);
    else
        window_f64_open(&doubles);
    id_case_open(&ids_of, &doubles.at);
    for (size_t t = 0; t < doubles.count; t++) {
        window_f64_expect(&doubles, t, 1, TRIBOX_AXES_ALL, one);
        id_case_expect(&ids_of, one, (int64_t)t);
    }
    for (int kernel = 0; kernel < kernels; kernel++) {
        doubles.options = (tribox_options){.kernel = names[kernel]};
        snprintf(doing, sizeof doing, "%s of doubles, kernel %s", doubles.scene, doubles.options.kernel);
        id_case_check(&ids_of, r, doubles.count, ask_doubles, &doubles);
    }
}

CASE(test_doubles)
{
    for (size_t s = 0; s < scene_f64_count(); s++) {
        const scene_f64 *const scene = scene_f64_at(s);
        random_source r = random_named(args.seed, scene->name);
        if (args.scenes && strcmp(args.scenes, scene->name))
            continue;
        for (size_t round = 0; round < arguments_rounds(&args, PAIRS_A_SCENE); round++) {
            window_f64_draw_scene(&doubles, &r, scene, CELLS_F64);
            check_doubles(&r);
        }
    }
}

PROGRAM(RUN(test_kinds), RUN(test_doubles))
