/* ensure.h - what has to hold, and an end with a message where it does not: a fuzzer keeps the input of a program that aborts. */
#ifndef TRIBOX_TESTS_FUZZ_ENSURE_H
#define TRIBOX_TESTS_FUZZ_ENSURE_H

#include <stdbool.h>

__attribute__((format(printf, 2, 3))) void ensure(bool holds, const char *format, ...);

#endif
