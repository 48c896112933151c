/* harness.h - what every program of tests has: its cases, its arguments, and the kernels that run here. */
#ifndef TRIBOX_TESTS_HARNESS_H
#define TRIBOX_TESTS_HARNESS_H

#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "arguments.h"
#include "guard.h"
#include "kernels_here.h"
#include "random_draws.h"
#include "tribox.h"

/* Of the program, from its start on. */
extern arguments args;
extern const char *names[KERNELS_MAX]; /* of the kernels, the scalar one first */
extern int kernels;

/* A case: what stands in braces after it. Memory that it may not touch ends the program with a message. */
#define CASE(name) \
    static void name##_case(void); \
    static void name(void **state) \
    { \
        (void)state; \
        catch_faults(); /* cmocka has put its own handlers in place */ \
        name##_case(); \
    } \
    static void name##_case(void)
#define RUN(name) cmocka_unit_test(name)

/* The main of a program that runs these cases, after a set-up that returns 0, or else the status of the program. */
#define PROGRAM_AFTER(set_up, ...) \
    int main(int argc, char **argv) \
    { \
        const struct CMUnitTest cases[] = {__VA_ARGS__}; \
        const int status = harness_begin(argc, argv, set_up); \
        if (status || !harness_knows_case(cases, sizeof cases / sizeof cases[0])) \
            return status ? status : 2; \
        return cmocka_run_group_tests(cases, NULL, NULL); \
    }
#define PROGRAM(...) PROGRAM_AFTER(NULL, __VA_ARGS__)

/* Whether the case that the command line names is one of these; with a message if it is not. */
int harness_knows_case(const struct CMUnitTest *cases, size_t count);
int harness_begin(int argc, char **argv, int (*set_up)(void));

#endif
