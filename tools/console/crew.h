/* crew.h - threads that do one work together. */
#ifndef CREW_H
#define CREW_H

#include <stdbool.h>
#include <stddef.h>

#include "system.h"

/*
 * Calls work(data, 0), and work(data, 1) to work(data, threads - 1) on threads of their own, and returns when all have returned.
 * threads: from 1 to THREADS_MAX, other values count as the nearest of these. Where the system starts fewer, those alone are
 * called: a work takes what there is to do from what they share, as long as there is any.
 */
void crew_run(unsigned threads, void (*work)(void *data, unsigned thread), void *data);

/*
 * Calls work(data, thread, n) for each n from 0 to count - 1, rising, as threads become free; after one has returned false no more
 * are begun. Returns whether all returned true.
 */
bool crew_turns(unsigned threads, size_t count, bool (*work)(void *data, unsigned thread, size_t n), void *data);

/*
 * A work in steps, which threads begin one after the other as they become free. A place is what a step works with and leaves its
 * answer in: as many are made as are at work at once.
 */
typedef struct crew_work {
    size_t count;     /* of the steps, where `find` does not tell */
    unsigned threads; /* as above */
    unsigned each;    /* places for each thread: steps may be done so far before their turn to be told; 0 counts as 1 */
    bool is_told_in_order;
    void *(*begin)(void *data); /* a place; NULL where there is no memory: fewer have to do. NULL: steps need none */
    void (*end)(void *place);
    bool (*find)(void *data, void *place, size_t n); /* what step n is about, one thread at a time; false: there is none any more */
    int (*step)(void *data, void *place, size_t n);  /* anything but 0 ends the work */
    int (*tell)(void *data, void *place, size_t n);  /* what step n found, one thread at a time; as above. NULL: nothing */
} crew_work;

/*
 * Returns what ended the work, 0 where all is done, or MESSAGE_NO_MEMORY where there is no place at all. What is told in order does
 * not depend on the number of threads: all steps before the one that failed.
 */
int crew_do(const crew_work *work, void *data);

#endif
