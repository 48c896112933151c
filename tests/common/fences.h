/* fences.h - outputs between pages that cannot be touched, poisoned before a call; what is written outside them shows. */
#ifndef TRIBOX_TESTS_FENCES_H
#define TRIBOX_TESTS_FENCES_H

#include <stddef.h>

#include "common/guard.h"

enum { POISON = 0xa5 };

/* A place of `bytes` bytes at the end of a fence, or `offset` bytes after its start; the whole fence is poisoned. */
typedef struct fenced {
    guarded fence;
    unsigned char *at;
    size_t bytes;
} fenced;

enum { AT_END = -1 };
fenced fenced_place(guarded fence, size_t bytes, int offset);

/* Fails, with what the test is doing, if a byte beside the place is no longer poisoned. */
void assert_nothing_beside(const fenced *place);

/* The same, and in the place as well. */
void assert_nothing_written(const fenced *place);

#endif
