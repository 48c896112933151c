/* target.h - a fuzz target: a function that libFuzzer, or replay.c, calls with bytes. It aborts where a promise is broken. */
#ifndef TRIBOX_TESTS_FUZZ_TARGET_H
#define TRIBOX_TESTS_FUZZ_TARGET_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
