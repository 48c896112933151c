/* contest.h - who is timed, and the proof that all of them answer the same question before any of them is. */
#ifndef BENCH_CONTEST_H
#define BENCH_CONTEST_H

#include "soups.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum contestant_kind {
    CONTESTANT_BASELINE, /* the paper's test, baseline.h */
    CONTESTANT_LOADS,    /* the loads alone, loads.h */
    CONTESTANT_KERNEL,   /* tribox_overlap */
    CONTESTANT_PEER      /* another library */
} contestant_kind;

typedef struct contestant {
    char name[32]; /* "baseline", "loads", or kernel and accuracy: "avx2-exact" */
    contestant_kind kind;
    tribox_options options;                                         /* of a CONTESTANT_KERNEL */
    void (*run)(const void *peer, const scene *at, uint64_t *mask); /* of a CONTESTANT_PEER, like contest_run */
    const void *peer;
} contestant;

enum { CONTESTANTS_MAX = 17 };

/** Everyone who can run on this processor: the baseline, the loads, each kernel in each accuracy. Returns how many. */
size_t contest_enter(contestant list[CONTESTANTS_MAX]);

/** The index of FAST of the same kernel and axes; that of the contestant itself if it is no kernel, or FAST is not in the list. */
size_t contest_fast_of(const contestant *list, size_t count, size_t c);

/**
 * One pass over the scene: what is timed.
 * mask: tribox_mask_words(scene->soup.count) words; the loads only write the first.
 */
void contest_run(const contestant *one, const scene *at, uint64_t *mask);

/** Answers unlike the true ones. */
typedef struct errors {
    size_t missed; /* overlaps that it does not report */
    size_t untrue; /* overlaps that it reports and that are none */
} errors;

/** What a contestant answered. All zero for the loads. */
typedef struct score {
    size_t overlapping;
    size_t undecided;   /* as of tribox_report */
    errors of_accuracy; /* against EXACT on the same axes */
    errors of_all;      /* against EXACT on all axes */
} score;

/**
 * Lets everyone answer once: EXACT has to agree bit for bit with the scalar kernel on the same axes, and CONSERVATIVE to miss
 * nothing. Returns false, with a message on stderr, where that fails.
 */
bool contest_verify(const contestant *list, size_t count, const scene *at, score *scores);

#ifdef __cplusplus
}
#endif

#endif
