/* settings.h - what a caller may have set: on x86 MXCSR, with rounding, FTZ, DAZ, traps and sticky flags; elsewhere rounding. */
#ifndef TRIBOX_TESTS_SETTINGS_H
#define TRIBOX_TESTS_SETTINGS_H

#if defined(__SSE2__)
#include <xmmintrin.h>

enum { FTZ = 0x8000, DAZ = 0x40, MASKED = 0x1f80, STICKY = 0x3f, ROUNDINGS = 4, SETTINGS = ROUNDINGS * 4 * 4 };

static inline unsigned setting(unsigned k)
{
    return k % ROUNDINGS << 13 | (k / 4 & 1 ? FTZ : 0) | (k / 8 & 1 ? DAZ : 0) | (k / 16 & 1 ? 0 : MASKED) |
           (k / 32 & 1 ? STICKY : 0);
}
static inline unsigned environment_get(void) { return _mm_getcsr(); }
static inline void environment_set(unsigned mxcsr) { _mm_setcsr(mxcsr); }

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
