/* turns.c - a counter that the threads share. */
#include "turns.h"

#include <pthread.h>

#include "console/crew.h"

typedef struct turns {
    bool (*work)(void *data, unsigned thread, size_t turn);
    void *data;
    size_t count;
    pthread_mutex_t lock; /* of what follows */
    size_t next;
    bool is_failed;
} turns;

/* Returns t->count after the last. */
static size_t take_turn(turns *t)
{
    pthread_mutex_lock(&t->lock);
    const size_t turn = t->is_failed || t->next == t->count ? t->count : t->next++;
    pthread_mutex_unlock(&t->lock);
    return turn;
}

static void stop_turns(turns *t)
{
    pthread_mutex_lock(&t->lock);
    t->is_failed = true;
    pthread_mutex_unlock(&t->lock);
}

static void take_turns(void *data, unsigned thread)
{
    turns *const t = data;
    for (size_t turn; (turn = take_turn(t)) < t->count;)
        if (!t->work(t->data, thread, turn))
            stop_turns(t);
}

bool turns_run(unsigned threads, size_t count, bool (*work)(void *data, unsigned thread, size_t turn), void *data)
{
    turns t = {.work = work, .data = data, .count = count};
    pthread_mutex_init(&t.lock, NULL);
    crew_run(threads < count ? threads : (unsigned)count, take_turns, &t);
    pthread_mutex_destroy(&t.lock);
    return !t.is_failed;
}
