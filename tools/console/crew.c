/* crew.c - calls threads and waits for them. Between works they are parked, and not started anew (bench/files.md). */
#include "crew.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

#include "steps.h"

/* A work that threads do together. */
typedef struct crew {
    void (*work)(void *data, unsigned thread);
    void *data;
    unsigned at_work; /* others than the caller */
    pthread_cond_t left;
} crew;

/* A thread, which stays till the process ends. */
typedef struct helper {
    crew *does; /* NULL: it is parked */
    unsigned number;
    pthread_cond_t called;
    struct helper *next; /* that is parked */
} helper;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of all crews and helpers */
static helper *parked;

static void park(helper *h)
{
    h->does = NULL;
    h->next = parked;
    parked = h;
}

static void *help(void *own)
{
    helper *const h = own;
    pthread_mutex_lock(&lock);
    for (;;) {
        while (!h->does)
            pthread_cond_wait(&h->called, &lock);
        crew *const c = h->does;
        pthread_mutex_unlock(&lock);
        c->work(c->data, h->number);
        pthread_mutex_lock(&lock);
        park(h);
        if (!--c->at_work)
            pthread_cond_signal(&c->left);
    }
    return NULL;
}

/* One more; false where the system has none. */
static bool start_helper(void)
{
    pthread_t thread;
    helper *const h = malloc(sizeof *h);
    if (!h)
        return false;
    pthread_cond_init(&h->called, NULL);
    park(h);
    if (!pthread_create(&thread, NULL, help, h)) {
        pthread_detach(thread);
        return true;
    }
    parked = h->next;
    pthread_cond_destroy(&h->called);
    free(h);
    return false;
}

/* Under the lock. */
static bool call_helper(crew *c)
{
    if (!parked && !start_helper())
        return false;
    helper *const h = parked;
    parked = h->next;
    h->does = c;
    h->number = ++c->at_work;
    pthread_cond_signal(&h->called);
    return true;
}

void crew_run(unsigned threads, void (*work)(void *data, unsigned thread), void *data)
{
    crew c = {.work = work, .data = data};
    pthread_cond_init(&c.left, NULL);
    pthread_mutex_lock(&lock);
    for (unsigned called = 1; called < threads && called < THREADS_MAX && call_helper(&c);)
        called++;
    pthread_mutex_unlock(&lock);
    work(data, 0);
    pthread_mutex_lock(&lock);
    while (c.at_work)
        pthread_cond_wait(&c.left, &lock);
    pthread_mutex_unlock(&lock);
    pthread_cond_destroy(&c.left);
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
