/*
 * targets.h - the kernels of this processor, as its compiler tells of it, and how their text is compiled: no flag is needed.
 * TRIBOX_WITHOUT_AVX2 and the like leave one out.
 */
#ifndef TRIBOX_TARGETS_H
#define TRIBOX_TARGETS_H

/*
 * The text of kernels is loops over three axes and three edges that have to be unrolled: -O2 alone makes them 1.4 times slower (gcc
 * 12). Not in small, unoptimised and sanitized builds, as in compiler.h, whose inline functions have to come after it.
 */
#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && \
    !defined(__SANITIZE_ADDRESS__)
#pragma GCC optimize("O3")
#endif

#include "compiler.h"

#if defined(__x86_64__) || defined(__i386__) || defined(_M_X64)
#define TRIBOX_ON_X86 1
#elif defined(__aarch64__) && defined(__ARM_NEON) && !defined(__AARCH64EB__)
#define TRIBOX_ON_NEON 1
#elif defined(__wasm_simd128__) /* by -msimd128: an engine without SIMD takes no module that has it anywhere */
#define TRIBOX_ON_WASM 1
#endif

#if TRIBOX_ON_X86 && !defined(TRIBOX_WITHOUT_SSE2)
#define TRIBOX_SSE2 1
#endif
#if TRIBOX_ON_X86 && !defined(TRIBOX_WITHOUT_AVX2) && !defined(TRIBOX_SSE2_BY_PRAGMA)
#define TRIBOX_AVX2 1
#endif
#if TRIBOX_ON_X86 && !defined(TRIBOX_WITHOUT_AVX512) && !defined(TRIBOX_SSE2_BY_PRAGMA)
#define TRIBOX_AVX512 1
#endif
#if TRIBOX_ON_NEON && !defined(TRIBOX_WITHOUT_NEON)
#define TRIBOX_NEON 1
#endif
#if TRIBOX_ON_WASM && !defined(TRIBOX_WITHOUT_WASM128)
#define TRIBOX_WASM128 1
#endif

/*
 * Windows keeps the stack at multiples of 16, to which gcc spills vectors of 32 as if it were one of 32 (its bug 54412). So the
 * assembler moves all vectors as unaligned ones, which is as fast where they are aligned.
 */
#if defined(__MINGW32__) && !defined(__clang__)
__asm__(".ifndef tribox_moves\n\t.set tribox_moves, 1\n" /* once, also in what LTO makes of several files */
        ".macro vmovaps moved:vararg\n\tvmovups \\moved\n.endm\n"
        ".macro vmovapd moved:vararg\n\tvmovupd \\moved\n.endm\n"
        ".macro vmovdqa moved:vararg\n\tvmovdqu \\moved\n.endm\n"
        ".macro vmovdqa32 moved:vararg\n\tvmovdqu32 \\moved\n.endm\n"
        ".macro vmovdqa64 moved:vararg\n\tvmovdqu64 \\moved\n.endm\n.endif\n");
#endif

#endif
