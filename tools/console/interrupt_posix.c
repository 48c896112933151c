/* interrupt_posix.c - removes unfinished files when a signal ends the program. */
#define _POSIX_C_SOURCE 200809L
#include "interrupt.h"

#include <errno.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "message.h"

enum { WATCHED_MOST = 16 };

static const char *volatile watched[WATCHED_MOST];
static char line[512];
static const int ends[] = {SIGINT, SIGTERM, SIGHUP};

/* Any thread may hold signals off, and any other may get them: whoever counts itself first is seen by the other. */
static atomic_int holding, cleaning, waiting; /* waiting: the signal that came meanwhile */

/* Whether a thread holds signals off: then the last that does raises it again. */
static bool is_put_off(int number)
{
    atomic_fetch_add(&cleaning, 1);
    if (!atomic_load(&holding))
        return false;
    atomic_store(&waiting, number);
    if (!atomic_load(&holding) && atomic_exchange(&waiting, 0)) /* the last has gone, and has not seen it */
        return false;
    atomic_fetch_sub(&cleaning, 1);
    return true;
}

static void say(const char *text)
{
    if (write(STDERR_FILENO, text, strlen(text)) < 0)
        return; /* to whom? */
}

/* Nothing but what a handler may call. Signals often come twice, the second perhaps to another thread, which waits for the end. */
static void remove_watched(void)
{
    static atomic_flag is_cleaning = ATOMIC_FLAG_INIT;
    while (atomic_flag_test_and_set(&is_cleaning))
        pause();
    for (int i = WATCHED_MOST; i-- > 0;)
        if (watched[i] && unlink(watched[i]))
            rmdir(watched[i]);
    if (isatty(STDERR_FILENO))
        say("\n");
}

static void clean(int number)
{
    const int reason = errno;
    if (is_put_off(number))
        return;
    remove_watched();
    say(line);
    signal(number, SIG_DFL);
    raise(number);
    errno = reason;
}

/* It cannot be put off: who makes a file now is waited for. */
void interrupt_fail(const char *text)
{
    while (atomic_fetch_add(&cleaning, 1), atomic_load(&holding)) {
        atomic_fetch_sub(&cleaning, 1);
        sched_yield();
    }
    remove_watched();
    say(text);
    _exit(EXIT_CODE_FAILURE);
}

static void start(void)
{
    static bool is_started;
    struct sigaction action, before;
    if (is_started)
        return;
    is_started = true;
    if (!line[0])
        interrupt_advise("nothing was written; run it again");
    memset(&action, 0, sizeof action);
    action.sa_handler = clean;
    action.sa_flags = SA_RESTART; /* of what it interrupts while it is put off */
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        sigaddset(&action.sa_mask, ends[i]);
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        if (!sigaction(ends[i], NULL, &before) && before.sa_handler == SIG_DFL)
            sigaction(ends[i], &action, NULL);
}

/* Returns with the signal raised that came meanwhile. */
static void raise_waiting(void)
{
    const int number = atomic_exchange(&waiting, 0);
    if (number)
        raise(number);
}

void interrupt_hold(void)
{
    start();
    atomic_fetch_add(&holding, 1);
    while (atomic_load(&cleaning)) /* the process is about to end, or the other has seen this thread */
        sched_yield();
}

void interrupt_release(void)
{
    if (atomic_fetch_sub(&holding, 1) == 1)
        raise_waiting();
}

static void replace(const char *path, const char *by)
{
    for (int i = 0; i < WATCHED_MOST; i++)
        if (watched[i] == path) {
            watched[i] = by;
            break;
        }
}

void interrupt_watch(const char *path) { replace(NULL, path); }

void interrupt_forget(const char *path) { replace(path, NULL); }

void interrupt_advise(const char *advice)
{
    message_line(line, sizeof line, "interrupted: ", advice);
    start();
}
