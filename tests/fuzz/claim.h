/* claim.h - what has to hold, and an end with a message where it does not: a fuzzer keeps the input of a program that aborts. */
#ifndef TRIBOX_TESTS_FUZZ_CLAIM_H
#define TRIBOX_TESTS_FUZZ_CLAIM_H

#include <stdbool.h>

__attribute__((format(printf, 2, 3))) void claim(bool holds, const char *format, ...);

#endif
