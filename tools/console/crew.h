/* crew.h - threads that do one work together. */
#ifndef CREW_H
#define CREW_H

#include "processors.h"

/*
 * Calls work(data, 0), and work(data, 1) to work(data, threads - 1) on threads of their own, and returns when all have returned.
 * threads: from 1 to THREADS_MAX, other values count as the nearest of these. Where the system starts fewer, those alone are
 * called: a work takes what there is to do from what they share, as long as there is any.
 */
void crew_run(unsigned threads, void (*work)(void *data, unsigned thread), void *data);

/* Calls work(data, n) for each n from 0 to count - 1, in rising order as threads become free, and returns when all are done. */
void crew_each(unsigned threads, size_t count, void (*work)(void *data, size_t n), void *data);

#endif
