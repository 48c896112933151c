/* processors.h - how many threads can run at once, and how many are ever started. */
#ifndef PROCESSORS_H
#define PROCESSORS_H

enum { THREADS_MAX = 256 };

/* The processors that are online, from 1 to THREADS_MAX. */
unsigned processors_here(void);

#endif
