/*
 * calls.c - what does a call cost: a few triangles, as a soup or a mesh, against a box, or a triangle against a few boxes, compared
 * with the paper's test?
 *
 * A pass makes many calls, each about other pairs, so that no processor learns them by heart. All counts of pairs are timed in the
 * same rounds; 0 is what lies around a walk.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/asked.h"
#include "common/counting.h"
#include "common/soups.h"
#include "console/accuracy.h"
#include "paper/paper.h"

enum { COUNTS = 13, PAIRS = 4096, CALLS_MOST = 1024, KERNELS_MOST = 8 };
static const size_t counts[COUNTS] = {0, 1, 2, 4, 8, 12, 16, 31, 32, 63, 64, 100, 1000};

/* The triangles of a scene, and as many boxes about them, as tribox and as the paper's test want them. */
static scene paper;
static float bounds[6][PAIRS], placed[PAIRS][2][3];

static bool make_pairs(void)
{
    if (!scene_make("paper", 1, false, &paper))
        return false;
    for (size_t i = 0; i < 3 * PAIRS; i++) {
        const float center = paper.work.triangles[PAIRS + i / 3][0][i % 3] / 2, half = 0.5f;
        placed[i / 3][0][i % 3] = center;
        placed[i / 3][1][i % 3] = half;
        bounds[i % 3][i / 3] = center - half;
        bounds[3 + i % 3][i / 3] = center + half;
    }
    return true;
}

/* What a call is about: triangles in both forms and a box, or boxes and a triangle. Slices of the pairs, at any alignment. */
typedef struct slice {
    const timing_job *all;
    const float (*triangles)[3][3], (*one)[3][3];
    const float (*placed)[2][3];
    tribox_soup soup;
    tribox_mesh mesh;
    tribox_boxes boxes;
} slice;

static slice slice_of(size_t call, size_t count)
{
    const timing_job *const all = paper.work.jobs;
    const size_t at = call * count;
    slice made = {.all = all, .triangles = all->triangles + at, .one = all->triangles + call, .soup.count = count};
    made.placed = (const float(*)[2][3])(placed + at);
    made.mesh = (tribox_mesh){.positions = made.triangles, .vertices = 3 * count, .count = count};
    made.boxes.count = count;
    for (int k = 0; k < 3; k++) {
        made.soup.x[k] = all->soup.x[k] + at;
        made.soup.y[k] = all->soup.y[k] + at;
        made.soup.z[k] = all->soup.z[k] + at;
        made.boxes.lo[k] = bounds[k] + at;
        made.boxes.hi[k] = bounds[3 + k] + at;
    }
    return made;
}

/* The calls of a pass. */
typedef struct calls_about {
    slice call[CALLS_MOST];
    size_t count, words; /* words: of each */
} calls_about;

static bool paper_triangles(const slice *a, uint64_t *mask)
{
    paper_in_order(PAPER_ORDER)(a->all->center, a->all->half, a->triangles, a->soup.count, mask);
    return false;
}

static bool paper_boxes(const slice *a, uint64_t *mask)
{
    paper_walk *const walk = paper_in_order(PAPER_ORDER);
    uint64_t word = 0, bit;
    for (size_t i = 0; i < a->boxes.count; i++) {
        walk(a->placed[i][0], a->placed[i][1], a->one, 1, &bit);
        word |= bit << i % 64;
        if (i % 64 == 63 || i + 1 == a->boxes.count) {
            *mask++ = word;
            word = 0;
        }
    }
    return false;
}

#define RUN_EACH(name, refuses) \
    CONTESTANT_RUN(name) \
    { \
        const calls_about *const all = self->question; \
        const tribox_options *const how = &self->options; \
        bool is_right = true; \
        (void)how; \
        for (const slice *a = all->call; a < all->call + all->count; a++, mask += all->words) \
            is_right = is_right && !(refuses); \
        return is_right; \
    }
RUN_EACH(run_paper_triangles, paper_triangles(a, mask))
RUN_EACH(run_paper_boxes, paper_boxes(a, mask))
RUN_EACH(run_triangles, tribox_overlap(&a->soup, &a->all->box, how, mask, NULL))
RUN_EACH(run_boxes, tribox_overlap_boxes((const float *)a->one, &a->boxes, how, mask, NULL))
RUN_EACH(run_meshes, tribox_mesh_overlap(&a->mesh, &a->all->box, how, mask, NULL))

static const struct shape {
    const char *name;
    contestant_run *paper, *run;
} shapes[] = {{"triangles", run_paper_triangles, run_triangles},
              {"boxes", run_paper_boxes, run_boxes},
              {"meshes", run_paper_triangles, run_meshes}};

static bool find_truth(const void *scalar, unsigned axes, uint64_t *mask)
{
    contestant one = *(const contestant *)scalar;
    one.options = (tribox_options){.axes = axes, .kernel = "scalar"};
    return one.run(&one, mask, NULL);
}

/* The paper's test, then each kernel, the widest first; times are those of a call. Returns how many there are. */
static size_t enter(const struct shape *of, const calls_about *all, tribox_accuracy accuracy, contestant *list)
{
    const char *kernel;
    size_t count = 1;
    list[0] = contestant_paper(&paper.work, PAPER_ORDER);
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++)
        list[count++] = contestant_kernel(&paper.work, &(tribox_options){.accuracy = accuracy, .kernel = kernel});
    for (size_t c = 0; c < count; c++) {
        list[c].question = all;
        list[c].run = c ? of->run : of->paper;
        list[c].pairs = (double)all->count;
    }
    return count;
}

/* Times of contestant c about counts[n] are at n * of_each + c. */
static void tell(asked *q, const contestant *list, size_t of_each, size_t n)
{
    const double by_paper = measure_least(&q->taken, n * of_each);
    char times[KERNELS_MOST + 1][24];
    ADD(&q->out, NUMBER("count", 0, counts[n]), NUMBER("paper", 1, by_paper));
    for (size_t c = 1; c < of_each; c++) {
        const char *const kernel = list[c].options.kernel;
        const double least = measure_least(&q->taken, n * of_each + c);
        snprintf(times[c], sizeof times[c], "%s_speed", kernel);
        ADD(&q->out, NUMBER(kernel, 1, least), NUMBER(times[c], 2, by_paper / least));
    }
    printout_row(&q->out);
}

/* Everyone about each count answers for himself; then all are timed together. */
static bool run_shape(asked *q, const struct shape *of, const calls_about all[COUNTS], tribox_accuracy accuracy)
{
    contestant list[CONTESTANTS_MAX];
    size_t of_each = 0, words = 0;
    for (size_t n = 0; n < COUNTS; n++) {
        contestant *const own = list + n * of_each;
        of_each = enter(of, &all[n], accuracy, own);
        const truth from = {find_truth, &own[1], all[n].count * all[n].words};
        words = from.words > words ? from.words : words;
        if (!asked_verify(q, of->name, own, of_each, &from))
            return false;
    }
    asked_measure(q, of->name, list, COUNTS * of_each, NULL, asked_effort(q, 31, 1e9, 5e-4), words);
    printout_table(&q->out, "%s, %s: ns a call by kernel, times the paper's speed; least times", of->name, accuracy_word(accuracy));
    for (size_t n = 0; n < COUNTS; n++)
        tell(q, list, of_each, n);
    printout_disturbed(&q->out, &q->taken);
    return true;
}

/* ---- every call of the library, about the same few triangles again and again: the least that it takes ------------------------ */

enum { SIZES = 3, MOST = 64, TILE = 8, CELLS = 64 };

/* A few triangles in every form, and room for every answer. What a call of CALLS wants, one before it has made. */
typedef struct few {
    slice of;
    tribox_oriented_box turned;
    tribox_index index;
    uint64_t mask[1], inside[1], bits[1], window[16], solid[16];
    uint32_t number[MOST], children_of[MOST], order[MOST], list[MOST * MOST], ids[CELLS], cells[CELLS][3], in_tile[MOST],
        in_cell[MOST * CELLS];
    uint8_t children[MOST];
    size_t start[MOST + 1], tile_start[2], cell_start[CELLS + 1], found, odd;
    float streams[9][MOST], *to[9];
    void *scratch, *nodes;
} few;

static const tribox_grid cells = {.origin = {-2, -2, -2}, .cell = {1, 1, 1}, .size = {4, 4, 4}};
static const tribox_tiles tile = {TILE, 0, 1};

static uint64_t bricks;
static const tribox_sink sink = {count_brick, &bricks};
static const tribox_ids_sink ids_sink = {count_ids, &bricks};
static const tribox_lists_sink lists_sink = {count_lists, &bricks};

#define REGION (&(tribox_region){.box = &f->of.all->box})
#define BRICKS &cells, &tile, f->tile_start, f->in_tile, how, f->scratch

/* SAYS a status, which has to be that of success; LISTS in two passes, both timed; IS anything else. */
#define CALLS(SAYS, LISTS, IS) \
    SAYS(tribox_overlap, &f->of.soup, &f->of.all->box, how, f->mask, NULL) \
    SAYS(tribox_mesh_overlap, &f->of.mesh, &f->of.all->box, how, f->mask, NULL) \
    SAYS(tribox_overlap_oriented, &f->of.soup, &f->turned, how, f->mask, NULL) \
    SAYS(tribox_mesh_overlap_oriented, &f->of.mesh, &f->turned, how, f->mask, NULL) \
    SAYS(tribox_overlap_boxes, (const float *)f->of.one, &f->of.boxes, how, f->mask, NULL) \
    SAYS(tribox_find, &f->of.soup, &f->of.all->box, how, TRIBOX_FIRST_HIT, &f->found) \
    SAYS(tribox_mesh_find, &f->of.mesh, &f->of.all->box, how, TRIBOX_FIRST_HIT, &f->found) \
    SAYS(tribox_classify, &f->of.soup, &f->of.all->box, how, f->mask, f->inside, NULL) \
    SAYS(tribox_mesh_classify, &f->of.mesh, &f->of.all->box, how, f->mask, f->inside, NULL) \
    SAYS(tribox_split, &f->of.soup, f->children_of, f->of.soup.count, &f->of.all->box, NULL, how, f->children, NULL) \
    SAYS(tribox_mesh_split, &f->of.mesh, f->children_of, f->of.soup.count, &f->of.all->box, NULL, how, f->children, NULL) \
    SAYS(tribox_index_build, &f->index, how, f->nodes) \
    SAYS(tribox_index_update, &f->index, 0, f->of.soup.count, how, f->nodes) \
    SAYS(tribox_index_overlap, &f->index, REGION, how, f->mask, NULL) \
    SAYS(tribox_index_words, &f->index, REGION, how, 1, f->number, f->bits, f->inside, &f->found, NULL) \
    SAYS(tribox_index_list, &f->index, REGION, how, MOST, f->list, &f->found) \
    SAYS(tribox_index_lists, &f->index, &f->of.boxes, how, MOST *MOST, f->list, f->start) \
    SAYS(tribox_index_any, &f->index, REGION, how, &f->found) \
    SAYS(tribox_soup_sort, &f->of.soup, f->order, f->scratch) \
    SAYS(tribox_mesh_sort, &f->of.mesh, f->order, f->scratch) \
    SAYS(tribox_boxes_sort, &f->of.boxes, f->order, f->scratch) \
    SAYS(tribox_soup_gather, &f->of.soup, f->order, 0, f->of.soup.count, f->to, f->to + 3, f->to + 6) \
    SAYS(tribox_mesh_gather, &f->of.mesh, NULL, f->order, 0, f->of.soup.count, f->to, f->to + 3, f->to + 6) \
    SAYS(tribox_mesh_to_soup, &f->of.mesh, NULL, 0, f->of.soup.count, how, f->to, f->to + 3, f->to + 6) \
    SAYS(tribox_voxelize, &f->of.soup, &cells, NULL, how, f->window, NULL) \
    SAYS(tribox_mesh_voxelize, &f->of.mesh, &cells, NULL, how, f->window, NULL) \
    SAYS(tribox_voxelize_ids, &f->of.soup, 0, &cells, NULL, how, f->window, f->ids, NULL) \
    SAYS(tribox_mesh_voxelize_ids, &f->of.mesh, 0, &cells, NULL, how, f->window, f->ids, NULL) \
    SAYS(tribox_voxelize_thin, &f->of.soup, &cells, NULL, how, f->solid, NULL) \
    SAYS(tribox_mesh_voxelize_thin, &f->of.mesh, &cells, NULL, how, f->solid, NULL) \
    IS(tribox_window_cells, f->window, cells.size, f->cells) \
    SAYS(tribox_fill_outside, cells.size, f->window, f->scratch, f->solid, &f->found) \
    SAYS(tribox_fill_parity, &f->of.soup, &cells, f->window, f->scratch, f->solid, &f->found, &f->odd) \
    SAYS(tribox_mesh_fill_parity, &f->of.mesh, &cells, f->window, f->scratch, f->solid, &f->found, &f->odd) \
    LISTS(tribox_cell_lists, f->in_cell, &f->of.soup, &cells, NULL, how, f->cell_start) \
    LISTS(tribox_mesh_cell_lists, f->in_cell, &f->of.mesh, &cells, NULL, how, f->cell_start) \
    LISTS(tribox_tile_lists, f->in_tile, &f->of.soup, &cells, &tile, how, f->tile_start) \
    LISTS(tribox_mesh_tile_lists, f->in_tile, &f->of.mesh, &cells, &tile, how, f->tile_start) \
    SAYS(tribox_bricks, &f->of.soup, BRICKS, &sink, NULL) \
    SAYS(tribox_mesh_bricks, &f->of.mesh, BRICKS, &sink, NULL) \
    SAYS(tribox_bricks_ids, &f->of.soup, BRICKS, &ids_sink, NULL) \
    SAYS(tribox_mesh_bricks_ids, &f->of.mesh, BRICKS, &ids_sink, NULL) \
    SAYS(tribox_bricks_lists, &f->of.soup, BRICKS, &lists_sink, NULL) \
    SAYS(tribox_mesh_bricks_lists, &f->of.mesh, BRICKS, &lists_sink, NULL) \
    IS(tribox_mask_indices, f->mask, f->of.soup.count, f->number) \
    IS(tribox_soup_not_finite, &f->of.soup, &f->found) \
    IS(tribox_mesh_not_finite, &f->of.mesh, &f->found) \
    IS(tribox_mesh_bad_vertices, &f->of.mesh, &f->found) \
    IS(tribox_grid_cell, &cells, 1, 2, 3) \
    IS(tribox_kernel_name, how) \
    IS(tribox_version, )

#define RUN_IT(name, does) \
    static bool run_##name(const contestant *self, uint64_t *mask, tribox_report *report) \
    { \
        few *const f = (few *)(uintptr_t)self->question; \
        const tribox_options *const how = &self->options; \
        (void)f, (void)how, (void)mask, (void)report; \
        does; \
    }
#define RUN_SAYS(name, ...) RUN_IT(name, return !name(__VA_ARGS__))
#define RUN_LISTS(name, list, ...) RUN_IT(name, return !name(__VA_ARGS__, NULL) && !name(__VA_ARGS__, list))
#define RUN_IS(name, ...) RUN_IT(name, (void)name(__VA_ARGS__); return true)
CALLS(RUN_SAYS, RUN_LISTS, RUN_IS)

#define ROW_OF(name, ...) {#name, run_##name},
static const struct {
    const char *name;
    contestant_run *run;
} calls[] = {CALLS(ROW_OF, ROW_OF, ROW_OF)};

static void make_few(size_t count, few *f)
{
    *f = (few){.of = slice_of(0, count)};
    f->turned = (tribox_oriented_box){.half = {0.5f, 0.5f, 0.5f}, .axis = {{0.8f, 0.6f, 0}, {-0.6f, 0.8f, 0}, {0, 0, 1}}};
    f->nodes = asked_allocate(tribox_index_bytes(MOST), 1);
    f->scratch = asked_allocate(tribox_bricks_lists_bytes(TILE, MOST) + tribox_bricks_ids_bytes(TILE), 1);
    f->index = (tribox_index){.nodes = f->nodes, .soup = &f->of.soup};
    for (uint32_t n = 0; n < MOST; n++)
        f->children_of[n] = n;
    for (size_t n = 0; n < 9; n++)
        f->to[n] = f->streams[n];
}

static bool run_calls(asked *q)
{
    static few about[SIZES];
    static const size_t sizes[SIZES] = {1, 8, 64};
    contestant list[SIZES];
    bool is_right = true;
    for (size_t n = 0; n < SIZES; n++)
        make_few(sizes[n], &about[n]);
    printout_table(&q->out, "every call, exact: ns about the same 1, 8 and 64 triangles or boxes, a window or a tile of %d cells",
                   CELLS);
    for (size_t c = 0; is_right && c < sizeof calls / sizeof calls[0]; c++) {
        for (size_t n = 0; n < SIZES; n++) {
            list[n] = (contestant){.run = calls[c].run, .question = &about[n], .options.kernel = q->kernel, .pairs = 1};
            is_right = is_right && list[n].run(&list[n], NULL, NULL);
        }
        if (!is_right)
            return message_failure("%s refuses", calls[c].name) == EXIT_CODE_OK;
        asked_measure(q, calls[c].name, list, SIZES, NULL, asked_effort(q, 31, 1e9, 2e-4), 1);
        ROW(&q->out, TEXT("call", calls[c].name), NUMBER("of_1", 1, measure_least(&q->taken, 0)),
            NUMBER("of_8", 1, measure_least(&q->taken, 1)), NUMBER("of_64", 1, measure_least(&q->taken, 2)));
    }
    return is_right;
}

static bool answer(asked *q)
{
    static const tribox_accuracy accuracies[] = {TRIBOX_EXACT, TRIBOX_FAST};
    static calls_about all[COUNTS];
    bool is_right = make_pairs();
    for (size_t n = 0; is_right && n < COUNTS; n++) {
        all[n].count = counts[n] * CALLS_MOST < PAIRS ? CALLS_MOST : PAIRS / counts[n];
        all[n].words = tribox_mask_words(counts[n]);
        for (size_t call = 0; call < all[n].count; call++)
            all[n].call[call] = slice_of(call, counts[n]);
    }
    for (size_t k = 0; is_right && k < 6; k++)
        is_right = run_shape(q, &shapes[k / 2], all, accuracies[k % 2]);
    is_right = is_right && run_calls(q);
    scene_free(&paper);
    return is_right;
}

const bench_question question_calls = {.name = "calls",
                                       .asks =
                                           "What does a call about a few triangles, or a few boxes, cost, beside the paper's test?",
                                       .options = 1u << OPTION_KERNEL | 1u << OPTION_QUICK,
                                       .answer = answer};
