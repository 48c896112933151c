/* progress.c - draws the bar over itself ten times a second at most. */
#define _POSIX_C_SOURCE 200809L
#include "progress.h"

#include <stdatomic.h>
#include <stdio.h>

#include "clock.h"
#include "system.h"

enum { WIDTH = 30, WIDTH_BESIDE_UNIT = 12, LINE = 79 };
static const double first_after = 0.7, again_after = 0.1;

static bool is_silent;

void progress_silence(void) { is_silent = true; }

progress progress_start(const char *what)
{
    return (progress){.what = what, .is_wanted = !is_silent && terminal_is(stderr), .start = clock_seconds()};
}

progress progress_start_of(const char *what, const char *unit, double total)
{
    progress bar = progress_start(what);
    bar.unit = unit;
    bar.total = total;
    return bar;
}

/* 950, 9.5k, 95k, 9.5M */
static void print_count(double count)
{
    static const char units[] = {0, 'k', 'M', 'G', 'T'};
    size_t unit = 0;
    for (; count >= 1000 && unit + 1 < sizeof units; unit++)
        count /= 1000;
    fprintf(stderr, unit && count < 10 ? "%.1f" : "%.0f", count);
    if (unit)
        putc(units[unit], stderr);
}

static void print_done(const progress *bar, double done, double taken)
{
    print_count(done * bar->total);
    fputs(" of ", stderr);
    print_count(bar->total);
    fprintf(stderr, " %s, ", bar->unit);
    print_count(done * bar->total / taken);
    fputs("/s, ", stderr);
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

static void draw(progress *bar, double done)
{
    const double now = clock_seconds(), taken = now - bar->start;
    if (taken < first_after || now - bar->last < again_after)
        return;
    bar->last = now;
    fprintf(stderr, "\r%s [", bar->what);
    const int width = bar->unit ? WIDTH_BESIDE_UNIT : WIDTH;
    for (int i = 0; i < width; i++)
        putc(i < (int)(done * width) ? '#' : '.', stderr);
    fprintf(stderr, "] %3.0f %%  ", 100 * done);
    if (bar->unit)
        print_done(bar, done, taken);
    if (done > 0)
        print_left(taken / done - taken);
    fputs("      ", stderr);
    fflush(stderr);
}

void progress_tell(void *data, double done)
{
    static atomic_flag is_drawn = ATOMIC_FLAG_INIT;
    progress *const bar = data;
    if (!bar->is_wanted || atomic_flag_test_and_set(&is_drawn))
        return;
    draw(bar, done);
    atomic_flag_clear(&is_drawn);
}

void progress_end(progress *bar)
{
    if (bar->last > 0)
        fprintf(stderr, "\r%*s\r", LINE, ""), fflush(stderr);
    bar->last = 0;
}
