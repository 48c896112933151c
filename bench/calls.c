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

static void free_pairs(pairs *p)
{
    scene_free(&p->at);
    free(p->bounds);
    free(p->placed);
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

static bool run_paper_boxes(const contestant *self, uint64_t *mask, tribox_report *report)
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
    (void)report;
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

static bool run_boxes(const contestant *self, uint64_t *mask, tribox_report *report)
{
    (void)report;
    return answer_boxes(self->question, &self->options, mask);
}

/* The same triangles as a mesh of nine floats each. */
static bool run_meshes(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const timing_work *const work = self->question;
    bool is_right = true;
    (void)report;
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

/* A call each about some triangles of the scene, into 4 x 4 x 4 cells. */
static const tribox_grid few_cells = {.origin = {-2, -2, -2}, .cell = {1, 1, 1}, .size = {4, 4, 4}};
static bool run_voxelize(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const timing_work *const work = self->question;
    for (size_t call = 0; call < work->count; call++)
        if (tribox_voxelize(&work->jobs[call].soup, &few_cells, NULL, &self->options, mask, report))
            return false;
    return true;
}

static bool run_mesh_voxelize(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const timing_work *const work = self->question;
    for (size_t call = 0; call < work->count; call++) {
        const size_t count = work->jobs[call].soup.count;
        const tribox_mesh mesh = {.positions = work->jobs[call].triangles, .vertices = 3 * count, .count = count};
        if (tribox_mesh_voxelize(&mesh, &few_cells, NULL, &self->options, mask, report))
            return false;
    }
    return true;
}

static void run_cells(asked *q, const timing_work *triangles)
{
    enum { SIZES = 3 };
    static const size_t at[SIZES] = {1, 4, 10}; /* of counts: 1, 8, 64 */
    static const char *const names[2 * SIZES] = {"soup_of_1", "of_8", "of_64", "mesh_of_1", "mesh_of_8", "mesh_of_64"};
    contestant list[CONTESTANTS_MAX];
    size_t count = 0;
    const char *kernel;
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++)
        for (size_t n = 0; n < 2 * SIZES; n++) {
            list[count] = contestant_kernel(&triangles[at[n % SIZES]], &(tribox_options){.kernel = kernel});
            list[count].pairs = (double)triangles[at[n % SIZES]].count;
            list[count++].run = n < SIZES ? run_voxelize : run_mesh_voxelize;
        }
    asked_measure(q, "cells", list, count, NULL, asked_effort(q, 31, 1e9, 5e-4), triangles[1].words + 4 * 4);
    printout_table(&q->out, "cells, exact: ns a call about 1, 8 and 64 triangles, of tribox_voxelize and tribox_mesh_voxelize");
    for (size_t c = 0; c < count; c += 2 * SIZES) {
        ADD(&q->out, TEXT("kernel", list[c].options.kernel));
        for (size_t n = 0; n < 2 * SIZES; n++)
            ADD(&q->out, NUMBER(names[n], 1, measure_least(&q->taken, c + n)));
        printout_row(&q->out);
    }
    printout_disturbed(&q->out, &q->taken);
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
    if (is_right)
        run_cells(q, triangles);
    for (size_t n = 0; n < COUNTS; n++)
        timing_work_free(&triangles[n]);
    free_pairs(&p);
    return is_right;
}

const bench_question question_calls = {.name = "calls",
                                       .asks =
                                           "What does a call about a few triangles, or a few boxes, cost, beside the paper's test?",
                                       .options = 1u << OPTION_QUICK,
                                       .answer = answer};
