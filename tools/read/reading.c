/* reading.c - one bar, which a thread leaves alone while another draws it. */
#include "mesh_file.h"

#include <pthread.h>
#include <stdio.h>

#include "console/progress.h"
#include "console/system.h"

static bool is_shown;
static progress bar;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of the bar, from begin to end */

void reading_show(bool is_wanted) { is_shown = is_wanted && terminal_is(stderr); }

void reading_begin(void) { bar = progress_start("reading", is_shown); }

void reading_tell(double done)
{
    if (!is_shown || pthread_mutex_trylock(&lock))
        return;
    progress_tell(&bar, done);
    pthread_mutex_unlock(&lock);
}

void reading_end(void) { progress_end(&bar); }
