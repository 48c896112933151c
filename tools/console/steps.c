/* steps.c - counts steps under a lock. */
#define _POSIX_C_SOURCE 200809L
#include "steps.h"

void steps_start(steps *s, size_t count)
{
    *s = (steps){.count = count};
    pthread_mutex_init(&s->lock, NULL);
    pthread_cond_init(&s->all, NULL);
}

void steps_free(steps *s)
{
    pthread_cond_destroy(&s->all);
    pthread_mutex_destroy(&s->lock);
}

bool steps_take(steps *s, size_t *step)
{
    pthread_mutex_lock(&s->lock);
    const bool is_left = s->next < s->count;
    *step = s->next;
    s->next += is_left;
    pthread_mutex_unlock(&s->lock);
    return is_left;
}

void steps_done(steps *s)
{
    pthread_mutex_lock(&s->lock);
    if (++s->done == s->count)
        pthread_cond_broadcast(&s->all);
    pthread_mutex_unlock(&s->lock);
}

void steps_wait(steps *s)
{
    pthread_mutex_lock(&s->lock);
    while (s->done < s->count)
        pthread_cond_wait(&s->all, &s->lock);
    pthread_mutex_unlock(&s->lock);
}
