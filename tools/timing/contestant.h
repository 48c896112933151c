/* contestant.h - who is timed, and what each promises to answer. */
#ifndef TIMING_CONTESTANT_H
#define TIMING_CONTESTANT_H

#include "work.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum answer_promise {
    PROMISE_NOTHING,  /* writes no mask that could be compared */
    PROMISE_ROUNDED,  /* a mask in which rounding may have changed bits */
    PROMISE_SUPERSET, /* a mask that misses nothing */
    PROMISE_EXACT
} answer_promise;

typedef struct contestant {
    char name[32];
    /* Answers once, into the mask. False if the library refuses. report: NULL while it is timed. */
    bool (*run)(const struct contestant *self, uint64_t *mask, tribox_report *report);
    void (*prepare)(const struct contestant *self, uint64_t *mask); /* before each run, outside the time; NULL for nothing */
    const void *question;                                           /* what run answers: most often a timing_work */
    tribox_options options;                                         /* of a kernel; of the paper's test the order, with no kernel */
    answer_promise promise;
    double pairs;       /* times are divided by this many */
    bool has_threads;   /* its work is done by threads of its own */
    bool is_timed_once; /* in one round alone, because it takes too long */
} contestant;

enum { CONTESTANTS_MAX = 128 };

/* The paper's test, in one of the six orders. */
contestant contestant_paper(const timing_work *work, unsigned order);

/* tribox_overlap. The kernel has to be named; the contestant is called by kernel and accuracy: "avx2-exact". */
contestant contestant_kernel(const timing_work *work, const tribox_options *options);

/* tribox_mesh_overlap of the work's mesh: "avx2-mesh". EXACT. */
contestant contestant_mesh(const timing_work *work, const char *kernel);

/*
 * Enters every kernel that runs here, the widest first, at each accuracy: fast, conservative, exact; and then mesh if the work has
 * one. Returns how many.
 */
size_t contestants_enter(const timing_work *work, contestant *list);

/* The true answer to a timing_work on some axes, by the scalar kernel. */
bool contestant_truth(const void *work, unsigned axes, uint64_t *mask);

#ifdef __cplusplus
}
#endif

#endif
