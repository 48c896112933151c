/*
 * ensure.h - a fuzz target: a function that libFuzzer, or replay.c, calls with bytes; what has to hold, and an end with a message
 * where it does not, as a fuzzer keeps the input of a program that aborts; and memory of exactly the size that a call is promised,
 * so that a sanitizer sees the first byte beyond it.
 */
#ifndef TRIBOX_TESTS_FUZZ_ENSURE_H
#define TRIBOX_TESTS_FUZZ_ENSURE_H

#include <stdbool.h>

#include "tribox.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

__attribute__((format(printf, 2, 3))) void ensure(bool holds, const char *format, ...);

/* Which options messages name from now on; NULL for none. */
void ensure_about(const tribox_options *options);

/* Claims that a call that found `wrong`, as bits of 1 << status, returned one of these, or OK if there is none. */
void ensure_status(unsigned wrong, tribox_status status);

enum { POISON = 0xa5 };

/* `bytes` bytes, all POISON, `shift` bytes after an aligned place. */
void *tight_memory(size_t bytes, size_t shift);

/* The words of a mask of `bits` bits, poisoned or clear. */
uint64_t *tight_mask(size_t bits);
uint64_t *clear_mask(size_t bits);

/* Claims that a call that refused wrote nothing. */
void ensure_poisoned(const void *block, size_t bytes);

/* Gives all rooms back. */
void tight_memory_free_all(void);

#endif
