/* steps.h - the steps of a work, which the threads of a crew take one after the other, and the wait until all are done. */
#ifndef STEPS_H
#define STEPS_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct steps {
    pthread_mutex_t lock; /* of what follows */
    pthread_cond_t all;
    size_t next, done, count;
} steps;

void steps_start(steps *s, size_t count);
void steps_free(steps *s);

/* The number of a step that nobody has taken yet; false where there is none left. Who takes one says when it is done. */
bool steps_take(steps *s, size_t *step);
void steps_done(steps *s);

/* Returns when all are done: at once where nobody is at work any more, as a crew may be smaller than it was meant to be. */
void steps_wait(steps *s);

#endif
