/*
 * choice.h - which order of the groups is the cheapest for the pairs of a call, learnt while they are answered.
 *
 * Now and then a word is surveyed (kernel/pairs/survey.h): its answers count like any other, and it shows what each group of axes
 * rejects. The order that costs the least on what was seen is taken until the next survey. No order changes an answer.
 */
#ifndef TRIBOX_CHOICE_H
#define TRIBOX_CHOICE_H

#include "kernel.h"

enum { TRIBOX_CHOICE_ORDERS = 4, TRIBOX_CHOICE_LEAST = 4 };

typedef struct tribox_choice {
    unsigned sequence;                   /* taken at present: an index TRIBOX_SEQUENCE_* (kernel.h) */
    unsigned best;                       /* the same order, by its place in `cost`, once there was a survey */
    unsigned surveys;                    /* so far */
    size_t rest;                         /* words until the next survey */
    unsigned cost[TRIBOX_CHOICE_ORDERS]; /* of each order: of all surveys, the last counting most */
    bool is_adaptive;                    /* else the order is fixed */
    tribox_ties ties;                    /* where walks ask about them: as the last survey that did found */
} tribox_choice;

/* The choice before the first survey: the order that most scenes want. Set field by field: gcc's copy of a struct costs 10 ns. */
static inline void tribox_choice_start(tribox_choice *choice)
{
    choice->sequence = TRIBOX_SEQUENCE_132;
    choice->best = 0;
    choice->surveys = 0;
    choice->rest = 0;
    for (int o = 0; o < TRIBOX_CHOICE_ORDERS; o++)
        choice->cost[o] = 0;
    choice->is_adaptive = true;
    choice->ties = TRIBOX_TIES_WHERE_SEVERAL;
}

/* No choice from now on. */
static inline void tribox_choice_fix(tribox_choice *choice, unsigned sequence)
{
    choice->sequence = sequence;
    choice->is_adaptive = false;
}

/*
 * What the packets of a word would have cost in each order, in hundredths of what a packet costs that 132 asks everything. One of
 * them at least is not apart from the box.
 */
void tribox_choice_costs(const tribox_seen *seen, tribox_accuracy accuracy, unsigned cost[TRIBOX_CHOICE_ORDERS]);

/*
 * How many of the next words, at most `most`, are walked in the order of the choice; none if the next word is surveyed. left: whole
 * words left to the call, or to its block: few are not worth a survey.
 */
static inline size_t tribox_choice_next(tribox_choice *choice, size_t left, size_t most)
{
    if (!choice->is_adaptive || left < TRIBOX_CHOICE_LEAST)
        return most;
    const size_t next = choice->rest < most ? choice->rest : most;
    choice->rest -= next;
    return next;
}

/* Takes a survey into account. */
void tribox_choice_learn(tribox_choice *choice, const tribox_seen *seen, tribox_accuracy accuracy);

#endif
