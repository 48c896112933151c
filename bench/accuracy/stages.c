/* stages.c - the one file of this folder that looks inside the library: it asks dispatch for a kernel and runs its stages alone. */
#include "stages.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exact/exact.h"
#include "plan.h"

/* As in overlap.c, so that the double stage meets the same batches. */
enum { BLOCK_WORDS = 64 };

enum { PAIRS_KEPT = 1024, PAIRS_LEAST = 16 };

/* Percent of the pairs: where fewer go on, the double stage drowns in the noise of the walk. */
static const double least_share = 0.5;

static const double sample_seconds = 1e-3;

/* A kernel and what it is asked, over whole words. */
typedef struct task {
    tribox_plan plan;
    const scene *at;
    size_t scenes, words; /* words of each scene */
} task;

/* Pairs that a stage leaves: all of them counted, some of them kept. */
typedef struct sample {
    size_t seen, count;
    tribox_pair pair[PAIRS_KEPT];
} sample;

/* Each pair that was seen is kept with the same chance. */
static void keep(sample *s, const tribox_pair *pair, generator *g)
{
    const size_t place = s->seen < PAIRS_KEPT ? s->seen : random_below(g, s->seen + 1);
    s->seen++;
    if (place < PAIRS_KEPT)
        s->pair[place] = *pair;
    s->count = s->seen < PAIRS_KEPT ? s->seen : PAIRS_KEPT;
}

static void walk_block(const task *t, const scene *at, size_t word, size_t words, uint64_t *hit, uint64_t *open)
{
    t->plan.kernel->soup[t->plan.accuracy][t->plan.sequence](&at->soup, &at->box, word, 64 * words, hit, open);
}

/* Pairs on their way to the double stage. */
typedef struct gathering {
    tribox_pair pair[TRIBOX_BATCH];
    unsigned count;
} gathering;

/* The other lanes hold the last pair, so that no packet meets what was never written. */
static void make_batch(const tribox_pair *pair, unsigned count, tribox_batch *batch)
{
    for (unsigned i = 0; i < TRIBOX_BATCH; i++) {
        float number[15];
        memcpy(number, &pair[i < count ? i : count - 1], sizeof number);
        for (int k = 0; k < 15; k++)
            batch->number[k][i] = number[k];
    }
}

static uint64_t decide(const task *t, const tribox_batch *batch, unsigned count, uint64_t *open)
{
    return t->plan.kernel->settle(batch, count, t->plan.axes, t->plan.accuracy == TRIBOX_EXACT, open);
}

/* The samples of what a walk leaves, and of what double leaves. */
typedef struct samples_left {
    sample by_float, by_double;
} samples_left;

static void settle(const task *t, gathering *from, sample *left, generator *g)
{
    tribox_batch batch;
    uint64_t open;
    make_batch(from->pair, from->count, &batch);
    decide(t, &batch, from->count, &open);
    for (unsigned i = 0; i < from->count; i++)
        if (open >> i & 1)
            keep(left, &from->pair[i], g);
    from->count = 0;
}

static void count_in_block(const task *t, const scene *at, size_t word, size_t words, samples_left *left, generator *g)
{
    uint64_t hit[BLOCK_WORDS], open[BLOCK_WORDS];
    gathering from = {.count = 0};
    walk_block(t, at, word, words, hit, open);
    for (size_t i = 0; i < 64 * words; i++) {
        if (!(open[i / 64] >> i % 64 & 1) || !tribox_triangle_is_finite(at->triangles[64 * word + i]))
            continue;
        tribox_pair *const pair = &from.pair[from.count++];
        memcpy(pair->u, at->triangles[64 * word + i], sizeof pair->u);
        pair->box = at->box;
        keep(&left->by_float, pair, g);
        if (from.count == TRIBOX_BATCH)
            settle(t, &from, &left->by_double, g);
    }
    if (from.count)
        settle(t, &from, &left->by_double, g);
}

static size_t words_from(const task *t, size_t word) { return t->words - word < BLOCK_WORDS ? t->words - word : BLOCK_WORDS; }

static void count_left(const task *t, stages *found, samples_left *left, generator *g)
{
    for (size_t s = 0; s < t->scenes; s++)
        for (size_t word = 0; word < t->words; word += BLOCK_WORDS)
            count_in_block(t, &t->at[s], word, words_from(t, word), left, g);
    found->left_by_float = left->by_float.seen;
    found->left_by_double = left->by_double.seen;
}

/* What is timed: each runs once through its pairs. The sum keeps the compiler from leaving integers out. */
typedef struct timed {
    const task *t;
    const tribox_options *options;
    const sample *left;
    const tribox_batch *batch;
    size_t batches;
    int width;
    size_t sum;
} timed;

static void run_walk(timed *of)
{
    uint64_t hit[BLOCK_WORDS], open[BLOCK_WORDS];
    for (size_t s = 0; s < of->t->scenes; s++)
        for (size_t word = 0; word < of->t->words; word += BLOCK_WORDS)
            walk_block(of->t, &of->t->at[s], word, words_from(of->t, word), hit, open);
}

static void run_call(timed *of)
{
    for (size_t s = 0; s < of->t->scenes; s++) {
        tribox_soup soup = of->t->at[s].soup;
        tribox_report report;
        soup.count = 64 * of->t->words;
        tribox_overlap(&soup, &of->t->at[s].box, of->options, NULL, &report);
        of->sum += report.overlapping;
    }
}

static void run_double(timed *of)
{
    uint64_t open;
    for (size_t b = 0; b < of->batches; b++)
        of->sum += decide(of->t, &of->batch[b], TRIBOX_BATCH, &open);
}

static void run_integers(timed *of)
{
    for (size_t i = 0; i < of->left->count; i++)
        of->sum += tribox_exact_overlap(&of->left->pair[i], of->t->plan.axes);
}

static bool fits(const tribox_integers *in, int width)
{
#if defined(__SIZEOF_INT128__)
    const int int128_bits = TRIBOX_INT128_BITS;
#else
    const int int128_bits = 0;
#endif
    return in->bits <= (width == WIDTH_INT64 ? TRIBOX_INT64_BITS : width == WIDTH_INT128 ? int128_bits : TRIBOX_LIMBS_BITS);
}

static void run_width(timed *of)
{
    const unsigned axes = of->t->plan.axes;
    for (size_t i = 0; i < of->left->count; i++) {
        const tribox_integers in = tribox_integers_of(&of->left->pair[i]);
        if (of->width == WIDTH_INT64)
            of->sum += tribox_exact_int64(&in, axes);
#if defined(__SIZEOF_INT128__)
        else if (of->width == WIDTH_INT128)
            of->sum += tribox_exact_int128(&in, axes);
#endif
        else
            of->sum += tribox_exact_limbs(&in, axes);
    }
}

typedef void run_timed(timed *of);

/* Seconds for one run, over enough of them to tell. */
static double seconds_for(run_timed *run, timed *of)
{
    size_t runs = 0;
    double passed;
    const double begin = measure_now();
    do {
        run(of);
        runs++;
        passed = measure_now() - begin;
    } while (passed < sample_seconds);
    return passed / (double)runs;
}

/* The least of some rounds: differences of medians would be differences of disturbances. */
static double least_seconds(run_timed *run, timed *of, size_t rounds)
{
    double least = INFINITY;
    for (size_t r = 0; r < rounds; r++)
        least = fmin(least, seconds_for(run, of));
    return least;
}

static void time_integers(const task *t, const sample *left, size_t rounds, stages *found)
{
    timed of = {.t = t, .left = left};
    if (t->plan.accuracy != TRIBOX_EXACT || left->count < PAIRS_LEAST)
        return;
    found->integers = 1e9 * least_seconds(run_integers, &of, rounds) / (double)left->count;

    sample *const fitting = malloc(sizeof *fitting);
    for (int w = 0; fitting && w < WIDTHS; w++) {
        fitting->count = 0;
        for (size_t i = 0; i < left->count; i++) {
            const tribox_integers in = tribox_integers_of(&left->pair[i]);
            if (fits(&in, w))
                fitting->pair[fitting->count++] = left->pair[i];
        }
        timed in_width = {.t = t, .left = fitting, .width = w};
        if (fitting->count >= PAIRS_LEAST)
            found->width[w] = 1e9 * least_seconds(run_width, &in_width, rounds) / (double)fitting->count;
    }
    free(fitting);
}

/* Full batches of the pairs kept. */
static void time_double(const task *t, const sample *left, size_t rounds, stages *found)
{
    static tribox_batch batch[PAIRS_KEPT / TRIBOX_BATCH];
    timed of = {.t = t, .batch = batch, .batches = left->count / TRIBOX_BATCH};
    for (size_t b = 0; b < of.batches; b++)
        make_batch(&left->pair[TRIBOX_BATCH * b], TRIBOX_BATCH, &batch[b]);
    if (of.batches)
        found->in_double = 1e9 * least_seconds(run_double, &of, rounds) / (double)(of.batches * TRIBOX_BATCH);
}

/* Settling is what is left of a call without its walk and its integers. */
static void time_walk_and_settle(const task *t, const tribox_options *options, size_t rounds, stages *found)
{
    timed of = {.t = t, .options = options};
    const double pairs = (double)found->pairs, left = (double)found->left_by_float;
    if (!found->pairs)
        return;
    const double walk = 1e9 * least_seconds(run_walk, &of, rounds);
    found->walk = walk / pairs;
    if (left < least_share / 100 * pairs)
        return;
    const double call = 1e9 * least_seconds(run_call, &of, rounds);
    const double integers = isnan(found->integers) ? 0 : found->integers * (double)found->left_by_double;
    found->settle = (call - walk - integers) / left;
}

bool stages_measure(const tribox_options *options, const scene *at, size_t scenes, size_t rounds, generator *g, stages *found)
{
    task t = {.at = at, .scenes = scenes, .words = at->soup.count / 64};
    samples_left *const left = calloc(1, sizeof *left);
    *found = (stages){
        .pairs = 64 * t.words * scenes, .walk = NAN, .settle = NAN, .in_double = NAN, .integers = NAN, .width = {NAN, NAN, NAN}};
    if (!left || tribox_plan_make(options, &t.plan)) {
        fprintf(stderr, "bench: cannot take kernel %s apart: out of memory, or it does not run here\n", options->kernel);
        free(left);
        return false;
    }
    count_left(&t, found, left, g);
    time_integers(&t, &left->by_double, rounds, found);
    time_double(&t, &left->by_float, rounds, found);
    time_walk_and_settle(&t, options, rounds, found);
    free(left);
    return true;
}
