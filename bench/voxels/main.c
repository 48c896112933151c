/*
 * main.c - how fast are soups voxelized, beside the paper's test for each cell and beside Schwarz and Seidel (voxel_rivals.h)?
 *
 * First all answer once: EXACT alike on every kernel and on two threads, CONSERVATIVE a superset, or nothing is timed. Then all run in
 * one process, interleaved in rounds; ratios are the medians of the rounds' ratios. The bits are cleared before each pass, outside
 * the time. A rival that takes too long for one pass is timed once, and where even that would take minutes, on every so manyth
 * triangle; the table says so.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "common/command_line.h"
#include "common/header.h"
#include "common/measure.h"
#include "voxel_rivals.h"
#include "voxel_scenes.h"
#include "voxelize/layers.h"

enum { ROUNDS_MOST = 101, RESOLUTIONS_MOST = 8, SCENES_MOST = 64 };

typedef enum contestant_index {
    EXACT,
    CONSERVATIVE,
    FAST,
    TWO_THREADS,
    RIVAL_SEIDEL,
    RIVAL_CELLS,
    CONTESTANT_COUNT
} contestant_index;
static const char *const contestants[CONTESTANT_COUNT] = {"exact",          "conservative", "fast", "exact, 2 threads",
                                                          "Schwarz-Seidel", "cell by cell"};

typedef struct settings {
    uint64_t seed, rounds;
    double limit; /* seconds for a pass of a rival */
    const char *kernel;
    bool is_json, has_scenes;
    uint32_t resolution[RESOLUTIONS_MOST];
    size_t resolutions;
    const char *mesh[SCENES_MOST];
    size_t meshes;
} settings;

/* What was found of one soup and resolution. */
typedef struct finding {
    double seconds[CONTESTANT_COUNT];  /* medians; for a sample of the triangles scaled up; negative if not run */
    double to_exact[CONTESTANT_COUNT]; /* median of the rounds' ratios to EXACT */
    size_t step[CONTESTANT_COUNT];     /* every so manyth triangle was run */
    bool is_once[CONTESTANT_COUNT];    /* in one round alone */
    size_t set, unlike;                /* cells of EXACT, and those that Schwarz and Seidel's test tells otherwise */
} finding;

typedef struct task {
    const voxel_scene *scene;
    const settings *s;
    tribox_grid grid;
    size_t words;
    uint64_t *bits;
    float (*sample)[3][3]; /* room for the triangles that a rival is timed on */
} task;

static const char usage[] =
    "usage: voxels [--resolution N]... [--rounds N] [--kernel NAME] [--seed N] [--limit SECONDS] [--no-scenes] [--quick] [--json] "
    "[MESH...]\n"
    "Times tribox_voxelize against the paper's test for each cell and against Schwarz and Seidel 2010, and prints a table.\n"
    "  MESH             a mesh file, besides the three soups that are made here; $TRIBOX_MESHES may name a folder to look in\n"
    "  --resolution N   cells along the longest side, 2 to 2048; may be repeated; without it 256 and 1024\n"
    "  --rounds N       rounds, 3 to 101; without it 9\n"
    "  --limit SECONDS  rivals that would take longer for a pass get every so manyth triangle; without it 5\n"
    "  --no-scenes      meshes alone\n"
    "  --quick          128 cells, 3 rounds: some seconds\n";

static int fail(const char *what, const char *which, const char *help) { return argument_fail("voxels", what, which, help); }

/* What tribox answers, into the bits. */
static tribox_status answer(const task *t, const tribox_options *options, unsigned threads, tribox_report *report)
{
    if (threads > 1)
        return voxelize_in_threads(&t->scene->soup, &t->grid, 0, t->grid.size[2], options, threads, t->bits, report, NULL, NULL);
    return tribox_voxelize(&t->scene->soup, &t->grid, options, t->bits, report);
}

static void pass(const task *t, contestant_index c, const float (*triangles)[3][3], size_t count)
{
    static const tribox_accuracy accuracies[] = {TRIBOX_EXACT, TRIBOX_CONSERVATIVE, TRIBOX_FAST, TRIBOX_EXACT};
    if (c == RIVAL_SEIDEL)
        voxelize_schwarz_seidel(&t->grid, triangles, count, t->bits);
    else if (c == RIVAL_CELLS)
        voxelize_cell_by_cell(&t->grid, triangles, count, t->bits);
    else
        answer(t, &(tribox_options){.accuracy = accuracies[c], .kernel = t->s->kernel}, c == TWO_THREADS ? 2 : 1, NULL);
}

static void clear(const task *t) { memset(t->bits, 0, t->words * sizeof *t->bits); }

static size_t pick_sample(const task *t, size_t step)
{
    size_t count = 0;
    for (size_t i = 0; i < t->scene->soup.count; i += step)
        memcpy(t->sample[count++], t->scene->triangles[i], sizeof t->sample[0]);
    return count;
}

/* The seconds of a pass over every `step`th triangle, scaled up to all. */
static double seconds_of(const task *t, contestant_index c, size_t step)
{
    const bool is_sample = step > 1;
    const size_t all = t->scene->soup.count, count = is_sample ? pick_sample(t, step) : all;
    clear(t);
    const double begin = measure_now();
    pass(t, c, (const float(*)[3][3])(is_sample ? t->sample : t->scene->triangles), count);
    return (measure_now() - begin) * (double)all / (double)count;
}

/* Every how manyth triangle a rival can do in the time: a coarse sample tells the time of a finer one. */
static size_t step_of(const task *t, contestant_index c)
{
    if (c < RIVAL_SEIDEL)
        return 1;
    size_t step = t->scene->soup.count;
    while (step > 1 && seconds_of(t, c, step) / (double)(step / 2 + 1) < t->s->limit)
        step = step / 4 ? step / 4 : 1;
    return step;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, size_t count)
{
    qsort(values, count, sizeof *values, by_value);
    return values[count / 2];
}

static size_t count_bits(const uint64_t *words, size_t count)
{
    size_t sum = 0;
    for (size_t w = 0; w < count; w++)
        for (uint64_t rest = words[w]; rest; rest &= rest - 1)
            sum++;
    return sum;
}

static bool fail_at(const task *t, const char *what)
{
    fprintf(stderr, "voxels: %s, %u cells along x: %s; nothing is timed\n", t->scene->name, t->grid.size[0], what);
    return false;
}

/* Whether the bits are those of `exact`, or hold them. */
static bool is_right(const task *t, const uint64_t *exact, bool is_superset_enough)
{
    for (size_t w = 0; w < t->words; w++)
        if (is_superset_enough ? exact[w] & ~t->bits[w] : exact[w] ^ t->bits[w])
            return false;
    return true;
}

/* Lets tribox answer on every kernel before anything is timed; exact receives the cells. */
static bool verify(const task *t, uint64_t *exact, finding *f)
{
    static const char *const kernels[] = {"avx512", "avx2", "sse2", "scalar"};
    tribox_report report;
    clear(t);
    const tribox_status status = answer(t, &(tribox_options){.kernel = t->s->kernel}, 1, &report);
    if (status)
        return fail_at(t, tribox_status_text(status));
    f->set = report.overlapping;
    memcpy(exact, t->bits, t->words * sizeof *exact);
    if (count_bits(exact, t->words) != f->set)
        return fail_at(t, "the report counts other cells than are set");
    for (size_t k = 0; k < sizeof kernels / sizeof kernels[0]; k++) {
        const tribox_options options = {.kernel = kernels[k]};
        clear(t);
        if (tribox_kernel_name(&options) && (answer(t, &options, 1, NULL) || !is_right(t, exact, false)))
            return fail_at(t, "the kernels do not agree");
    }
    clear(t);
    if (answer(t, &(tribox_options){.kernel = t->s->kernel}, 2, NULL) || !is_right(t, exact, false))
        return fail_at(t, "two threads answer otherwise than one");
    clear(t);
    if (answer(t, &(tribox_options){.accuracy = TRIBOX_CONSERVATIVE, .kernel = t->s->kernel}, 1, NULL) || !is_right(t, exact, true))
        return fail_at(t, "CONSERVATIVE misses cells");
    return true;
}

static void count_unlike(const task *t, uint64_t *exact, finding *f)
{
    if (f->step[RIVAL_SEIDEL] > 1)
        return;
    clear(t);
    pass(t, RIVAL_SEIDEL, (const float(*)[3][3])t->scene->triangles, t->scene->soup.count);
    for (size_t w = 0; w < t->words; w++)
        exact[w] ^= t->bits[w];
    f->unlike = count_bits(exact, t->words);
}

static void time_rounds(const task *t, generator *order, finding *f)
{
    static double seconds[CONTESTANT_COUNT][ROUNDS_MOST], ratios[ROUNDS_MOST];
    const size_t rounds = (size_t)t->s->rounds;
    for (contestant_index c = EXACT; c < CONTESTANT_COUNT; c++)
        f->step[c] = step_of(t, c);
    for (size_t round = 0; round < rounds + 1; round++) { /* the first warms up, and is written over */
        contestant_index turns[CONTESTANT_COUNT];
        for (contestant_index c = EXACT; c < CONTESTANT_COUNT; c++) {
            const size_t j = random_below(order, c + 1u);
            turns[c] = turns[j];
            turns[j] = c;
        }
        for (int turn = 0; turn < CONTESTANT_COUNT; turn++) {
            const contestant_index c = turns[turn];
            const size_t at = round ? round - 1 : 0;
            f->is_once[c] = c >= RIVAL_SEIDEL && round > 1 && seconds[c][0] / (double)f->step[c] > t->s->limit / (double)rounds;
            seconds[c][at] = f->is_once[c] ? seconds[c][0] : seconds_of(t, c, f->step[c]);
        }
    }
    for (contestant_index c = EXACT; c < CONTESTANT_COUNT; c++) {
        for (size_t round = 0; round < rounds; round++)
            ratios[round] = seconds[c][round] / seconds[EXACT][round];
        f->to_exact[c] = median(ratios, rounds);
    }
    for (contestant_index c = EXACT; c < CONTESTANT_COUNT; c++)
        f->seconds[c] = median(seconds[c], rounds);
}

static void print_table(const task *t, const finding *f)
{
    const double triangles = (double)t->scene->soup.count;
    printf("\n%s, %u x %u x %u cells: %zu triangles, %zu cells set; %.1f MiB of bits\n", t->scene->name, t->grid.size[0],
           t->grid.size[1], t->grid.size[2], t->scene->soup.count, f->set, (double)t->words * 8 / 1048576);
    printf("%-18s %14s %12s %16s %10s\n", "", "ns a triangle", "ns a cell", "million tri./s", "x exact");
    for (contestant_index c = EXACT; c < CONTESTANT_COUNT; c++) {
        printf("%-18s %14.1f %12.2f %16.3f %10.2f", contestants[c], 1e9 * f->seconds[c] / triangles,
               1e9 * f->seconds[c] / (double)f->set, triangles / f->seconds[c] / 1e6, f->to_exact[c]);
        if (f->step[c] > 1)
            printf("   one of %zu triangles", f->step[c]);
        printf("%s\n", f->is_once[c] ? "   timed once" : "");
    }
    if (f->step[RIVAL_SEIDEL] == 1)
        printf("cells that Schwarz and Seidel's test, in float and with planes that are no floats, tells otherwise: %zu\n",
               f->unlike);
}

static void print_json(const task *t, const finding *f, bool is_first)
{
    printf("%s\n  {\"scene\": ", is_first ? "" : ",");
    json_string(stdout, t->scene->name);
    printf(", \"size\": [%u, %u, %u], \"triangles\": %zu, \"set\": %zu, \"unlike\": %zu, \"contestants\": {", t->grid.size[0],
           t->grid.size[1], t->grid.size[2], t->scene->soup.count, f->set, f->unlike);
    const char *separator = "";
    for (contestant_index c = EXACT; c < CONTESTANT_COUNT; c++) {
        printf("%s\"%s\": {\"ns_triangle\": %.3f, \"ns_cell\": %.3f, \"to_exact\": %.4f, \"one_of\": %zu}", separator,
               contestants[c], 1e9 * f->seconds[c] / (double)t->scene->soup.count, 1e9 * f->seconds[c] / (double)f->set,
               f->to_exact[c], f->step[c]);
        separator = ", ";
    }
    printf("}}");
}

/* Products of the ratios over the soups that were read from files, for each resolution. */
typedef struct means {
    double logarithm[RESOLUTIONS_MOST][CONTESTANT_COUNT];
    size_t count;
} means;

static bool run_scene(const voxel_scene *at, const settings *s, generator *order, means *m, bool is_mesh, bool *is_first)
{
    for (size_t r = 0; r < s->resolutions; r++) {
        task t = {.scene = at, .s = s, .grid = voxel_scene_grid(at, s->resolution[r])};
        finding f = {.unlike = 0};
        t.words = tribox_grid_words(&t.grid);
        t.bits = malloc(2 * t.words * sizeof *t.bits);
        t.sample = malloc(at->soup.count * sizeof *t.sample);
        if (!t.bits || !t.sample)
            fprintf(stderr, "voxels: no memory for %zu words of bits; take a lower resolution\n", 2 * t.words);
        const bool is_verified = t.bits && t.sample && verify(&t, t.bits + t.words, &f);
        if (is_verified) {
            time_rounds(&t, order, &f);
            count_unlike(&t, t.bits + t.words, &f);
            if (s->is_json)
                print_json(&t, &f, *is_first);
            else
                print_table(&t, &f);
            fflush(stdout);
        }
        free(t.bits);
        free(t.sample);
        if (!is_verified)
            return false;
        *is_first = false;
        for (contestant_index c = EXACT; is_mesh && c < CONTESTANT_COUNT; c++)
            m->logarithm[r][c] += log(f.to_exact[c]);
    }
    m->count += is_mesh;
    return true;
}

static void print_means(const means *m, const settings *s)
{
    struct rusage usage_here;
    if (m->count) {
        printf("\ngeometric means over %zu meshes, x exact:\n%-18s", m->count, "cells");
        for (size_t r = 0; r < s->resolutions; r++)
            printf(" %8u", s->resolution[r]);
        printf(" %8s\n", "all");
    }
    for (contestant_index c = CONSERVATIVE; m->count && c < CONTESTANT_COUNT; c++) {
        double all = 0;
        printf("%-18s", contestants[c]);
        for (size_t r = 0; r < s->resolutions; r++) {
            printf(" %8.2f", exp(m->logarithm[r][c] / (double)m->count));
            all += m->logarithm[r][c];
        }
        printf(" %8.2f\n", exp(all / (double)(m->count * s->resolutions)));
    }
    if (!getrusage(RUSAGE_SELF, &usage_here))
        printf("most memory of the process: %.0f MiB, three copies of a soup and two grids of bits among it\n",
               (double)usage_here.ru_maxrss / 1024);
}

/* 0, or the exit status. */
static int read_settings(int argc, char **argv, settings *s)
{
    for (int i = 1; i < argc; i++) {
        const char *const option = argv[i];
        uint64_t number;
        if (!strcmp(option, "--json"))
            s->is_json = true;
        else if (!strcmp(option, "--no-scenes"))
            s->has_scenes = false;
        else if (!strcmp(option, "--quick")) {
            s->resolution[0] = 128;
            s->resolutions = 1;
            s->rounds = 3;
            s->limit = 0.2;
        } else if (option[0] != '-') {
            if (s->meshes == SCENES_MOST)
                return fail("too many meshes", option, "run voxels more than once");
            s->mesh[s->meshes++] = option;
        } else if (++i == argc)
            return fail("unknown option, or no value after", option, "see voxels --help");
        else if (!strcmp(option, "--resolution")) {
            if (s->resolutions == RESOLUTIONS_MOST || !argument_number(argv[i], 2, 2048, &number))
                return fail("bad resolution", argv[i], "give 2 to 2048, eight times at most");
            s->resolution[s->resolutions++] = (uint32_t)number;
        } else if (!strcmp(option, "--rounds")) {
            if (!argument_number(argv[i], 3, ROUNDS_MOST, &s->rounds))
                return fail("bad number of rounds", argv[i], "give 3 to 101");
        } else if (!strcmp(option, "--limit")) {
            if (!argument_number(argv[i], 1, 3600, &number))
                return fail("bad number of seconds", argv[i], "give 1 to 3600");
            s->limit = (double)number;
        } else if (!strcmp(option, "--seed")) {
            if (!argument_number(argv[i], 0, UINT64_MAX, &s->seed))
                return fail("bad seed", argv[i], "give a whole number below 2^64");
        } else if (!strcmp(option, "--kernel")) {
            s->kernel = argv[i];
            if (!tribox_kernel_name(&(tribox_options){.kernel = s->kernel}))
                return fail("no kernel here of that name", argv[i], "see tribox info");
        } else
            return fail("unknown option", option, "see voxels --help");
    }
    if (!s->resolutions) {
        s->resolution[0] = 256;
        s->resolution[1] = 1024;
        s->resolutions = 2;
    }
    return 0;
}

static bool read_mesh(const char *name, voxel_scene *made)
{
    const char *const folder = getenv("TRIBOX_MESHES");
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder ? folder : ".", name);
    return voxel_scene_read(strchr(name, '/') || !folder ? name : path, made);
}

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "--help")) {
        fputs(usage, stdout);
        return 0;
    }
    settings s = {.seed = 1, .rounds = 9, .limit = 5, .has_scenes = true};
    const int status = read_settings(argc, argv, &s);
    if (status)
        return status;
    const run r = {argc, argv, s.seed, machine_here()};
    if (s.is_json) {
        printf("{");
        header_json(stdout, &r);
        printf(",\n \"kernel\": \"%s\", \"results\": [", tribox_kernel_name(&(tribox_options){.kernel = s.kernel}));
    } else {
        header_text(stdout, "", &r);
        printf("kernel     %s\n", tribox_kernel_name(&(tribox_options){.kernel = s.kernel}));
    }
    generator order = {~s.seed};
    means m = {.count = 0};
    bool is_first = true, is_done = true;
    for (size_t i = 0; is_done && i < (s.has_scenes ? VOXEL_SCENES : 0) + s.meshes; i++) {
        const size_t mesh = i - (s.has_scenes ? VOXEL_SCENES : 0);
        const bool is_mesh = !s.has_scenes || i >= VOXEL_SCENES;
        voxel_scene at;
        is_done = is_mesh ? read_mesh(s.mesh[mesh], &at) : voxel_scene_make((int)i, s.seed, &at);
        if (is_done) {
            is_done = run_scene(&at, &s, &order, &m, is_mesh, &is_first);
            voxel_scene_free(&at);
        }
    }
    if (s.is_json)
        printf("]}\n");
    else if (is_done)
        print_means(&m, &s);
    return !is_done;
}
