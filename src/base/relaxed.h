/* relaxed.h - relaxed atomics: a number that threads share is never torn, and says nothing about other memory. */
#ifndef TRIBOX_RELAXED_H
#define TRIBOX_RELAXED_H

#include "compiler.h"

#if defined(__STDC_NO_ATOMICS__)

/* Such compilers read and write a volatile number of a register's width at once. */
typedef volatile unsigned tribox_relaxed;

static inline unsigned tribox_relaxed_read(const tribox_relaxed *number) { return *number; }
static inline void tribox_relaxed_write(tribox_relaxed *number, unsigned to) { *number = to; }

#else
#include <stdatomic.h>

typedef _Atomic unsigned tribox_relaxed;

static inline unsigned tribox_relaxed_read(tribox_relaxed *number) { return atomic_load_explicit(number, memory_order_relaxed); }
static inline void tribox_relaxed_write(tribox_relaxed *number, unsigned to)
{
    atomic_store_explicit(number, to, memory_order_relaxed);
}

#endif
#endif
