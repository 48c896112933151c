/*
 * environment.h - round to nearest, keep subnormal numbers, raise no trap: entered once per public call. Without it flush-to-zero
 * breaks answers.
 */
#ifndef TRIBOX_ENVIRONMENT_H
#define TRIBOX_ENVIRONMENT_H

#include <stdint.h>

#include "compiler.h"

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>

typedef unsigned tribox_environment;

/* Ours already, whatever flags are up: nearest, no FTZ, no DAZ, all exceptions masked. */
static inline int tribox_environment_is_ours(tribox_environment callers) { return (callers & 0xFFC0) == 0x1F80; }

static inline tribox_environment tribox_environment_enter(void)
{
    const tribox_environment callers = _mm_getcsr();
    if (!tribox_environment_is_ours(callers))
        _mm_setcsr(0x1F80);
    return callers;
}

/* Written unread: to read it once more, for flags that operations have raised, can take ten times as long. */
static inline void tribox_environment_leave(tribox_environment callers) { _mm_setcsr(callers); }

#elif defined(__aarch64__) || defined(_M_ARM64)

typedef struct tribox_environment {
    uint64_t control, status; /* FPCR, and in FPSR the sticky flags */
} tribox_environment;

#if defined(_MSC_VER)
#include <intrin.h>

enum { TRIBOX_FPCR = 0x5a20, TRIBOX_FPSR = 0x5a21 }; /* ARM64_SYSREG(3, 3, 4, 4, 0), and 1 */

static inline tribox_environment tribox_environment_enter(void)
{
    const tribox_environment callers = {(uint64_t)_ReadStatusReg(TRIBOX_FPCR), (uint64_t)_ReadStatusReg(TRIBOX_FPSR)};
    _WriteStatusReg(TRIBOX_FPCR, 0); /* nearest, no FZ, no trap */
    return callers;
}

static inline void tribox_environment_leave(tribox_environment callers)
{
    _WriteStatusReg(TRIBOX_FPSR, (int64_t)callers.status);
    _WriteStatusReg(TRIBOX_FPCR, (int64_t)callers.control);
}

#else

static inline tribox_environment tribox_environment_enter(void)
{
    tribox_environment callers;
    __asm__ volatile("mrs %0, fpcr" : "=r"(callers.control)::"memory");
    __asm__ volatile("mrs %0, fpsr" : "=r"(callers.status)::"memory");
    __asm__ volatile("msr fpcr, %0" ::"r"((uint64_t)0) : "memory"); /* nearest, no FZ, no trap */
    return callers;
}

static inline void tribox_environment_leave(tribox_environment callers)
{
    __asm__ volatile("msr fpsr, %0" ::"r"(callers.status) : "memory");
    __asm__ volatile("msr fpcr, %0" ::"r"(callers.control) : "memory");
}

#endif

#elif defined(__wasm__)

typedef char tribox_environment;

/* WebAssembly always rounds to nearest, keeps subnormal numbers and has no flags. */
static inline tribox_environment tribox_environment_enter(void) { return 0; }
static inline void tribox_environment_leave(tribox_environment callers) { (void)callers; }

#else
#include <fenv.h>

typedef fenv_t tribox_environment;

static inline tribox_environment tribox_environment_enter(void)
{
    tribox_environment callers;
    fegetenv(&callers);
    fesetenv(FE_DFL_ENV);
    return callers;
}

static inline void tribox_environment_leave(tribox_environment callers) { fesetenv(&callers); }

#endif
#endif
