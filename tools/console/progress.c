/* progress.c - draws the bar over itself ten times a second at most. */
#define _POSIX_C_SOURCE 200809L
#include "progress.h"

#include <stdio.h>
#include <unistd.h>

#include "clock.h"

enum { WIDTH = 30 };
static const double first_after = 0.7, again_after = 0.1;

progress progress_start(const char *what, bool is_wanted)
{
    return (progress){.what = what, .is_wanted = is_wanted && isatty(STDERR_FILENO), .start = clock_seconds()};
}

static void print_left(double seconds)
{
    if (seconds >= 3600)
        fprintf(stderr, "%d h %02d min left", (int)(seconds / 3600), (int)(seconds / 60) % 60);
    else if (seconds >= 60)
        fprintf(stderr, "%d min %02d s left", (int)seconds / 60, (int)seconds % 60);
    else
        fprintf(stderr, "%.0f s left", seconds);
}

void progress_tell(void *data, double done)
{
    progress *bar = data;
    if (!bar->is_wanted)
        return;
    const double now = clock_seconds(), taken = now - bar->start;
    if (taken < first_after || now - bar->last < again_after)
        return;
    bar->last = now;
    fprintf(stderr, "\r%s [", bar->what);
    for (int i = 0; i < WIDTH; i++)
        putc(i < (int)(done * WIDTH) ? '#' : '.', stderr);
    fprintf(stderr, "] %3.0f %%  ", 100 * done);
    if (done > 0)
        print_left(taken / done - taken);
    fputs("      ", stderr);
}

void progress_end(progress *bar)
{
    if (bar->last > 0)
        fprintf(stderr, "\r%*s\r", 79, "");
    bar->last = 0;
}
