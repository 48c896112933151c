/* timing.c - soups to time, who is timed, whether they answer right, and rounds of samples. */
#define _POSIX_C_SOURCE 200809L
#include "timing.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "console/accuracy.h"
#include "console/clock.h"
#include "paper/paper.h"

/* ---- work -------------------------------------------------------------------------------------------------------------------- */

enum { CACHE_LINE = 64, LINE_FLOATS = CACHE_LINE / sizeof(float) };

size_t timing_work_room(size_t triangles) { return (triangles + LINE_FLOATS - 1) / LINE_FLOATS * LINE_FLOATS; }

bool timing_work_make(timing_work *work, size_t jobs, size_t room)
{
    const size_t bytes = 9 * sizeof(float);
    *work = (timing_work){.jobs = NULL};
    if (room > (SIZE_MAX - CACHE_LINE) / (2 * bytes) || jobs > SIZE_MAX / sizeof(timing_job))
        return false;
    work->jobs = malloc(jobs * sizeof *work->jobs);
    work->memory = malloc(2 * room * bytes + CACHE_LINE);
    if (!work->jobs || !work->memory) {
        timing_work_free(work);
        return false;
    }
    unsigned char *const first = (unsigned char *)work->memory + (CACHE_LINE - (uintptr_t)work->memory % CACHE_LINE);
    work->streams = (float *)(void *)first;
    work->triangles = (float(*)[3][3])(void *)(first + room * bytes);
    return true;
}

timing_job timing_work_soup(timing_work *work, size_t count)
{
    const size_t stride = timing_work_room(count);
    const float(*const triangles)[3][3] = (const float(*)[3][3])(work->triangles + work->used);
    float *to = work->streams + 9 * work->used;
    timing_job job = {.soup = {.count = count}, .triangles = triangles};
    const float **const streams[3] = {job.soup.x, job.soup.y, job.soup.z};
    for (size_t a = 0; a < 3; a++)
        for (size_t j = 0; j < 3; j++, to += stride) {
            for (size_t i = 0; i < count; i++)
                to[i] = triangles[i][j][a];
            streams[a][j] = to;
        }
    work->used += stride;
    return job;
}

timing_job timing_work_copy(timing_work *work, const tribox_soup *soup, const uint32_t *which, size_t count)
{
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    float(*const triangles)[3][3] = work->triangles + work->used;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < 3; j++)
            for (size_t a = 0; a < 3; a++)
                triangles[i][j][a] = streams[a][j][which ? which[i] : i];
    return timing_work_soup(work, count);
}

void timing_work_add(timing_work *work, const timing_job *job, const tribox_box *box)
{
    timing_job *const added = &work->jobs[work->count++];
    *added = *job;
    added->box = *box;
    for (int a = 0; a < 3; a++) {
        added->center[a] = (float)box->lo[a] / 2 + (float)box->hi[a] / 2;
        added->half[a] = (float)box->hi[a] / 2 - (float)box->lo[a] / 2;
    }
    work->pairs += job->soup.count;
    work->words += tribox_mask_words(job->soup.count);
}

/* Finds vertices by what they are, in a table with open places. */
typedef struct weld {
    uint32_t *place; /* vertex + 1; 0 where none is */
    size_t mask;
    float (*positions)[3];
    size_t vertices;
} weld;

static uint32_t vertex_of(weld *w, const float p[3])
{
    uint32_t bits[3];
    memcpy(bits, p, sizeof bits);
    uint64_t hash = (bits[0] * UINT64_C(0x9e3779b97f4a7c15)) ^ (bits[1] * UINT64_C(0xbf58476d1ce4e5b9)) ^
                    (bits[2] * UINT64_C(0x94d049bb133111eb));
    for (size_t at = (size_t)(hash ^ hash >> 29) & w->mask;; at = (at + 1) & w->mask) {
        if (!w->place[at]) {
            memcpy(w->positions[w->vertices++], p, sizeof w->positions[0]);
            w->place[at] = (uint32_t)w->vertices;
        }
        if (!memcmp(w->positions[w->place[at] - 1], p, sizeof w->positions[0]))
            return w->place[at] - 1;
    }
}

size_t weld_soup(const tribox_soup *soup, float (*positions)[3], uint32_t (*corners)[3])
{
    size_t places = 64;
    while (places < 6 * soup->count)
        places *= 2;
    weld w = {.place = calloc(places, sizeof *w.place), .mask = places - 1, .positions = positions};
    for (size_t i = 0; w.place && i < soup->count; i++)
        for (size_t v = 0; v < 3; v++)
            corners[i][v] = vertex_of(&w, (const float[3]){soup->x[v][i], soup->y[v][i], soup->z[v][i]});
    free(w.place);
    return w.vertices;
}

bool timing_work_mesh(timing_work *work)
{
    const tribox_soup *const soup = &work->jobs[0].soup;
    work->positions = malloc(9 * soup->count * sizeof(float));
    work->corners = malloc(3 * soup->count * sizeof(uint32_t));
    const bool has_room = work->positions && work->corners;
    const size_t vertices = has_room ? weld_soup(soup, work->positions, work->corners) : 0;
    work->mesh = (tribox_mesh){.positions = work->positions,
                               .vertices = vertices,
                               .indices = work->corners,
                               .index_bytes = sizeof(uint32_t),
                               .count = vertices ? soup->count : 0};
    return vertices;
}

void timing_work_shorten(timing_work *work, size_t triangles)
{
    work->pairs = work->words = 0;
    for (size_t i = 0; i < work->count; i++) {
        tribox_soup *const soup = &work->jobs[i].soup;
        soup->count = soup->count < triangles ? soup->count : triangles;
        work->pairs += soup->count;
        work->words += tribox_mask_words(soup->count);
    }
}

void timing_work_free(timing_work *work)
{
    free(work->jobs);
    free(work->memory);
    free(work->positions);
    free(work->corners);
    *work = (timing_work){.jobs = NULL};
}

/* ---- who is timed ------------------------------------------------------------------------------------------------------------ */

CONTESTANT_RUN(run_paper)
{
    const timing_work *const work = self->question;
    paper_walk *const walk = paper_in_order(self->options.axis_order);
    for (size_t i = 0; i < work->count; i++) {
        const timing_job *const job = &work->jobs[i];
        walk(job->center, job->half, job->triangles, job->soup.count, mask);
        mask += tribox_mask_words(job->soup.count);
    }
    return true;
}

CONTESTANT_RUN(run_kernel)
{
    const timing_work *const work = self->question;
    tribox_report of_job;
    for (size_t i = 0; i < work->count; i++) {
        const timing_job *const job = &work->jobs[i];
        if (tribox_overlap(&job->soup, &job->box, &self->options, mask, report ? &of_job : NULL))
            return false;
        mask += tribox_mask_words(job->soup.count);
        if (report) {
            report->overlapping += of_job.overlapping;
            report->undecided += of_job.undecided;
        }
    }
    return true;
}

contestant contestant_paper(const timing_work *work, unsigned order)
{
    return (contestant){.name = "paper",
                        .run = run_paper,
                        .question = work,
                        .options = {.accuracy = TRIBOX_FAST, .axes = TRIBOX_AXES_ALL, .axis_order = order},
                        .promise = PROMISE_ROUNDED,
                        .pairs = (double)work->pairs};
}

contestant contestant_kernel(const timing_work *work, const tribox_options *options)
{
    contestant one = {.run = run_kernel,
                      .question = work,
                      .options = *options,
                      .promise = options->accuracy == TRIBOX_EXACT          ? PROMISE_EXACT
                                 : options->accuracy == TRIBOX_CONSERVATIVE ? PROMISE_SUPERSET
                                                                            : PROMISE_ROUNDED,
                      .pairs = (double)work->pairs};
    snprintf(one.name, sizeof one.name, "%s-%s", options->kernel, accuracy_word(options->accuracy));
    return one;
}

CONTESTANT_RUN(run_mesh)
{
    const timing_work *const work = self->question;
    return !tribox_mesh_overlap(&work->mesh, &work->jobs[0].box, &self->options, mask, report);
}

size_t contestants_enter(const timing_work *work, contestant *list)
{
    static const tribox_accuracy accuracies[] = {TRIBOX_FAST, TRIBOX_CONSERVATIVE, TRIBOX_EXACT};
    const char *kernel;
    size_t count = 0;
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++) {
        for (size_t a = 0; a < sizeof accuracies / sizeof accuracies[0]; a++)
            list[count++] = contestant_kernel(work, &(tribox_options){.accuracy = accuracies[a], .kernel = kernel});
        if (work->mesh.count) {
            list[count] = contestant_kernel(work, &(tribox_options){.kernel = kernel});
            list[count].run = run_mesh;
            snprintf(list[count++].name, sizeof list[0].name, "%s-mesh", kernel);
        }
    }
    return count;
}

size_t contestant_fast_of(const contestant *list, size_t count, size_t c)
{
    const tribox_options *const own = &list[c].options;
    for (size_t f = 0; own->kernel && f < count; f++) {
        const tribox_options *const other = &list[f].options;
        if (other->kernel && other->accuracy == TRIBOX_FAST && other->axes == own->axes && !strcmp(own->kernel, other->kernel))
            return f;
    }
    return c;
}

static bool find_truth(const void *work, unsigned axes, uint64_t *mask)
{
    const contestant scalar = contestant_kernel(work, &(tribox_options){.axes = axes, .kernel = "scalar"});
    return run_kernel(&scalar, mask, NULL);
}

truth truth_of_work(const timing_work *work) { return (truth){find_truth, work, work->words}; }

/* ---- verifying --------------------------------------------------------------------------------------------------------------- */

/* The masks of a verification: each of as many words. */
typedef struct masks {
    uint64_t *of_all, *of_axes; /* the truth on all axes, and on those of the contestant */
    uint64_t *answer, *before;  /* of the contestant, and of the one before it */
    unsigned axes;              /* of of_axes */
    size_t words;
} masks;

static bool fail(const contestant *one, const char *what, char wrong[VERIFY_TEXT])
{
    snprintf(wrong, VERIFY_TEXT, "%s: %s", one->name, what);
    return false;
}

static unsigned axes_of(const contestant *one) { return one->options.axes ? one->options.axes : (unsigned)TRIBOX_AXES_ALL; }

static size_t count_bits(uint64_t word) { return word ? tribox_mask_indices(&word, 64, NULL) : 0; }

static answer_errors compare(const uint64_t *exact, const uint64_t *answer, size_t words)
{
    answer_errors e = {0, 0};
    for (size_t w = 0; w < words; w++) {
        e.missed += count_bits(exact[w] & ~answer[w]);
        e.untrue += count_bits(answer[w] & ~exact[w]);
    }
    return e;
}

static bool are_alike(const contestant *p, const contestant *q)
{
    const bool is_same_kernel = p->options.kernel && q->options.kernel && !strcmp(p->options.kernel, q->options.kernel);
    return is_same_kernel && p->run == q->run && p->which == q->which && p->options.accuracy == q->options.accuracy &&
           axes_of(p) == axes_of(q);
}

static bool keeps_promise(const contestant *one, const score *s, char wrong[VERIFY_TEXT])
{
    if (one->promise >= PROMISE_SUPERSET && s->of_accuracy.missed)
        return fail(one, "misses an overlap", wrong);
    if (one->promise == PROMISE_EXACT && s->of_accuracy.untrue)
        return fail(one, "reports an overlap that does not exist", wrong);
    return true;
}

static bool verify_one(const contestant *one, const contestant *before, const truth *from, masks *m, score *s,
                       char wrong[VERIFY_TEXT])
{
    const size_t bytes = m->words * sizeof *m->answer;
    tribox_report report = {0, 0};
    if (axes_of(one) != m->axes && !from->find(from->question, m->axes = axes_of(one), m->of_axes))
        return fail(one, "tribox refuses the question", wrong);
    memset(m->answer, 0xff, bytes); /* a contestant that writes nothing is seen */
    if (one->prepare)
        one->prepare(one, m->answer);
    if (!one->run(one, m->answer, &report))
        return fail(one, "tribox refuses the question", wrong);
    const uint64_t *const exact = axes_of(one) == TRIBOX_AXES_ALL ? m->of_all : m->of_axes;
    *s = (score){.overlapping = tribox_mask_indices(m->answer, 64 * m->words, NULL),
                 .undecided = report.undecided,
                 .of_accuracy = compare(exact, m->answer, m->words),
                 .of_all = compare(m->of_all, m->answer, m->words)};
    if (before && are_alike(one, before) && memcmp(m->answer, m->before, bytes) != 0)
        return fail(one, "another order of the axes changes its answer", wrong);
    uint64_t *const answer = m->answer;
    m->answer = m->before;
    m->before = answer;
    return keeps_promise(one, s, wrong);
}

bool verify(const contestant *list, size_t count, const truth *from, score *scores, char wrong[VERIFY_TEXT])
{
    const size_t words = from->words;
    uint64_t *const storage = malloc((4 * words + 1) * sizeof *storage);
    masks m = {storage, storage + words, storage + 2 * words, storage + 3 * words, TRIBOX_AXES_ALL, words};
    bool is_right = storage || fail(&list[0], "out of memory for the answers", wrong);
    if (is_right && !from->find(from->question, TRIBOX_AXES_ALL, m.of_all))
        is_right = fail(&list[0], "tribox refuses the question", wrong);
    const contestant *before = NULL;
    for (size_t c = 0; is_right && c < count; c++) {
        scores[c] = (score){.overlapping = 0};
        const bool has_answer = list[c].promise != PROMISE_NOTHING;
        is_right = !has_answer || verify_one(&list[c], before, from, &m, &scores[c], wrong);
        before = has_answer ? &list[c] : NULL;
    }
    free(storage);
    return is_right;
}

/* ---- measuring --------------------------------------------------------------------------------------------------------------- */

/* Windows counts the time of threads in ticks of 15 ms. */
static bool has_fine_thread_time(void)
{
    struct timespec step;
    return !clock_getres(CLOCK_THREAD_CPUTIME_ID, &step) && !step.tv_sec && step.tv_nsec <= 1000;
}

double timing_seconds(bool has_threads)
{
    struct timespec now;
    if (has_threads || !has_fine_thread_time() || clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now))
        return clock_seconds();
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double seconds_for(const contestant *one, size_t runs, uint64_t *mask)
{
    double seconds = 0, begin = timing_seconds(one->has_threads);
    for (size_t i = 0; i < runs; i++) {
        if (one->prepare) {
            seconds += timing_seconds(one->has_threads) - begin;
            one->prepare(one, mask);
            begin = timing_seconds(one->has_threads);
        }
        one->run(one, mask, NULL);
    }
    return seconds + timing_seconds(one->has_threads) - begin;
}

/* Runs that last long enough, by the better of two tries: one interruption must not leave a contestant with short samples. */
static size_t calibrate(const contestant *one, double sample, uint64_t *mask)
{
    for (size_t runs = 1; sample > 0;) {
        double seconds = seconds_for(one, runs, mask);
        if (seconds < 8 * sample)
            seconds = fmin(seconds, seconds_for(one, runs, mask));
        if (seconds >= sample)
            return runs;
        runs *= (size_t)fmin(fmax(1.2 * sample / fmax(seconds, 1e-7), 2), 100);
    }
    return 1;
}

static void shuffle(size_t *turns, size_t count, generator *g)
{
    for (size_t i = count; i > 1; i--) {
        const size_t j = random_below(g, i), held = turns[i - 1];
        turns[i - 1] = turns[j];
        turns[j] = held;
    }
}

/* Round 0 warms up. A contestant that is timed once keeps its time of round 1. */
static void take_turn(const contestant *one, size_t runs, size_t round, uint64_t *mask, double *ns)
{
    if (one->is_timed_once && round != 1) {
        if (round)
            ns[round - 1] = ns[0];
        return;
    }
    const double seconds = seconds_for(one, runs, mask);
    if (round)
        ns[round - 1] = 1e9 * seconds / ((double)runs * one->pairs);
}

bool measure(const contestant *list, size_t count, effort how, generator *order, size_t words, samples *taken)
{
    size_t runs[CONTESTANTS_MAX], turns[CONTESTANTS_MAX];
    const double begin = clock_seconds();
    uint64_t *const mask = calloc(words + 1, sizeof *mask);
    for (size_t c = 0; mask && c < count; c++) {
        turns[c] = c;
        runs[c] = list[c].is_timed_once ? 1 : calibrate(&list[c], how.sample, mask);
    }
    taken->contestants = count;
    taken->rounds = 0;
    for (size_t round = 0; mask && round <= how.rounds; round++) {
        if (round > MEASURE_LEAST && clock_seconds() - begin > how.seconds)
            break;
        shuffle(turns, count, order);
        for (size_t t = 0; t < count; t++)
            take_turn(&list[turns[t]], runs[turns[t]], round, mask, taken->ns[turns[t]]);
        taken->rounds = round;
    }
    free(mask);
    return mask;
}

const char *contest_run(contest *c, const timing_work *work, effort how, generator *order)
{
    static char wrong[VERIFY_TEXT];
    const truth from = truth_of_work(work);
    if (!verify(c->list, c->count, &from, c->scores, wrong))
        return wrong;
    return measure(c->list, c->count, how, order, work->words, &c->taken) ? NULL : "out of memory for the answers";
}

static int by_value(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* Between neighbours in rank, the straight line. */
static double quantile(const double *sorted, size_t count, double part)
{
    const double rank = part * (double)(count - 1);
    const size_t below = (size_t)rank, above = below + 1 < count ? below + 1 : below;
    return sorted[below] + (rank - (double)below) * (sorted[above] - sorted[below]);
}

static spread spread_of(double *values, size_t count)
{
    qsort(values, count, sizeof *values, by_value);
    return (spread){values[0], quantile(values, count, 0.25), quantile(values, count, 0.5), quantile(values, count, 0.75)};
}

spread measure_spread(const samples *taken, size_t of)
{
    double values[MEASURE_MOST];
    memcpy(values, taken->ns[of], taken->rounds * sizeof *values);
    return spread_of(values, taken->rounds);
}

spread measure_ratio(const samples *taken, size_t of, size_t to)
{
    double values[MEASURE_MOST];
    for (size_t r = 0; r < taken->rounds; r++)
        values[r] = taken->ns[of][r] / taken->ns[to][r];
    return spread_of(values, taken->rounds);
}

double measure_least(const samples *taken, size_t of) { return measure_spread(taken, of).least; }

size_t measure_wins(const samples *taken, size_t of, size_t to)
{
    size_t won = 0;
    for (size_t r = 0; r < taken->rounds; r++)
        won += taken->ns[of][r] < taken->ns[to][r];
    return won;
}

size_t measure_disturbed(const samples *taken)
{
    size_t disturbed = 0;
    for (size_t c = 0; c < taken->contestants; c++)
        disturbed += measure_spread(taken, c).median > 1.1 * measure_least(taken, c);
    return disturbed;
}
