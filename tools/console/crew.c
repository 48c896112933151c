/* crew.c - starts threads and waits for them. */
#include "crew.h"

#include <pthread.h>

#include "steps.h"

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

/* What there is to do. */
typedef struct row {
    steps left;
    void (*work)(void *data, size_t n);
    void *data;
} row;

static void work_in_row(void *data, unsigned thread)
{
    row *const r = data;
    (void)thread;
    for (size_t n; steps_take(&r->left, &n);)
        r->work(r->data, n);
}

void crew_each(unsigned threads, size_t count, void (*work)(void *data, size_t n), void *data)
{
    row r = {.work = work, .data = data};
    steps_start(&r.left, count);
    crew_run(threads < count ? threads : (unsigned)count, work_in_row, &r);
    steps_free(&r.left);
}
