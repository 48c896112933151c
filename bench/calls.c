/*
 * calls.c - what does a call cost: a few triangles, as a soup or a mesh, against a box, or a triangle against a few boxes, compared
 * with the paper's test?
 *
 * A pass makes many calls, each about other pairs, so that no processor learns them by heart. All counts of pairs are timed in the
 * same rounds: a count that fills no packet is compared with the next one that does, and 0 is what lies around a walk.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/soups.h"
#include "console/accuracy.h"
#include "paper/paper.h"
#include "common/asked.h"

/* The last counts are there because they are full packets, after 100 and 1000, of 8 or of 16 lanes. */
enum { COUNTS = 16, COUNTS_SHOWN = 13, PAIRS = 4096, CALLS_MOST = 1024, KERNELS_MOST = 5 };
static const size_t counts[COUNTS] = {0, 1, 2, 4, 8, 12, 16, 31, 32, 63, 64, 100, 1000, 104, 112, 1008};

/* One triangle and its boxes, as tribox and as the paper's test want them. */
typedef struct box_job {
    float triangle[1][3][3];
    tribox_boxes boxes;
    const float (*placed)[2][3]; /* the same boxes: the centre and half the size of each */
} box_job;

typedef struct box_work {
    box_job jobs[CALLS_MOST];
    size_t count, words;
} box_work;

/* The triangles of a scene, and as many boxes about them. */
typedef struct pairs {
    scene at;
    float *bounds; /* six streams */
    float (*placed)[2][3];
} pairs;

static size_t calls_of(size_t count) { return count * CALLS_MOST < PAIRS ? CALLS_MOST : PAIRS / count; }

static void make_pairs(pairs *p)
{
    size_t index;
    if (!scene_find("paper", &index) || !scene_make(index, 1, &p->at))
        exit(EXIT_CODE_FAILURE);
    p->bounds = asked_allocate(6 * PAIRS, sizeof(float));
    p->placed = asked_allocate(PAIRS, sizeof *p->placed);
    for (size_t i = 0; i < PAIRS; i++)
        for (size_t a = 0; a < 3; a++) {
            const float center = p->at.work.triangles[PAIRS + i][0][a] / 2, half = 0.5f;
            p->placed[i][0][a] = center;
            p->placed[i][1][a] = half;
            p->bounds[a * PAIRS + i] = center - half;
            p->bounds[(3 + a) * PAIRS + i] = center + half;
        }
}

/* Calls of `count` triangles each: slices of the scene, at any alignment. */
static void make_triangles(const pairs *p, size_t count, timing_work *work)
{
    const timing_job *const all = &p->at.work.jobs[0];
    if (!timing_work_make(work, calls_of(count), timing_work_room(PAIRS)))
        exit(message_failure("out of memory"));
    const timing_job copy = timing_work_copy(work, &all->soup, NULL, PAIRS);
    for (size_t call = 0, at = 0; call < calls_of(count); call++, at += count) {
        timing_job job = {.soup = {.count = count}, .triangles = copy.triangles + at};
        for (int v = 0; v < 3; v++) {
            job.soup.x[v] = copy.soup.x[v] + at;
            job.soup.y[v] = copy.soup.y[v] + at;
            job.soup.z[v] = copy.soup.z[v] + at;
        }
        timing_work_add(work, &job, &all->box);
    }
}

static void make_boxes(const pairs *p, size_t count, box_work *work)
{
    work->count = calls_of(count);
    work->words = work->count * tribox_mask_words(count);
    for (size_t call = 0, at = 0; call < work->count; call++, at += count) {
        box_job *const job = &work->jobs[call];
        memcpy(job->triangle[0], p->at.work.triangles[call], sizeof job->triangle[0]);
        job->placed = (const float(*)[2][3])(p->placed + at);
        job->boxes.count = count;
        for (size_t a = 0; a < 3; a++) {
            job->boxes.lo[a] = p->bounds + a * PAIRS + at;
            job->boxes.hi[a] = p->bounds + (3 + a) * PAIRS + at;
        }
    }
}

CONTESTANT_RUN(run_paper_boxes)
{
    const box_work *const work = self->question;
    paper_walk *const walk = paper_in_order(PAPER_ORDER);
    for (size_t call = 0; call < work->count; call++) {
        const box_job *const job = &work->jobs[call];
        uint64_t word = 0, bit;
        for (size_t i = 0; i < job->boxes.count; i++) {
            walk(job->placed[i][0], job->placed[i][1], (const float(*)[3][3])job->triangle, 1, &bit);
            word |= bit << i % 64;
            if (i % 64 == 63 || i + 1 == job->boxes.count) {
                *mask++ = word;
                word = 0;
            }
        }
    }
    return true;
}

static bool answer_boxes(const box_work *work, const tribox_options *options, uint64_t *mask)
{
    for (size_t call = 0; call < work->count; call++) {
        const box_job *const job = &work->jobs[call];
        if (tribox_overlap_boxes((const float *)job->triangle[0], &job->boxes, options, mask, NULL))
            return false;
        mask += tribox_mask_words(job->boxes.count);
    }
    return true;
}

CONTESTANT_RUN(run_boxes) { return answer_boxes(self->question, &self->options, mask); }

/* The same triangles as a mesh of nine floats each. */
CONTESTANT_RUN(run_meshes)
{
    const timing_work *const work = self->question;
    bool is_right = true;
    for (size_t call = 0; call < work->count; mask += tribox_mask_words(work->jobs[call++].soup.count)) {
        const timing_job *const job = &work->jobs[call];
        const tribox_mesh mesh = {.positions = job->triangles, .vertices = 3 * job->soup.count, .count = job->soup.count};
        is_right = is_right && !tribox_mesh_overlap(&mesh, &job->box, &self->options, mask, NULL);
    }
    return is_right;
}

static bool find_truth_of_boxes(const void *question, unsigned axes, uint64_t *mask)
{
    return answer_boxes(question, &(tribox_options){.axes = axes, .kernel = "scalar"}, mask);
}

/* The paper's test, then each kernel, the widest first; times are those of a call. Returns how many there are. */
static size_t enter(const char *what, const timing_work *triangles, const box_work *boxes, tribox_accuracy accuracy,
                    contestant *list)
{
    const char *kernel;
    size_t count = 1;
    list[0] = contestant_paper(triangles, PAPER_ORDER);
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++)
        list[count++] = contestant_kernel(triangles, &(tribox_options){.accuracy = accuracy, .kernel = kernel});
    for (size_t c = 0; c < count; c++) {
        list[c].pairs = (double)triangles->count;
        if (c && !strcmp(what, "meshes"))
            list[c].run = run_meshes;
        if (boxes) {
            list[c].question = boxes;
            list[c].run = c ? run_boxes : run_paper_boxes;
        }
    }
    return count;
}

/* The place in `counts` of the least one that fills the packets of a kernel of this many lanes, and is not less than counts[n]. */
static size_t next_full(size_t n, size_t lanes)
{
    size_t best = n;
    const size_t full = (counts[n] + lanes - 1) / lanes * lanes;
    for (size_t m = 0; m < COUNTS; m++)
        if (counts[m] == full)
            best = m;
    return best;
}

/* By the kernel's name: the public header does not say. */
static size_t lanes_of(const char *kernel)
{
    return !strcmp(kernel, "avx512") ? 16 : !strcmp(kernel, "avx2") ? 8 : !strcmp(kernel, "scalar") ? 1 : 4;
}

/* Times of contestant c about counts[n] are at n * of_each + c. */
static void tell(asked *q, const contestant *list, size_t of_each, size_t n)
{
    const double paper = measure_least(&q->taken, n * of_each);
    char full[KERNELS_MOST + 1][24], times[KERNELS_MOST + 1][24];
    ADD(&q->out, NUMBER("count", 0, (double)counts[n]), NUMBER("paper", 1, paper));
    for (size_t c = 1; c < of_each; c++) {
        const char *const kernel = list[c].options.kernel;
        const double least = measure_least(&q->taken, n * of_each + c);
        snprintf(full[c], sizeof full[c], "%s_full", kernel);
        snprintf(times[c], sizeof times[c], "%s_speed", kernel);
        ADD(&q->out, NUMBER(kernel, 1, least),
            NUMBER(full[c], 2, least / measure_least(&q->taken, next_full(n, lanes_of(kernel)) * of_each + c)),
            NUMBER(times[c], 2, paper / least));
    }
    printout_row(&q->out);
}

/* Everyone about each count answers for himself; then all are timed together. */
static bool run_shape(asked *q, const char *what, const timing_work *triangles, const box_work *boxes, tribox_accuracy accuracy)
{
    contestant list[CONTESTANTS_MAX];
    size_t of_each = 0, words = 0;
    for (size_t n = 0; n < COUNTS; n++) {
        const box_work *const about = boxes ? &boxes[n] : NULL;
        const size_t own_words = about ? about->words : triangles[n].words;
        const truth from = about ? (truth){find_truth_of_boxes, about, own_words} : truth_of_work(&triangles[n]);
        of_each = enter(what, &triangles[n], about, accuracy, list + n * of_each);
        words = own_words > words ? own_words : words;
        if (!asked_verify(q, what, list + n * of_each, of_each, &from))
            return false;
    }
    asked_measure(q, what, list, COUNTS * of_each, NULL, asked_effort(q, 31, 1e9, 5e-4), words);
    printout_table(&q->out,
                   "%s, %s: ns a call by kernel, times the next count of full packets, times the paper's speed; least times", what,
                   accuracy_word(accuracy));
    for (size_t n = 0; n < COUNTS_SHOWN; n++)
        tell(q, list, of_each, n);
    printout_disturbed(&q->out, &q->taken);
    return true;
}

/* ---- every call of the library, about the same few triangles again and again: the least that it takes ------------------------ */

enum { SIZES = 3, MOST = 64, TILE = 8, CELLS = 64 };

/* A few triangles in every form, and room for every answer. What a call of CALLS wants, one before it has made. */
typedef struct few {
    tribox_soup soup;
    tribox_mesh mesh;
    tribox_boxes boxes;
    tribox_box box;
    tribox_oriented_box turned;
    tribox_index index;
    const float *first;
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

static int take(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    (void)data, (void)at, (void)bits;
    return 0;
}

static int take_ids(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    (void)ids;
    return take(data, at, bits);
}

static int take_lists(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t starts[513], const uint32_t *list)
{
    (void)starts, (void)list;
    return take(data, at, bits);
}

static const tribox_sink sink = {take, NULL};
static const tribox_ids_sink ids_sink = {take_ids, NULL};
static const tribox_lists_sink lists_sink = {take_lists, NULL};

#define REGION (&(tribox_region){.box = &f->box})
#define BRICKS &cells, &tile, f->tile_start, f->in_tile, how, f->scratch

/* SAYS a status, which has to be that of success; LISTS in two passes, both timed; IS anything else. */
#define CALLS(SAYS, LISTS, IS) \
    SAYS(tribox_overlap, &f->soup, &f->box, how, f->mask, NULL) \
    SAYS(tribox_mesh_overlap, &f->mesh, &f->box, how, f->mask, NULL) \
    SAYS(tribox_overlap_oriented, &f->soup, &f->turned, how, f->mask, NULL) \
    SAYS(tribox_mesh_overlap_oriented, &f->mesh, &f->turned, how, f->mask, NULL) \
    SAYS(tribox_overlap_boxes, f->first, &f->boxes, how, f->mask, NULL) \
    SAYS(tribox_find, &f->soup, &f->box, how, TRIBOX_FIRST_HIT, &f->found) \
    SAYS(tribox_mesh_find, &f->mesh, &f->box, how, TRIBOX_FIRST_HIT, &f->found) \
    SAYS(tribox_classify, &f->soup, &f->box, how, f->mask, f->inside, NULL) \
    SAYS(tribox_mesh_classify, &f->mesh, &f->box, how, f->mask, f->inside, NULL) \
    SAYS(tribox_split, &f->soup, f->children_of, f->soup.count, &f->box, NULL, how, f->children, NULL) \
    SAYS(tribox_mesh_split, &f->mesh, f->children_of, f->soup.count, &f->box, NULL, how, f->children, NULL) \
    SAYS(tribox_index_build, &f->index, how, f->nodes) \
    SAYS(tribox_index_update, &f->index, 0, f->soup.count, how, f->nodes) \
    SAYS(tribox_index_overlap, &f->index, REGION, how, f->mask, NULL) \
    SAYS(tribox_index_words, &f->index, REGION, how, 1, f->number, f->bits, f->inside, &f->found, NULL) \
    SAYS(tribox_index_list, &f->index, REGION, how, MOST, f->list, &f->found) \
    SAYS(tribox_index_lists, &f->index, &f->boxes, how, MOST *MOST, f->list, f->start) \
    SAYS(tribox_index_any, &f->index, REGION, how, &f->found) \
    SAYS(tribox_soup_sort, &f->soup, f->order, f->scratch) \
    SAYS(tribox_mesh_sort, &f->mesh, f->order, f->scratch) \
    SAYS(tribox_boxes_sort, &f->boxes, f->order, f->scratch) \
    SAYS(tribox_soup_gather, &f->soup, f->order, 0, f->soup.count, f->to, f->to + 3, f->to + 6) \
    SAYS(tribox_mesh_gather, &f->mesh, NULL, f->order, 0, f->soup.count, f->to, f->to + 3, f->to + 6) \
    SAYS(tribox_mesh_to_soup, &f->mesh, NULL, 0, f->soup.count, how, f->to, f->to + 3, f->to + 6) \
    SAYS(tribox_voxelize, &f->soup, &cells, NULL, how, f->window, NULL) \
    SAYS(tribox_mesh_voxelize, &f->mesh, &cells, NULL, how, f->window, NULL) \
    SAYS(tribox_voxelize_ids, &f->soup, 0, &cells, NULL, how, f->window, f->ids, NULL) \
    SAYS(tribox_mesh_voxelize_ids, &f->mesh, 0, &cells, NULL, how, f->window, f->ids, NULL) \
    SAYS(tribox_voxelize_thin, &f->soup, &cells, NULL, how, f->solid, NULL) \
    SAYS(tribox_mesh_voxelize_thin, &f->mesh, &cells, NULL, how, f->solid, NULL) \
    IS(tribox_window_cells, f->window, cells.size, f->cells) \
    SAYS(tribox_fill_outside, cells.size, f->window, f->scratch, f->solid, &f->found) \
    SAYS(tribox_fill_parity, &f->soup, &cells, f->window, f->scratch, f->solid, &f->found, &f->odd) \
    SAYS(tribox_mesh_fill_parity, &f->mesh, &cells, f->window, f->scratch, f->solid, &f->found, &f->odd) \
    LISTS(tribox_cell_lists, f->in_cell, &f->soup, &cells, NULL, how, f->cell_start) \
    LISTS(tribox_mesh_cell_lists, f->in_cell, &f->mesh, &cells, NULL, how, f->cell_start) \
    LISTS(tribox_tile_lists, f->in_tile, &f->soup, &cells, &tile, how, f->tile_start) \
    LISTS(tribox_mesh_tile_lists, f->in_tile, &f->mesh, &cells, &tile, how, f->tile_start) \
    SAYS(tribox_bricks, &f->soup, BRICKS, &sink, NULL) \
    SAYS(tribox_mesh_bricks, &f->mesh, BRICKS, &sink, NULL) \
    SAYS(tribox_bricks_ids, &f->soup, BRICKS, &ids_sink, NULL) \
    SAYS(tribox_mesh_bricks_ids, &f->mesh, BRICKS, &ids_sink, NULL) \
    SAYS(tribox_bricks_lists, &f->soup, BRICKS, &lists_sink, NULL) \
    SAYS(tribox_mesh_bricks_lists, &f->mesh, BRICKS, &lists_sink, NULL) \
    IS(tribox_mask_indices, f->mask, f->soup.count, f->number) \
    IS(tribox_soup_not_finite, &f->soup, &f->found) \
    IS(tribox_mesh_not_finite, &f->mesh, &f->found) \
    IS(tribox_mesh_bad_vertices, &f->mesh, &f->found) \
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

static void make_few(const pairs *p, size_t count, few *f)
{
    const timing_job *const from = p->at.work.jobs;
    *f = (few){.soup = from->soup, .first = from->triangles[0][0], .box = from->box, .boxes.count = count};
    f->soup.count = count;
    f->mesh = (tribox_mesh){.positions = from->triangles, .vertices = 3 * count, .count = count};
    f->turned = (tribox_oriented_box){.half = {0.5f, 0.5f, 0.5f}, .axis = {{0.8f, 0.6f, 0}, {-0.6f, 0.8f, 0}, {0, 0, 1}}};
    f->nodes = asked_allocate(tribox_index_bytes(MOST), 1);
    f->scratch = asked_allocate(tribox_bricks_lists_bytes(TILE, MOST) + tribox_bricks_ids_bytes(TILE), 1);
    f->index = (tribox_index){.nodes = f->nodes, .soup = &f->soup};
    for (size_t a = 0; a < 3; a++) {
        f->boxes.lo[a] = p->bounds + a * PAIRS;
        f->boxes.hi[a] = p->bounds + (3 + a) * PAIRS;
    }
    for (uint32_t n = 0; n < MOST; n++)
        f->children_of[n] = n;
    for (size_t n = 0; n < 9; n++)
        f->to[n] = f->streams[n];
}

static bool run_calls(asked *q, const pairs *p)
{
    static few about[SIZES];
    static const size_t sizes[SIZES] = {1, 8, 64};
    contestant list[SIZES];
    bool is_right = true;
    for (size_t n = 0; n < SIZES; n++)
        make_few(p, sizes[n], &about[n]);
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
    static const char *const shapes[] = {"triangles", "boxes", "meshes"};
    static const tribox_accuracy accuracies[] = {TRIBOX_EXACT, TRIBOX_FAST};
    static timing_work triangles[COUNTS];
    static box_work boxes[COUNTS];
    static pairs p;
    make_pairs(&p);
    for (size_t n = 0; n < COUNTS; n++) {
        make_triangles(&p, counts[n], &triangles[n]);
        make_boxes(&p, counts[n], &boxes[n]);
    }
    bool is_right = true;
    for (int shape = 0; shape < 3; shape++)
        for (int a = 0; a < 2; a++)
            is_right = is_right && run_shape(q, shapes[shape], triangles, shape == 1 ? boxes : NULL, accuracies[a]);
    is_right = is_right && run_calls(q, &p);
    for (size_t n = 0; n < COUNTS; n++)
        timing_work_free(&triangles[n]);
    scene_free(&p.at);
    return is_right;
}

const bench_question question_calls = {.name = "calls",
                                       .asks =
                                           "What does a call about a few triangles, or a few boxes, cost, beside the paper's test?",
                                       .options = 1u << OPTION_KERNEL | 1u << OPTION_QUICK,
                                       .answer = answer};
