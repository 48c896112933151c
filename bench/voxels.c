/*
 * voxels.c - how fast are soups voxelized, against the paper's test for each cell, against Schwarz and Seidel (rivals.h), and
 * against what reading the soup or writing the answer takes ?
 *
 * EXACT has to be the same on every kernel and on two threads, CONSERVATIVE a superset, or nothing is timed. The bits are cleared
 * before each pass, outside the time. A rival that takes too long for one pass is timed once, and if even that would take minutes,
 * on every n-th triangle; the table says so.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/box_scenes.h"
#include "common/rivals.h"
#include "console/clock.h"
#include "voxelize/layers.h"

enum { EXACT, CONSERVATIVE, FAST, TWO_THREADS, RIVAL_SEIDEL, RIVAL_CELLS, READING, WRITING, TIMED };

/* A soup and a grid. */
typedef struct task {
    const char *name;
    const timing_job *at;
    tribox_grid grid;
    size_t words;
    uint64_t *bits;
    float (*sample)[3][3]; /* room for the triangles that a rival is timed on */
    size_t step[TIMED];    /* every step-th triangle is timed */
    voxel_words answer;    /* what `writing` writes */
} task;

/* ---- who is timed ---------------------------------------------------------------------------------------------------------- */

static void clear(const contestant *self, uint64_t *bits)
{
    const task *const t = self->question;
    memset(bits, 0, t->words * sizeof *bits);
}

CONTESTANT_RUN(run_tribox)
{
    const task *const t = self->question;
    return !tribox_voxelize(&t->at->soup, &t->grid, NULL, &self->options, mask, report);
}

CONTESTANT_RUN(run_threads)
{
    const task *const t = self->question;
    const voxel_task work = voxel_task_of_soup(&t->at->soup, &t->grid, &self->options);
    return !voxelize_in_threads(&work, 2, mask, report, NULL);
}

static size_t pick_sample(const task *t, size_t step)
{
    size_t count = 0;
    for (size_t i = 0; i < t->at->soup.count; i += step)
        memcpy(t->sample[count++], t->at->triangles[i], sizeof t->sample[0]);
    return count;
}

static bool run_rival(const task *t, voxel_rival *rival, int which, uint64_t *bits)
{
    const size_t step = t->step[which];
    const bool is_sample = step > 1;
    const size_t count = is_sample ? (t->at->soup.count + step - 1) / step : t->at->soup.count;
    rival(&t->grid, is_sample ? (const float(*)[3][3])t->sample : t->at->triangles, count, bits);
    return true;
}

CONTESTANT_RUN(run_seidel) { return run_rival(self->question, voxelize_schwarz_seidel, RIVAL_SEIDEL, mask); }

CONTESTANT_RUN(run_cells) { return run_rival(self->question, voxelize_cell_by_cell, RIVAL_CELLS, mask); }

CONTESTANT_RUN(run_reading)
{
    const task *const t = self->question;
    mask[0] = loads_all(&t->at->soup);
    return true;
}

CONTESTANT_RUN(run_writing)
{
    const task *const t = self->question;
    const size_t set = voxel_words_write(&t->answer, mask);
    if (report)
        *report = (tribox_report){.overlapping = set};
    return true;
}

/* The sample of the rival is picked anew, as both rivals share the room. */
static void clear_and_pick(const contestant *self, uint64_t *bits)
{
    const task *const t = self->question;
    const size_t step = t->step[self->run == run_seidel ? RIVAL_SEIDEL : RIVAL_CELLS];
    clear(self, bits);
    if (step > 1)
        pick_sample(t, step);
}

/* A rival promises nothing until it is known to be fast enough. */
static const struct entry {
    const char *name;
    contestant_run *run;
    tribox_accuracy accuracy;
    answer_promise promise;
} entries[TIMED] = {
    [EXACT] = {"exact", run_tribox, TRIBOX_EXACT, PROMISE_EXACT},
    [CONSERVATIVE] = {"conservative", run_tribox, TRIBOX_CONSERVATIVE, PROMISE_SUPERSET},
    [FAST] = {"fast", run_tribox, TRIBOX_FAST, PROMISE_ROUNDED},
    [TWO_THREADS] = {"exact, 2 threads", run_threads, TRIBOX_EXACT, PROMISE_EXACT},
    [RIVAL_SEIDEL] = {"Schwarz-Seidel", run_seidel, TRIBOX_EXACT, PROMISE_NOTHING},
    [RIVAL_CELLS] = {"cell by cell", run_cells, TRIBOX_EXACT, PROMISE_NOTHING},
    [READING] = {"reading", run_reading, TRIBOX_EXACT, PROMISE_NOTHING},
    [WRITING] = {"writing", run_writing, TRIBOX_EXACT, PROMISE_EXACT},
};

/* Those that are timed, then EXACT on every kernel, to be verified. */
static size_t enter(const task *t, const char *chosen, contestant *list)
{
    const char *kernel;
    size_t count = 0;
    for (; count < TIMED; count++) {
        const struct entry *const e = &entries[count];
        const bool is_rival = e->run == run_seidel || e->run == run_cells;
        list[count] = (contestant){.run = e->run,
                                   .prepare = is_rival ? clear_and_pick : clear,
                                   .question = t,
                                   .options = {.accuracy = e->accuracy, .kernel = is_rival ? NULL : chosen},
                                   .promise = e->promise,
                                   .pairs = (double)t->at->soup.count,
                                   .has_threads = e->run == run_threads};
        snprintf(list[count].name, sizeof list[count].name, "%s", e->name);
    }
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++) {
        list[count] = list[EXACT];
        list[count].options.kernel = kernel;
        snprintf(list[count++].name, sizeof list[0].name, "exact on %s", kernel);
    }
    return count;
}

static bool find_truth(const void *question, unsigned axes, uint64_t *bits)
{
    const task *const t = question;
    memset(bits, 0, t->words * sizeof *bits);
    return !tribox_voxelize(&t->at->soup, &t->grid, NULL, &(tribox_options){.axes = axes, .kernel = "scalar"}, bits, NULL);
}

/* The seconds of a pass over every step-th triangle. */
static double seconds_of(task *t, contestant *rival, int c, size_t step)
{
    t->step[c] = step;
    rival->prepare(rival, t->bits);
    const double begin = clock_seconds();
    rival->run(rival, t->bits, NULL);
    return clock_seconds() - begin;
}

/* Which part of the triangles a rival can do in the time: the time of a coarse sample foretells that of a finer one. */
static void choose_step(task *t, contestant *rival, int c, double limit, size_t rounds)
{
    const size_t all = t->at->soup.count;
    size_t step = all;
    double seconds = seconds_of(t, rival, c, step);
    while (step > 1 && 4 * seconds < limit) {
        step = step / 4 ? step / 4 : 1;
        seconds = seconds_of(t, rival, c, step);
    }
    rival->pairs = (double)((all + step - 1) / step);
    rival->is_timed_once = seconds > limit / (double)rounds;
    rival->promise = step == 1 ? PROMISE_ROUNDED : PROMISE_NOTHING;
}

static void tell(asked *q, const task *t, const contestant *list)
{
    const double triangles = (double)t->at->soup.count, set = (double)q->scores[EXACT].overlapping;
    const double exact = measure_least(&q->taken, EXACT);
    for (size_t c = 0; c < TIMED; c++) {
        const double ns = measure_least(&q->taken, c); /* other work only ever adds to a time */
        const bool has_unlike = list[c].promise == PROMISE_ROUNDED;
        ROW(&q->out, TEXT("contestant", list[c].name), TEXT_DATA("scene", t->name), DATA("triangles", triangles), DATA("set", set),
            NUMBER("ns_a_triangle", 1, ns), NUMBER("ns_a_cell", 2, ns * triangles / set), NUMBER("million_a_second", 3, 1e3 / ns),
            NUMBER("times_exact", 3, ns / exact), NUMBER("one_of", 0, (double)t->step[c]),
            NUMBER("cells_unlike", 0, has_unlike ? (double)score_unlike(&q->scores[c]) : (double)NAN),
            TEXT("timed", list[c].is_timed_once ? "once" : ""));
    }
}

static bool answer_task(asked *q, task *t)
{
    contestant list[CONTESTANTS_MAX];
    const truth from = {find_truth, t, t->words};
    const size_t count = enter(t, q->kernel, list);
    const bool is_quick = asked_has(q, OPTION_QUICK);
    const size_t rounds = (size_t)asked_number(q, OPTION_ROUNDS, is_quick ? 3 : 9);
    const double limit = (double)asked_number(q, OPTION_LIMIT, 5);
    if (!voxel_words_find(&t->at->soup, &t->grid, &list[EXACT].options, t->bits, &t->answer))
        return message_failure("out of memory for the words of the answer; choose fewer cells") == EXIT_CODE_OK;
    for (int c = RIVAL_SEIDEL; c <= RIVAL_CELLS; c++)
        choose_step(t, &list[c], c, is_quick ? 0.2 : limit, rounds);
    list[RIVAL_CELLS].promise = PROMISE_NOTHING;
    if (!asked_verify(q, t->name, list, count, &from))
        return false;
    asked_measure(q, t->name, list, TIMED, NULL, (effort){.rounds = rounds, .seconds = 1e9}, t->words);
    printout_table(&q->out, "%s, %u x %u x %u cells: %zu triangles, %zu cells set; %.1f MiB of bits", t->name, t->grid.size[0],
                   t->grid.size[1], t->grid.size[2], t->at->soup.count, q->scores[EXACT].overlapping,
                   (double)t->words * 8 / 1048576);
    tell(q, t, list);
    return true;
}

/* Products of the ratios over the soups that were read from files, for each number of cells. */
typedef struct means {
    double logarithm[ASKED_CELLS][TIMED];
    size_t count;
} means;

static means of_meshes;

static bool ask_scene(asked *q, scene *about, size_t number)
{
    const timing_job *const at = about->work.jobs;
    const bool is_mesh = asked_has(q, OPTION_NO_SCENES) || number >= 3;
    bool is_right = true;
    for (size_t r = 0; is_right && r < q->cell_counts; r++) {
        void *const mark = asked_mark();
        task t = {.name = about->name, .at = at, .grid = scene_grid(about, q->cells[r])};
        for (size_t c = 0; c < TIMED; c++)
            t.step[c] = 1;
        t.words = tribox_window_words(t.grid.size);
        t.bits = asked_allocate(t.words, sizeof *t.bits);
        t.sample = asked_allocate(at->soup.count, sizeof *t.sample);
        is_right = answer_task(q, &t);
        for (size_t c = 0; is_right && is_mesh && c < TIMED; c++)
            of_meshes.logarithm[r][c] += log(measure_least(&q->taken, c) / measure_least(&q->taken, EXACT));
        voxel_words_free(&t.answer);
        asked_release(mark);
    }
    of_meshes.count += is_mesh;
    return is_right;
}

static void tell_means(asked *q, const means *m)
{
    char cells[ASKED_CELLS][16];
    if (!m->count)
        return;
    printout_table(&q->out, "geometric means over %zu meshes, times exact, by cells", m->count);
    for (size_t c = CONSERVATIVE; c < TIMED; c++) {
        double all = 0;
        ADD(&q->out, TEXT("contestant", entries[c].name));
        for (size_t r = 0; r < q->cell_counts; r++) {
            snprintf(cells[r], sizeof cells[r], "%u", q->cells[r]);
            ADD(&q->out, NUMBER(cells[r], 3, exp(m->logarithm[r][c] / (double)m->count)));
            all += m->logarithm[r][c];
        }
        ROW(&q->out, NUMBER("all", 3, exp(all / (double)(m->count * q->cell_counts))));
    }
}

static bool answer(asked *q)
{
    asked_cells(q, asked_has(q, OPTION_QUICK) ? (const uint32_t[]){128, 128} : (const uint32_t[]){256, 1024},
                asked_has(q, OPTION_QUICK) ? 1 : 2);
    const bool is_right = scenes_ask(q, SCENES_MADE, 0, ask_scene);
    if (is_right)
        tell_means(q, &of_meshes);
    return is_right;
}

const bench_question question_voxels = {
    .name = "voxels",
    .asks = "How fast are soups voxelized, beside the paper's test for each cell, Schwarz and Seidel 2010, and two lower bounds?",
    .options = 1u << OPTION_CELLS | 1u << OPTION_KERNEL | 1u << OPTION_LIMIT | 1u << OPTION_NO_SCENES | 1u << OPTION_QUICK,
    .takes_meshes = true,
    .answer = answer};
