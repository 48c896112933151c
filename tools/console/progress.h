/* progress.h - a bar on the terminal for work that takes more than a moment: what is done, the rate, and the time left. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>

typedef struct progress {
    const char *what; /* "voxelizing" */
    const char *unit; /* "tiles", of which there are `total`; NULL where only the share is known */
    double total;
    bool is_wanted;
    double start, last; /* seconds of the clock: of the start and of the last drawing, 0 for none */
} progress;

/* From now on there are no bars. */
void progress_silence(void);

/* Starts a bar on standard error, which shows nothing unless that is a terminal. */
progress progress_start(const char *what);

/* The same, which also shows how many of what are done, and how many in a second. */
progress progress_start_of(const char *what, const char *unit, double total);

/* Shows the share done, 0 to 1, of a `progress`. Cheap enough to be called a thousand times a second, by any thread. */
void progress_tell(void *bar, double done);

/* Wipes the bar away. */
void progress_end(progress *bar);

#endif
