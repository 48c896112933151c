/*
 * inexact_flag.h - is the processor's sticky inexact flag down since the watch began? It rises where an operation rounds, but not
 * everywhere: Valgrind leaves it down, and where it is out of reach it counts as down. So whoever takes it for a proof has to see
 * it rise first (settle/doubles.h). The arithmetic to be watched stands between the two calls: it starts from memory, and what
 * it comes to is the argument of the second, so that the compiler cannot move it out. TRIBOX_NO_INEXACT_FLAG puts the flag out of
 * reach, for tests.
 */
#ifndef TRIBOX_INEXACT_FLAG_H
#define TRIBOX_INEXACT_FLAG_H

#include <stdbool.h>
#include <stdint.h>

#include "compiler.h"

#if (defined(__GNUC__) || defined(__clang__)) && defined(__SSE2__) && !defined(TRIBOX_NO_INEXACT_FLAG)

/* Between AVX instructions the old encoding makes the processor save and restore the upper halves of its registers. */
#if defined(__AVX__) || defined(TRIBOX_VECTOR_BYTES)
#define TRIBOX_VEX "v"
#else
#define TRIBOX_VEX ""
#endif

static inline void tribox_exactness_watch(void)
{
    const uint32_t clear = 0x1F80; /* as in environment.h, no flag raised */
    __asm__ volatile(TRIBOX_VEX "ldmxcsr %0" ::"m"(clear) : "memory");
}

static inline bool tribox_exactness_kept(uint64_t result)
{
    uint32_t state;
    __asm__ volatile(TRIBOX_VEX "stmxcsr %0" : "=m"(state) : "r"((uintptr_t)result) : "memory");
    return !(state & 0x20);
}

#elif (defined(__GNUC__) || defined(__clang__)) && defined(__aarch64__) && !defined(TRIBOX_NO_INEXACT_FLAG)

static inline void tribox_exactness_watch(void)
{
    __asm__ volatile("msr fpsr, %0" ::"r"((uint64_t)0) : "memory"); /* no flag raised */
}

static inline bool tribox_exactness_kept(uint64_t result)
{
    uint64_t state;
    __asm__ volatile("mrs %0, fpsr" : "=r"(state) : "r"(result) : "memory");
    return !(state & 0x10);
}

#else

static inline void tribox_exactness_watch(void) {}
static inline bool tribox_exactness_kept(uint64_t result)
{
    (void)result;
    return true;
}

#endif
#endif
