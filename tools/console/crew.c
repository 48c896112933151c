/* crew.c - starts threads and waits for them. */
#include "crew.h"

#include <pthread.h>

typedef struct helper {
    pthread_t thread;
    void (*work)(void *data, unsigned thread);
    void *data;
    unsigned number;
} helper;

static void *help(void *data)
{
    const helper *const h = data;
    h->work(h->data, h->number);
    return NULL;
}

unsigned crew_run(unsigned threads, void (*work)(void *data, unsigned thread), void *data)
{
    helper helpers[THREADS_MAX];
    unsigned called = 1;
    for (; called < threads && called < THREADS_MAX; called++) {
        helper *const h = &helpers[called];
        *h = (helper){.work = work, .data = data, .number = called};
        if (pthread_create(&h->thread, NULL, help, h))
            break;
    }
    work(data, 0);
    for (unsigned t = 1; t < called; t++)
        pthread_join(helpers[t].thread, NULL);
    return called;
}

/* What there is to do, and how much of it is taken. */
typedef struct row {
    pthread_mutex_t lock; /* of next */
    size_t next, count;
    void (*work)(void *data, size_t n);
    void *data;
} row;

static size_t take(row *r)
{
    pthread_mutex_lock(&r->lock);
    const size_t n = r->next;
    r->next += n < r->count;
    pthread_mutex_unlock(&r->lock);
    return n;
}

static void work_in_row(void *data, unsigned thread)
{
    row *const r = data;
    (void)thread;
    for (size_t n; (n = take(r)) < r->count;)
        r->work(r->data, n);
}

void crew_each(unsigned threads, size_t count, void (*work)(void *data, size_t n), void *data)
{
    row r = {.count = count, .work = work, .data = data};
    pthread_mutex_init(&r.lock, NULL);
    crew_run(threads < count ? threads : (unsigned)count, work_in_row, &r);
    pthread_mutex_destroy(&r.lock);
}
