/*
 * timing.h - the one engine that times: work, who does it, whether all answer right, and how long each takes.
 *
 * Contestants take turns in rounds, in a fresh random order each round, so that what disturbs the machine disturbs all of them.
 * Ratios are taken within a round. Times are those of the processor: a long pass that is interrupted costs no more than a short
 * one that is not.
 */
#ifndef TIMING_H
#define TIMING_H

#include <stdbool.h>

#include "paper/random.h"
#include "tribox.h"

/* ---- work: soups, each with a box, tested one after the other. A scene is one such job, the leaves of an octree many --------- */

/* One soup and one box, each twice over: as tribox and as the paper's test want them. */
typedef struct timing_job {
    tribox_soup soup;
    const float (*triangles)[3][3]; /* the same triangles: triangles[i][j][a] is axis a of vertex j */
    tribox_box box;
    float center[3], half[3]; /* of the box, rounded to float */
} timing_job;

typedef struct timing_work {
    timing_job *jobs;
    size_t count;             /* jobs */
    size_t pairs;             /* of a triangle and a box, in all jobs */
    size_t words;             /* of the masks of all jobs, which follow one another */
    void *memory;             /* of the next two */
    float *streams;           /* what the soups point into */
    float (*triangles)[3][3]; /* what the jobs' triangles point into */
    size_t used;              /* of the room */
    tribox_mesh mesh;         /* the one job's triangles with indices; none, but where timing_work_mesh has made it */
    void *positions, *corners;
} timing_work;

/* The room that a soup takes: its streams begin on cache lines. */
size_t timing_work_room(size_t triangles);

/* An empty work with room for `jobs` jobs, and for soups that take `room` together. False if memory fails. */
bool timing_work_make(timing_work *work, size_t jobs, size_t room);

/*
 * The next soup of the work, as a job without a box: `count` triangles that the caller has written to triangles[used ...], here
 * written into the streams as well. There has to be room for them.
 */
timing_job timing_work_soup(timing_work *work, size_t count);

/* The same for the triangles `which` of another soup, or for its first ones if that is NULL. */
timing_job timing_work_copy(timing_work *work, const tribox_soup *soup, const uint32_t *which, size_t count);

/* Adds a job, whose soup the work holds, against a box. There has to be room for it. */
void timing_work_add(timing_work *work, const timing_job *job, const tribox_box *box);

/* Welds the triangles of its one job to a mesh. False if memory fails. */
bool timing_work_mesh(timing_work *work);

/* Leaves the first triangles of each job. */
void timing_work_shorten(timing_work *work, size_t triangles);

void timing_work_free(timing_work *work);

/*
 * An indexed mesh of a soup: vertices that are the same are one, numbered as they come first. positions: room for three a
 * triangle; corners: three numbers a triangle. Returns how many vertices there are; 0 where memory fails.
 */
size_t weld_soup(const tribox_soup *soup, float (*positions)[3], uint32_t (*corners)[3]);

/* ---- who is timed, and what each promises to answer -------------------------------------------------------------------------- */

typedef enum answer_promise {
    PROMISE_NOTHING,  /* writes no mask that could be compared */
    PROMISE_ROUNDED,  /* a mask in which rounding may have changed bits */
    PROMISE_SUPERSET, /* a mask that misses nothing */
    PROMISE_EXACT
} answer_promise;

typedef struct contestant contestant;

/* Answers once, into the mask. False if the library refuses. report: zeros; NULL while it is timed. */
typedef bool contestant_run(const contestant *self, uint64_t *mask, tribox_report *report);

#define CONTESTANT_RUN(name) \
    static bool name(const contestant *self, __attribute__((unused)) uint64_t *mask, __attribute__((unused)) tribox_report *report)

struct contestant {
    char name[32];
    contestant_run *run;
    void (*prepare)(const contestant *self, uint64_t *mask); /* before each run, outside the time; NULL for nothing */
    const void *question;                                    /* what run answers: most often a timing_work */
    int which;                                               /* of several ways that run knows, if it does */
    tribox_options options;                                  /* of a kernel; of the paper's test the order, with no kernel */
    answer_promise promise;
    double pairs;       /* times are divided by this many */
    bool has_threads;   /* its work is done by threads of its own */
    bool is_timed_once; /* in one round alone, because it takes too long */
};

enum { CONTESTANTS_MAX = 192 }; /* sweep enters 6 and 27 a kernel */

/* The paper's test, in one of the six orders. */
contestant contestant_paper(const timing_work *work, unsigned order);

/* tribox_overlap. The kernel has to be named; the contestant is called by kernel and accuracy: "avx2-exact". */
contestant contestant_kernel(const timing_work *work, const tribox_options *options);

/*
 * Enters every kernel that runs here, the widest first, at each accuracy: fast, conservative, exact; and then, if the work has a
 * mesh, tribox_mesh_overlap of it, EXACT: "avx2-mesh". Returns how many.
 */
size_t contestants_enter(const timing_work *work, contestant *list);

/* The index of FAST of the same kernel and axes as list[c]; c if there is none. */
size_t contestant_fast_of(const contestant *list, size_t count, size_t c);

/* ---- verifying: only what answers right is worth timing ---------------------------------------------------------------------- */

/* Answers other than the true ones. */
typedef struct answer_errors {
    size_t missed; /* overlaps that are not reported */
    size_t untrue; /* reports of what does not overlap */
} answer_errors;

/* What a contestant answered. All zero where it promises nothing. */
typedef struct score {
    size_t overlapping;
    size_t undecided;          /* as in tribox_report */
    answer_errors of_accuracy; /* against EXACT on the same axes */
    answer_errors of_all;      /* against EXACT on all axes */
} score;

static inline size_t score_unlike(const score *s) { return s->of_all.missed + s->of_all.untrue; }

typedef struct truth {
    bool (*find)(const void *question, unsigned axes, uint64_t *mask); /* false if it fails */
    const void *question;
    size_t words; /* of a mask */
} truth;

/* The truth about a work, by the scalar kernel. */
truth truth_of_work(const timing_work *work);

enum { VERIFY_TEXT = 128 };

/*
 * Compares everyone's answer with the truth, and keeps everyone to his promise; contestants that differ in the order of the axes
 * alone, and stand beside each other, have to answer alike. Returns whether all do, or else writes into `wrong` who does not.
 */
bool verify(const contestant *list, size_t count, const truth *from, score *scores, char wrong[VERIFY_TEXT]);

/* ---- measuring --------------------------------------------------------------------------------------------------------------- */

/* Of the processor, which other work does not move as it moves those of the clock; of the clock where threads share the work. */
double timing_seconds(bool has_threads);

typedef struct effort {
    size_t rounds;  /* at most; one more is run first and dropped */
    double seconds; /* start no further round after this, but measure MEASURE_LEAST */
    double sample;  /* seconds that a sample lasts at the least: runs are repeated; 0 for one run */
} effort;

enum { MEASURE_LEAST = 5, MEASURE_MOST = 1000 };

/* ns[c][r]: nanoseconds per pair of contestant c in round r. Those of one round were measured within the same moments. */
typedef struct samples {
    size_t contestants, rounds;
    double ns[CONTESTANTS_MAX][MEASURE_MOST];
} samples;

/* words: of the answer of any of them, at the most. False if memory fails. */
bool measure(const contestant *list, size_t count, effort how, generator *order, size_t words, samples *taken);

typedef struct contest {
    size_t count;
    contestant list[CONTESTANTS_MAX];
    score scores[CONTESTANTS_MAX];
    samples taken;
} contest;

/* Verifies and times those in the list about a work. Returns NULL, or what is wrong, in a text that lasts until the next call. */
const char *contest_run(contest *c, const timing_work *work, effort how, generator *order);

typedef struct spread {
    double least, lower_quartile, median, upper_quartile;
} spread;

spread measure_spread(const samples *taken, size_t of);
double measure_least(const samples *taken, size_t of);

/* The ratio of two contestants, taken pair by pair within the rounds: the time of `of` over that of `to`. */
spread measure_ratio(const samples *taken, size_t of, size_t to);

/* In how many rounds `of` was faster than `to`. */
size_t measure_wins(const samples *taken, size_t of, size_t to);

/* How many have a median more than 10 % above their least: a quiet machine repeats a contestant to a few percent. */
size_t measure_disturbed(const samples *taken);

#endif
