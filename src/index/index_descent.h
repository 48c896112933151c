/*
 * index_descent.h - one query of an index: the descent (index_descent.c) finds which words can have an answer, and which lie
 * wholly in the region; index_answers.c takes the answers in the form that the caller asked for.
 */
#ifndef TRIBOX_INDEX_DESCENT_H
#define TRIBOX_INDEX_DESCENT_H

#include "index_question.h"

typedef enum tribox_form { TRIBOX_COUNT, TRIBOX_MASK, TRIBOX_WORDS, TRIBOX_LIST } tribox_form;

/* Where answers go. */
typedef struct tribox_answers {
    tribox_form form;
    uint64_t *mask;      /* of MASK: all zero before the first answer */
    uint32_t *number;    /* of WORDS, */
    uint64_t *bits;      /* likewise, */
    uint64_t *inside;    /* and likewise, or NULL */
    const uint32_t *ids; /* of LIST, or NULL */
    uint32_t *list;      /* of LIST */
    size_t room;         /* for words, or for numbers of the list */
    size_t found;        /* how many there are */
    size_t overlapping;  /* triangles */
} tribox_answers;

/* Words wait until so many have come together, from wherever they lie: ties of all are settled at once. */
enum { TRIBOX_PENDING = TRIBOX_BLOCK_WORDS };

typedef struct tribox_descent {
    const char *nodes;
    tribox_levels levels;
    tribox_question *about;
    tribox_answers *to;
    unsigned pending;
    size_t word[TRIBOX_PENDING]; /* in ascending order */
    size_t full[TRIBOX_PENDING]; /* so many words from that one on lie wholly inside; 0: one word that has to be asked */
} tribox_descent;

/* Takes the answer about one word. */
void tribox_answers_take_word(const tribox_descent *q, size_t word, uint64_t hit);

/* Takes words whose triangles all lie in the region. */
void tribox_answers_take_full(const tribox_descent *q, size_t word, size_t words);

/* Finds all answers, in ascending order where that matters. The region is finite and not empty. */
void tribox_descent_run(tribox_descent *q);

/* Finds some triangle; false if there is none. */
bool tribox_descent_any(tribox_descent *q, size_t *triangle);

#endif
