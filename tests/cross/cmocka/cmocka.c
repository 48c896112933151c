#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "cmocka.h"

static jmp_buf next_test;
static const char *only;

void cmocka_set_test_filter(const char *name) { only = name; }

static void run_test(const struct CMUnitTest *test, void **state)
{
    puts(test->name);
    fflush(stdout);
    if (setjmp(next_test))
        puts("  skipped");
    else
        test->run(state);
}

int run_tests(const struct CMUnitTest *tests, size_t count, int (*setup)(void **state), int (*teardown)(void **state))
{
    void *state = NULL;
    if (setup && setup(&state))
        return 1;
    for (size_t k = 0; k < count; k++)
        if (!only || !strcmp(only, tests[k].name))
            run_test(&tests[k], &state);
    return teardown ? teardown(&state) : 0;
}

void skip(void) { longjmp(next_test, 1); }

static void print(FILE *out, const char *format, va_list values)
{
    vfprintf(out, format, values);
    fflush(out);
}

void print_message(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    print(stdout, format, values);
    va_end(values);
}

void print_error(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    print(stderr, format, values);
    va_end(values);
}

void fail_at(const char *file, int line, const char *format, ...)
{
    va_list values;
    fprintf(stderr, "%s:%d: ", file, line);
    va_start(values, format);
    print(stderr, format, values);
    va_end(values);
    fputc('\n', stderr);
    exit(1);
}
