/*
 * cmocka.h - as much of cmocka's interface as the tests of the kernels use, so that they run where no cmocka is: in cross builds.
 * The first failure ends the program.
 */
#ifndef TRIBOX_TESTS_CMOCKA_H
#define TRIBOX_TESTS_CMOCKA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#if defined(__MINGW_PRINTF_FORMAT) /* mingw-w64's own printf, or that of Windows, which does not know %zu */
#define CMOCKA_PRINTF __MINGW_PRINTF_FORMAT
#else
#define CMOCKA_PRINTF printf
#endif

struct CMUnitTest {
    const char *name;
    void (*run)(void **state);
};

#define cmocka_unit_test(function) \
    { \
#function, function \
    }
#define cmocka_run_group_tests(tests, setup, teardown) run_tests(tests, sizeof(tests) / sizeof *(tests), setup, teardown)

/* Only the test of this name is run from now on, all with NULL: the patterns of cmocka are left out. */
void cmocka_set_test_filter(const char *name);

/* Runs them in turn, between setup and teardown if there are any. Returns 0 if these do. */
int run_tests(const struct CMUnitTest *tests, size_t count, int (*setup)(void **state), int (*teardown)(void **state));

/* Leaves the test at hand. */
_Noreturn void skip(void);

void print_message(const char *format, ...) __attribute__((format(CMOCKA_PRINTF, 1, 2)));
void print_error(const char *format, ...) __attribute__((format(CMOCKA_PRINTF, 1, 2)));
_Noreturn void fail_at(const char *file, int line, const char *format, ...) __attribute__((format(CMOCKA_PRINTF, 3, 4)));

#define fail() fail_at(__FILE__, __LINE__, "failed")
#define fail_msg(...) fail_at(__FILE__, __LINE__, __VA_ARGS__)

static inline void assert_that(bool is_so, const char *file, int line, const char *what)
{
    if (!is_so)
        fail_at(file, line, "this does not hold: %s", what);
}

#define ASSERT(condition, what) assert_that(condition, __FILE__, __LINE__, what)
#define assert_true(a) ASSERT(a, #a)
#define assert_false(a) ASSERT(!(a), "not " #a)
#define assert_null(a) ASSERT(!(a), #a " is NULL")
#define assert_non_null(a) ASSERT(a, #a " is not NULL")
#define assert_int_equal(a, b) ASSERT((uint64_t)(a) == (uint64_t)(b), #a " == " #b)
#define assert_int_not_equal(a, b) ASSERT((uint64_t)(a) != (uint64_t)(b), #a " != " #b)
#define assert_ptr_equal(a, b) ASSERT((a) == (b), #a " == " #b)
#define assert_in_range(a, least, most) \
    ASSERT((uint64_t)(a) >= (uint64_t)(least) && (uint64_t)(a) <= (uint64_t)(most), #a " from " #least " to " #most)
#define assert_string_equal(a, b) ASSERT(!strcmp(a, b), #a " spells as " #b)
#define assert_string_not_equal(a, b) ASSERT(strcmp(a, b), #a " spells otherwise than " #b)
#define assert_memory_equal(a, b, bytes) ASSERT(!memcmp(a, b, bytes), "the bytes of " #a " are those of " #b)
#define assert_memory_not_equal(a, b, bytes) ASSERT(memcmp(a, b, bytes), "the bytes of " #a " are not those of " #b)

#endif
