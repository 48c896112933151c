/* crew.h - threads that do one work together. */
#ifndef CREW_H
#define CREW_H

#include <stdbool.h>
#include <stddef.h>

#include "system.h"

/*
 * A work in steps, which threads begin one after the other as they become free. A place is what a step works with and leaves its
 * answer in: as many are made as are at work at once.
 */
typedef struct crew_work {
    size_t count;     /* of the steps, where `find` does not tell */
    unsigned threads; /* at most THREADS_MAX; where the system starts fewer, those do all */
    unsigned each;    /* places for each thread: steps may be done so far before their turn to be told; 0 counts as 1 */
    bool is_told_in_order;
    size_t place_bytes;                     /* zeros, to begin with; 0: steps need no place, and get the data */
    bool (*begin)(void *data, void *place); /* what a place needs besides; false where there is no memory: fewer have to do */
    void (*end)(void *place);               /* gives it back, as far as it was taken; either may be NULL */
    bool (*find)(void *data, void *place, size_t n); /* what step n is about, one thread at a time; false: there is none any more */
    int (*step)(void *data, void *place, size_t n);  /* anything but 0 ends the work. NULL: all is done when it is found */
    int (*tell)(void *data, void *place, size_t n);  /* what step n found, one thread at a time; likewise. NULL: nothing */
    int (*refuse)(void *data, void *place,
                  int code); /* what step returned first, to say why and return what crew_do returns; or NULL */
} crew_work;

/*
 * Returns what ended the work, 0 where all is done, or MESSAGE_NO_MEMORY where there is no place at all. What is told in order does
 * not depend on the number of threads: all steps before the one that failed.
 */
int crew_do(const crew_work *work, void *data);

#endif
