/* processors.h - which processor this is, how many threads can run at once, and how many are ever started. */
#ifndef PROCESSORS_H
#define PROCESSORS_H

#include <stddef.h>

enum { THREADS_MAX = 256 };

/* The processors that are online, from 1 to THREADS_MAX. */
unsigned processors_here(void);

/* Their model as the system names it, "unknown" where it does not. */
void processors_name(char *name, size_t size);

#endif
