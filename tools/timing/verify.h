/* verify.h - lets everyone answer once before anyone is timed: only what answers right is worth timing. */
#ifndef TIMING_VERIFY_H
#define TIMING_VERIFY_H

#include "contestant.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Answers other than the true ones. */
typedef struct errors {
    size_t missed; /* overlaps that are not reported */
    size_t untrue; /* reports of what does not overlap */
} errors;

/* What a contestant answered. All zero where it promises nothing. */
typedef struct score {
    size_t overlapping;
    size_t undecided;   /* as in tribox_report */
    errors of_accuracy; /* against EXACT on the same axes */
    errors of_all;      /* against EXACT on all axes */
} score;

/* Answers that are not those of EXACT on all axes. */
size_t score_unlike(const score *s);

/* Where the truth comes from. */
typedef struct truth {
    bool (*find)(const void *question, unsigned axes, uint64_t *mask); /* false if it fails */
    const void *question;
    size_t words; /* of a mask */
} truth;

/* The truth about a work. */
truth truth_of_work(const timing_work *work);

enum { VERIFY_TEXT = 128 };

/*
 * Compares everyone's answer with the truth, and keeps everyone to his promise; contestants that differ in the order of the axes
 * alone, and stand beside each other, have to answer alike. Returns whether all do, or else writes into `wrong` who does not.
 */
bool verify(const contestant *list, size_t count, const truth *from, score *scores, char wrong[VERIFY_TEXT]);

#ifdef __cplusplus
}
#endif

#endif
