/* crew.c - calls threads and waits for them. Between works they are parked, and not started anew (bench/findings.md). */
#include "crew.h"

#include <pthread.h>
#include <stdlib.h>

#include "message.h"

/* A work that threads do together. */
typedef struct crew {
    void (*work)(void *data);
    void *data;
    unsigned at_work; /* others than the caller */
    pthread_cond_t left;
} crew;

/* A thread, which stays till the process ends. */
typedef struct helper {
    crew *does; /* NULL: it is parked */
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
        c->work(c->data);
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
    c->at_work++;
    pthread_cond_signal(&h->called);
    return true;
}

/* Here and on so many other threads as there are, less one; returns when all have returned. */
static void run(unsigned threads, void (*work)(void *data), void *data)
{
    crew c = {.work = work, .data = data};
    pthread_cond_init(&c.left, NULL);
    pthread_mutex_lock(&lock);
    for (unsigned called = 1; called < threads && called < THREADS_MAX && call_helper(&c);)
        called++;
    pthread_mutex_unlock(&lock);
    work(data);
    pthread_mutex_lock(&lock);
    while (c.at_work)
        pthread_cond_wait(&c.left, &lock);
    pthread_mutex_unlock(&lock);
    pthread_cond_destroy(&c.left);
}

/* A step that was begun, by what its number leaves when divided by the places. */
typedef struct begun_step {
    void *place;
    int code;
    bool is_done;
} begun_step;

enum { EACH_MAX = 4, PLACES_MAX = EACH_MAX * THREADS_MAX };

typedef struct steps_crew {
    const crew_work *work;
    void *data;
    pthread_mutex_t finding; /* of what follows; whoever has it may take the other, too */
    size_t next, made, most; /* step; places, and how many there may be */
    void *places[PLACES_MAX];
    pthread_mutex_t state; /* of what follows */
    pthread_cond_t has_changed;
    void *spare[PLACES_MAX]; /* places: the last is taken first, as caches have it */
    size_t spares, turn;     /* turn: the step that is told next */
    begun_step steps[PLACES_MAX];
    bool is_telling, is_over; /* is_over: no step is begun any more */
    int code;
} steps_crew;

static bool is_over(steps_crew *c, bool ends)
{
    pthread_mutex_lock(&c->state);
    const bool is = c->is_over |= ends;
    pthread_cond_broadcast(&c->has_changed);
    pthread_mutex_unlock(&c->state);
    return is;
}

/* A place that is free; NULL where there is none yet, but one may be made, or where the work is over. */
static void *take_spare(steps_crew *c)
{
    pthread_mutex_lock(&c->state);
    while (!c->spares && c->made == c->most && !c->is_over)
        pthread_cond_wait(&c->has_changed, &c->state);
    void *const place = c->spares && !c->is_over ? c->spare[--c->spares] : NULL;
    pthread_mutex_unlock(&c->state);
    return place;
}

static void end_place(const crew_work *w, void *place)
{
    if (w->end)
        w->end(place);
    if (w->place_bytes)
        free(place);
}

static void *make_place(steps_crew *c)
{
    const crew_work *const w = c->work;
    void *place = w->place_bytes ? calloc(1, w->place_bytes) : c->data;
    if (place && w->begin && !w->begin(c->data, place)) {
        end_place(w, place);
        place = NULL;
    }
    if (place)
        c->places[c->made++] = place;
    else
        c->most = c->made;
    return place;
}

static void *take_place(steps_crew *c)
{
    void *place = take_spare(c);
    while (!place && c->made < c->most && !is_over(c, false)) {
        place = make_place(c);
        if (!place)
            place = take_spare(c);
    }
    return place;
}

/* False where none is left. */
static bool begin_step(steps_crew *c, void **place, size_t *n)
{
    pthread_mutex_lock(&c->finding);
    *place = take_place(c);
    *n = c->next;
    const bool is_there = *place && (c->work->find ? c->work->find(c->data, *place, *n) : *n < c->work->count);
    c->next += is_there;
    if (!is_there)
        is_over(c, true);
    pthread_mutex_unlock(&c->finding);
    return is_there;
}

/* Under the lock: nothing is begun any more. */
static void note(steps_crew *c, int code)
{
    c->code = c->code ? c->code : code;
    c->is_over |= code != 0;
}

static int tell(const steps_crew *c, void *place, size_t n, int code)
{
    const crew_work *const w = c->work;
    if (code)
        return w->refuse ? w->refuse(c->data, place, code) : code;
    return w->tell ? w->tell(c->data, place, n) : 0;
}

/* Under the lock, which is left meanwhile: all steps that are done and whose turn it is. */
static void tell_in_order(steps_crew *c)
{
    for (begun_step *s; !c->is_telling && !c->code && (s = &c->steps[c->turn % PLACES_MAX])->is_done;) {
        c->is_telling = true;
        pthread_mutex_unlock(&c->state);
        const int code = tell(c, s->place, c->turn, s->code);
        pthread_mutex_lock(&c->state);
        s->is_done = c->is_telling = false;
        c->turn++;
        c->spare[c->spares++] = s->place;
        note(c, code);
        pthread_cond_broadcast(&c->has_changed);
    }
}

static void end_step(steps_crew *c, void *place, size_t n, int code)
{
    pthread_mutex_lock(&c->state);
    c->is_over |= code != 0;
    if (c->work->is_told_in_order) {
        c->steps[n % PLACES_MAX] = (begun_step){place, code, true};
        tell_in_order(c);
    } else {
        note(c, c->code ? c->code : tell(c, place, n, code));
        c->spare[c->spares++] = place;
        pthread_cond_signal(&c->has_changed);
    }
    pthread_mutex_unlock(&c->state);
}

static void do_steps(void *data)
{
    steps_crew *const c = data;
    void *place;
    for (size_t n; begin_step(c, &place, &n);)
        end_step(c, place, n, c->work->step ? c->work->step(c->data, place, n) : 0);
}

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

int crew_do(const crew_work *work, void *data)
{
    const size_t wanted = work->threads ? work->threads : 1, threads = work->find ? wanted : least(wanted, work->count);
    steps_crew c = {.work = work, .data = data, .most = least(threads * (work->each ? work->each : 1), PLACES_MAX)};
    if (!threads)
        return 0;
    void *const first = make_place(&c); /* or no other thread is of use */
    if (!first)
        return MESSAGE_NO_MEMORY;
    c.spare[c.spares++] = first;
    pthread_mutex_init(&c.finding, NULL);
    pthread_mutex_init(&c.state, NULL);
    pthread_cond_init(&c.has_changed, NULL);
    run((unsigned)threads, do_steps, &c);
    pthread_cond_destroy(&c.has_changed);
    pthread_mutex_destroy(&c.state);
    pthread_mutex_destroy(&c.finding);
    for (size_t n = 0; n < c.made; n++)
        end_place(work, c.places[n]);
    return c.code;
}
