/*
 * main.c - how fast are soups voxelized, against the paper's test for each cell, against Schwarz and Seidel (voxel_rivals.h), and
 * against what reading the soup or writing the answer takes (voxel_limits.h)?
 *
 * EXACT has to be the same on every kernel and on two threads, CONSERVATIVE a superset, or nothing is timed. The bits are cleared
 * before each pass, outside the time. A rival that takes too long for one pass is timed once, and if even that would take minutes,
 * on every n-th triangle; the table says so.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "common/entries.h"
#include "common/header.h"
#include "common/loads.h"
#include "common/mesh_list.h"
#include "common/whole.h"
#include "console/clock.h"
#include "console/message.h"
#include "console/option_reader.h"
#include "voxel_limits.h"
#include "voxel_rivals.h"
#include "voxel_scenes.h"
#include "voxelize/layers.h"

enum { ROUNDS_MAX = 101, RESOLUTIONS_MAX = 8 };

enum { EXACT, CONSERVATIVE, FAST, TWO_THREADS, RIVAL_SEIDEL, RIVAL_CELLS, READING, WRITING, TIMED };
static const char *const names[TIMED] = {"exact",          "conservative", "fast",    "exact, 2 threads",
                                         "Schwarz-Seidel", "cell by cell", "reading", "writing"};

typedef struct settings {
    uint64_t seed, rounds;
    uint64_t limit_ms; /* for a pass of a rival */
    const char *kernel;
    bool is_json, has_scenes;
    uint32_t resolution[RESOLUTIONS_MAX];
    size_t resolutions;
    mesh_list meshes;
} settings;

/* A soup and a grid. */
typedef struct task {
    const voxel_scene *scene;
    const settings *s;
    tribox_grid grid;
    size_t words;
    uint64_t *bits;
    float (*sample)[3][3]; /* room for the triangles that a rival is timed on */
    size_t step[TIMED];    /* every step-th triangle is timed */
    voxel_words answer;    /* what `writing` writes */
} task;

/* What was found of it. */
typedef struct finding {
    contestant list[CONTESTANTS_MAX]; /* the first TIMED of them are timed */
    score scores[CONTESTANTS_MAX];
    samples taken;
} finding;

static const char usage[] =
    "Usage: voxels [--resolution N]... [--rounds N] [--kernel NAME] [--seed N] [--limit SECONDS] [--no-scenes] [--quick] [--json] "
    "[MESH...]\n"
    "Times tribox_voxelize against the paper's test for each cell and against Schwarz and Seidel 2010, and prints a table;\n"
    "in it are the limits too: reading the soup alone, and writing the words of the answer alone.\n"
    "  MESH             a mesh file, besides the three soups that are made here; $TRIBOX_MESHES may name a folder to look in\n"
    "  --resolution N   cells along the longest side, 2 to 2048, or several, as in 64,512; without it 256,1024\n"
    "  --rounds N       rounds, 3 to 101; without it 9\n"
    "  --kernel NAME    the kernel to time; without it the widest\n"
    "  --seed N         of the soups and of the order within the rounds\n"
    "  --limit SECONDS  rivals that would take longer for a pass get every n-th triangle; without it 5\n"
    "  --no-scenes      meshes alone\n"
    "  --quick          128 cells, 3 rounds: some seconds\n"
    "  --json           JSON instead of tables\n";

static void clear(const contestant *self, uint64_t *bits)
{
    const task *const t = self->question;
    memset(bits, 0, t->words * sizeof *bits);
}

static bool run_tribox(const contestant *self, uint64_t *bits, tribox_report *report)
{
    const task *const t = self->question;
    return !tribox_voxelize(&t->scene->soup, &t->grid, NULL, &self->options, bits, report);
}

static bool run_threads(const contestant *self, uint64_t *bits, tribox_report *report)
{
    const task *const t = self->question;
    const voxel_task work = voxel_task_of_soup(&t->scene->soup, &t->grid, &self->options);
    return !voxelize_in_threads(&work, 0, t->grid.size[2], 2, bits, report, NULL, NULL);
}

static size_t pick_sample(const task *t, size_t step)
{
    size_t count = 0;
    for (size_t i = 0; i < t->scene->soup.count; i += step)
        memcpy(t->sample[count++], t->scene->triangles[i], sizeof t->sample[0]);
    return count;
}

static bool run_rival(const task *t, voxel_rival *rival, size_t step, uint64_t *bits)
{
    const bool is_sample = step > 1;
    const size_t count = is_sample ? (t->scene->soup.count + step - 1) / step : t->scene->soup.count;
    rival(&t->grid, (const float(*)[3][3])(is_sample ? t->sample : t->scene->triangles), count, bits);
    return true;
}

static bool run_seidel(const contestant *self, uint64_t *bits, tribox_report *report)
{
    const task *const t = self->question;
    (void)report;
    return run_rival(t, voxelize_schwarz_seidel, t->step[RIVAL_SEIDEL], bits);
}

static bool run_cells(const contestant *self, uint64_t *bits, tribox_report *report)
{
    const task *const t = self->question;
    (void)report;
    return run_rival(t, voxelize_cell_by_cell, t->step[RIVAL_CELLS], bits);
}

static bool run_reading(const contestant *self, uint64_t *bits, tribox_report *report)
{
    const task *const t = self->question;
    (void)report;
    bits[0] = loads_all(&t->scene->soup);
    return true;
}

static bool run_writing(const contestant *self, uint64_t *bits, tribox_report *report)
{
    const task *const t = self->question;
    const size_t set = voxel_words_write(&t->answer, bits);
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

/* Those that are timed, then EXACT on every kernel, to be verified. */
static size_t enter(const task *t, contestant *list)
{
    const contestant common = {.prepare = clear,
                               .question = t,
                               .options = {.kernel = t->s->kernel},
                               .promise = PROMISE_EXACT,
                               .pairs = (double)t->scene->soup.count};
    const char *kernel;
    for (int c = 0; c < TIMED; c++)
        list[c] = common;
    list[EXACT].run = list[CONSERVATIVE].run = list[FAST].run = run_tribox;
    list[CONSERVATIVE].options.accuracy = TRIBOX_CONSERVATIVE;
    list[CONSERVATIVE].promise = PROMISE_SUPERSET;
    list[FAST].options.accuracy = TRIBOX_FAST;
    list[FAST].promise = PROMISE_ROUNDED;
    list[TWO_THREADS].run = run_threads;
    list[TWO_THREADS].has_threads = true;
    list[RIVAL_SEIDEL].run = run_seidel;
    list[RIVAL_CELLS].run = run_cells;
    list[READING].run = run_reading;
    list[READING].promise = PROMISE_NOTHING;
    list[WRITING].run = run_writing;
    for (int c = RIVAL_SEIDEL; c <= RIVAL_CELLS; c++) {
        list[c].prepare = clear_and_pick;
        list[c].options.kernel = NULL;
        list[c].promise = PROMISE_NOTHING; /* until it is known to be fast enough */
    }
    for (int c = 0; c < TIMED; c++)
        snprintf(list[c].name, sizeof list[c].name, "%s", names[c]);
    size_t count = TIMED;
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
    return !tribox_voxelize(&t->scene->soup, &t->grid, NULL, &(tribox_options){.axes = axes, .kernel = "scalar"}, bits, NULL);
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
static void choose_step(task *t, contestant *rival, int c)
{
    const double limit = 1e-3 * (double)t->s->limit_ms;
    const size_t all = t->scene->soup.count;
    size_t step = all;
    double seconds = seconds_of(t, rival, c, step);
    while (step > 1 && 4 * seconds < limit) {
        step = step / 4 ? step / 4 : 1;
        seconds = seconds_of(t, rival, c, step);
    }
    rival->pairs = (double)((all + step - 1) / step);
    rival->is_timed_once = seconds > limit / (double)t->s->rounds;
    rival->promise = step == 1 ? PROMISE_ROUNDED : PROMISE_NOTHING;
}

static bool answer(task *t, generator *order, finding *f)
{
    const size_t count = enter(t, f->list);
    const truth from = {find_truth, t, t->words};
    memset(t->bits, 0, t->words * sizeof *t->bits);
    if (!voxel_words_find(&t->scene->soup, &t->grid, &f->list[EXACT].options, t->bits, &t->answer))
        return message_failure("out of memory for the words of the answer; choose a lower resolution") == 0;
    if (!entries_verify(f->list, count, t->scene->name, &from, f->scores))
        return false;
    for (int c = RIVAL_SEIDEL; c <= RIVAL_CELLS; c++)
        choose_step(t, &f->list[c], c);
    if (!entries_verify(&f->list[RIVAL_SEIDEL], 1, t->scene->name, &from, &f->scores[RIVAL_SEIDEL]))
        return false;
    const effort how = {.rounds = (size_t)t->s->rounds, .seconds = 1e9};
    measure(f->list, TIMED, how, order, t->bits, &f->taken);
    return true;
}

/* Other work only ever adds to a time. */
static double least_ns(const finding *f, size_t c) { return measure_spread(&f->taken, c).least; }

static double ns_per_cell(const task *t, const finding *f, size_t c)
{
    return least_ns(f, c) * (double)t->scene->soup.count / (double)f->scores[EXACT].overlapping;
}

static double times_exact(const finding *f, size_t c) { return least_ns(f, c) / least_ns(f, EXACT); }

static void print_table(const task *t, const finding *f)
{
    printf("\n%s, %u x %u x %u cells: %zu triangles, %zu cells set; %.1f MiB of bits\n", t->scene->name, t->grid.size[0],
           t->grid.size[1], t->grid.size[2], t->scene->soup.count, f->scores[EXACT].overlapping, (double)t->words * 8 / 1048576);
    printf("%-18s %14s %12s %16s %10s\n", "", "ns a triangle", "ns a cell", "million tri./s", "x exact");
    for (size_t c = 0; c < TIMED; c++) {
        const double ns = least_ns(f, c);
        printf("%-18s %14.1f %12.2f %16.3f %10.3f", f->list[c].name, ns, ns_per_cell(t, f, c), 1e3 / ns, times_exact(f, c));
        if (t->step[c] > 1)
            printf("   one of %zu triangles", t->step[c]);
        printf("%s\n", f->list[c].is_timed_once ? "   timed once" : "");
    }
    if (t->step[RIVAL_SEIDEL] == 1)
        printf("cells for which Schwarz and Seidel's test, in float and with rounded planes, has another answer: %zu\n",
               score_unlike(&f->scores[RIVAL_SEIDEL]));
}

static void print_json(json *to, const task *t, const finding *f)
{
    json_open_object(to, NULL);
    json_string(to, "scene", t->scene->name);
    json_open_array(to, "size");
    for (int a = 0; a < 3; a++)
        json_whole(to, NULL, t->grid.size[a]);
    json_close(to);
    json_whole(to, "triangles", t->scene->soup.count);
    json_whole(to, "set", f->scores[EXACT].overlapping);
    json_whole(to, "unlike", score_unlike(&f->scores[RIVAL_SEIDEL]));
    json_open_lines(to, "contestants");
    for (size_t c = 0; c < TIMED; c++) {
        json_open_object(to, f->list[c].name);
        json_number(to, "ns_triangle", 6, least_ns(f, c));
        json_number(to, "ns_cell", 6, ns_per_cell(t, f, c));
        json_number(to, "to_exact", 5, times_exact(f, c));
        json_whole(to, "one_of", t->step[c]);
        json_close(to);
    }
    json_close(to);
    json_close(to);
}

/* Products of the ratios over the soups that were read from files, for each resolution. */
typedef struct means {
    double logarithm[RESOLUTIONS_MAX][TIMED];
    size_t count;
} means;

static bool run_grid(const voxel_scene *at, uint32_t resolution, const settings *s, generator *order, json *out, finding *f)
{
    task t = {.scene = at, .s = s, .grid = voxel_scene_grid(at, resolution)};
    for (size_t c = 0; c < TIMED; c++)
        t.step[c] = 1;
    t.words = tribox_window_words(t.grid.size);
    t.bits = malloc(t.words * sizeof *t.bits);
    t.sample = malloc(at->soup.count * sizeof *t.sample);
    const bool is_answered = t.bits && t.sample
                                 ? answer(&t, order, f)
                                 : message_failure("out of memory for %zu words of bits; choose a lower resolution", t.words) == 0;
    if (is_answered && s->is_json)
        print_json(out, &t, f);
    else if (is_answered)
        print_table(&t, f);
    fflush(stdout);
    voxel_words_free(&t.answer);
    free(t.bits);
    free(t.sample);
    return is_answered;
}

static bool run_scene(const voxel_scene *at, const settings *s, generator *order, json *out, means *of_meshes)
{
    static finding f;
    for (size_t r = 0; r < s->resolutions; r++) {
        if (!run_grid(at, s->resolution[r], s, order, out, &f))
            return false;
        for (size_t c = 0; of_meshes && c < TIMED; c++)
            of_meshes->logarithm[r][c] += log(times_exact(&f, c));
    }
    if (of_meshes)
        of_meshes->count++;
    return true;
}

static void print_means(const means *m, const settings *s)
{
    struct rusage here;
    if (m->count) {
        printf("\ngeometric means over %zu meshes, x exact:\n%-18s", m->count, "cells");
        for (size_t r = 0; r < s->resolutions; r++)
            printf(" %8u", s->resolution[r]);
        printf(" %8s\n", "all");
    }
    for (size_t c = CONSERVATIVE; m->count && c < TIMED; c++) {
        double all = 0;
        printf("%-18s", names[c]);
        for (size_t r = 0; r < s->resolutions; r++) {
            printf(" %8.3f", exp(m->logarithm[r][c] / (double)m->count));
            all += m->logarithm[r][c];
        }
        printf(" %8.3f\n", exp(all / (double)(m->count * s->resolutions)));
    }
    if (!getrusage(RUSAGE_SELF, &here))
        printf(
            "peak memory of the process: %.0f MiB, with three copies of a soup, five grids of bits and the words of the answer\n",
            (double)here.ru_maxrss / 1024);
}

enum { OPTION_RESOLUTION, OPTION_ROUNDS, OPTION_KERNEL, OPTION_SEED, OPTION_LIMIT, OPTION_NO_SCENES, OPTION_QUICK, OPTION_JSON };

static const option_entry options[] = {[OPTION_RESOLUTION] = {"resolution", 'r', true},
                                       [OPTION_ROUNDS] = {"rounds", 0, true},
                                       [OPTION_KERNEL] = {"kernel", 'k', true},
                                       [OPTION_SEED] = {"seed", 0, true},
                                       [OPTION_LIMIT] = {"limit", 0, true},
                                       [OPTION_NO_SCENES] = {"no-scenes", 0, false},
                                       [OPTION_QUICK] = {"quick", 'q', false},
                                       [OPTION_JSON] = {"json", 'j', false},
                                       {NULL, 0, false}};

/* Numbers with commas between them. */
static int take_resolutions(settings *s, const char *value)
{
    for (s->resolutions = 0;; value++) {
        const size_t length = strcspn(value, ",");
        char number[16];
        uint64_t resolution;
        snprintf(number, sizeof number, "%.*s", (int)length, value);
        if (whole_read(number, "resolution", 2, 2048, &resolution))
            return EXIT_CODE_USAGE;
        if (s->resolutions == RESOLUTIONS_MAX)
            return message_usage("--resolution: give %d at most", RESOLUTIONS_MAX);
        s->resolution[s->resolutions++] = (uint32_t)resolution;
        value += length;
        if (!*value)
            return EXIT_CODE_OK;
    }
}

static int take_limit(settings *s, const char *value)
{
    uint64_t seconds;
    const int code = whole_read(value, "limit", 1, 3600, &seconds);
    s->limit_ms = code ? s->limit_ms : 1000 * seconds;
    return code;
}

static int take(void *request, int which, const char *value)
{
    settings *const s = request;
    switch (which) {
    case OPTION_RESOLUTION:
        return take_resolutions(s, value);
    case OPTION_ROUNDS:
        return whole_read(value, "rounds", 3, ROUNDS_MAX, &s->rounds);
    case OPTION_KERNEL:
        s->kernel = tribox_kernel_name(&(tribox_options){.kernel = value});
        return s->kernel ? EXIT_CODE_OK : message_usage("--kernel: there is no '%s' here; see tribox info", value);
    case OPTION_SEED:
        return whole_read(value, "seed", 0, UINT64_MAX, &s->seed);
    case OPTION_LIMIT:
        return take_limit(s, value);
    case OPTION_NO_SCENES:
        s->has_scenes = false;
        return EXIT_CODE_OK;
    case OPTION_QUICK:
        s->resolution[0] = 128;
        s->resolutions = 1;
        s->rounds = 3;
        s->limit_ms = 200;
        return EXIT_CODE_OK;
    case OPTION_JSON:
        s->is_json = true;
        return EXIT_CODE_OK;
    default:
        return mesh_list_take(&s->meshes, value);
    }
}

static bool run_all(const settings *s, json *out, means *m)
{
    generator order = {~s->seed};
    bool is_run = true;
    voxel_scene at;
    for (int i = 0; is_run && s->has_scenes && i < VOXEL_SCENES; i++) {
        is_run = voxel_scene_make(i, s->seed, &at);
        if (is_run) {
            is_run = run_scene(&at, s, &order, out, NULL);
            voxel_scene_free(&at);
        }
    }
    for (size_t i = 0; is_run && i < s->meshes.count; i++) {
        is_run = voxel_scene_read(s->meshes.path[i], &at);
        if (is_run) {
            is_run = run_scene(&at, s, &order, out, m);
            voxel_scene_free(&at);
        }
    }
    return is_run;
}

int main(int argc, char **argv)
{
    options_found found;
    settings s = {.seed = 1,
                  .rounds = 9,
                  .limit_ms = 5000,
                  .kernel = tribox_kernel_name(NULL),
                  .has_scenes = true,
                  .resolution = {256, 1024},
                  .resolutions = 2};
    means m = {.count = 0};
    message_set_program("voxels");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    const run r = {argc, argv, s.seed, machine_here()};
    json out = json_to(stdout);
    if (!s.is_json) {
        header_text(stdout, "", &r);
        printf("kernel     %s\n", s.kernel);
        if (!run_all(&s, &out, &m))
            return EXIT_CODE_FAILURE;
        print_means(&m, &s);
        return EXIT_CODE_OK;
    }
    json_open_object(&out, NULL);
    header_json(&out, &r);
    json_string(&out, "kernel", s.kernel);
    json_open_rows(&out, "results");
    if (!run_all(&s, &out, &m))
        return EXIT_CODE_FAILURE;
    json_close(&out);
    json_close(&out);
    return EXIT_CODE_OK;
}
