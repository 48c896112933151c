/*
 * float_environment.h - what a caller may have set of the floating-point environment. On x86 all of MXCSR: rounding, FTZ, DAZ,
 * exceptions unmasked, sticky flags; on ARM rounding, flush-to-zero, default NaN, sticky flags; elsewhere rounding.
 */
#ifndef TRIBOX_TESTS_FLOAT_ENVIRONMENT_H
#define TRIBOX_TESTS_FLOAT_ENVIRONMENT_H

#include <stdint.h>

#if defined(__SSE2__)
#include <xmmintrin.h>

enum { FTZ = 0x8000, DAZ = 0x40, MASKED = 0x1f80, STICKY = 0x3f, ROUNDINGS = 4, INEXACT = 0x20, SETTINGS = ROUNDINGS * 4 * 2 * 3 };

/*
 * Rounding, FTZ and DAZ, and whether exceptions are unmasked and flags are up: none, all, or the one that nearly every program
 * has.
 */
static inline unsigned setting(unsigned k)
{
    static const unsigned flags[] = {0, STICKY, INEXACT};
    return k % ROUNDINGS << 13 | (k / 4 & 1 ? FTZ : 0) | (k / 8 & 1 ? DAZ : 0) | (k / 16 & 1 ? 0 : MASKED) | flags[k / 32];
}
static inline unsigned environment_get(void) { return _mm_getcsr(); }
static inline void environment_set(unsigned mxcsr) { _mm_setcsr(mxcsr); }

#elif defined(__aarch64__) || (defined(__arm__) && defined(__ARM_FP))

enum { FZ = 1 << 24, DEFAULT_NAN = 1 << 25, STICKY = 0x1f, ROUNDINGS = 4, SETTINGS = ROUNDINGS * 2 * 2 * 2 };

/* Rounding, flush-to-zero and default NaN, and whether flags are up. */
static inline unsigned setting(unsigned k)
{
    return k % ROUNDINGS << 22 | (k / 4 & 1 ? FZ : 0) | (k / 8 & 1 ? DEFAULT_NAN : 0) | (k / 16 & 1 ? STICKY : 0);
}

#if defined(__aarch64__)
static inline unsigned environment_get(void)
{
    uint64_t control, status;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control)::"memory");
    __asm__ volatile("mrs %0, fpsr" : "=r"(status)::"memory");
    return (unsigned)(control | (status & STICKY));
}
static inline void environment_set(unsigned set)
{
    __asm__ volatile("msr fpcr, %0" ::"r"((uint64_t)set & ~(uint64_t)STICKY) : "memory");
    __asm__ volatile("msr fpsr, %0" ::"r"((uint64_t)set & STICKY) : "memory");
}
#else
static inline unsigned environment_get(void)
{
    unsigned fpscr;
    __asm__ volatile("vmrs %0, fpscr" : "=r"(fpscr)::"memory");
    return fpscr & (0xfu << 22 | STICKY);
}
static inline void environment_set(unsigned set) { __asm__ volatile("vmsr fpscr, %0" ::"r"(set) : "memory"); }
#endif

#elif defined(__wasm__)
enum { SETTINGS = 1 }; /* there is nothing to set */

static inline unsigned setting(unsigned k) { return k; }
static inline unsigned environment_get(void) { return 0; }
static inline void environment_set(unsigned set) { (void)set; }

#else
#include <fenv.h>

enum { SETTINGS = 4 };

static inline unsigned setting(unsigned k)
{
    static const int rounding[SETTINGS] = {FE_TONEAREST, FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO};
    return (unsigned)rounding[k];
}
static inline unsigned environment_get(void) { return (unsigned)fegetround(); }
static inline void environment_set(unsigned rounding) { fesetround((int)rounding); }
#endif

#endif
