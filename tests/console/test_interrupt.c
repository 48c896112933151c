/* test_interrupt.c - a signal waits while any thread makes a file, whichever thread it comes to. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <semaphore.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "console/interrupt.h"

static char name[64];
static sem_t is_holding;
static pthread_t first;

static void wait_ms(long ms) { nanosleep(&(struct timespec){.tv_nsec = ms * 1000000}, NULL); }

static void make_file(void)
{
    FILE *const file = fopen(name, "w");
    if (file)
        fclose(file);
}

/* The signal comes to the first thread, which sleeps, between the making and the watching of a file by another. */
static void *make(void *unused)
{
    (void)unused;
    interrupt_hold();
    make_file();
    pthread_kill(first, SIGTERM);
    wait_ms(20);
    interrupt_watch(name);
    interrupt_release();
    return NULL;
}

static void be_interrupted(void)
{
    pthread_t other;
    first = pthread_self();
    if (pthread_create(&other, NULL, make, NULL))
        _exit(3);
    for (;;)
        pause();
}

/* Two threads hold: the signal waits for the last. */
static void *hold_a_while(void *unused)
{
    (void)unused;
    interrupt_hold();
    sem_post(&is_holding);
    wait_ms(50);
    make_file();
    interrupt_release();
    return NULL;
}

static void hold_twice(void)
{
    pthread_t other;
    interrupt_hold();
    interrupt_watch(name);
    if (sem_init(&is_holding, 0, 0) || pthread_create(&other, NULL, hold_a_while, NULL))
        _exit(3);
    while (sem_wait(&is_holding))
        ;
    raise(SIGINT);
    interrupt_release();
    pthread_join(other, NULL);
    _exit(4);
}

/* The child is ended by the signal, and its file is gone. */
static void assert_removed(void (*child)(void), int number)
{
    int status;
    snprintf(name, sizeof name, "interrupt-%ld", (long)getpid());
    const pid_t id = fork();
    assert_true(id >= 0);
    if (!id) {
        close(STDERR_FILENO);
        child();
    }
    assert_int_equal(waitpid(id, &status, 0), id);
    assert_true(WIFSIGNALED(status));
    assert_int_equal(WTERMSIG(status), number);
    assert_int_not_equal(access(name, F_OK), 0);
}

static void test_another_thread(void **unused)
{
    (void)unused;
    assert_removed(be_interrupted, SIGTERM);
}

static void test_last_holder(void **unused)
{
    (void)unused;
    assert_removed(hold_twice, SIGINT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_another_thread),
        cmocka_unit_test(test_last_holder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
