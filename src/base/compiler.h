/* compiler.h - what is asked of compilers: arithmetic as it is written, inlining, prefetching, and names that kernels export. */
#ifndef TRIBOX_COMPILER_H
#define TRIBOX_COMPILER_H

#include <float.h>
#include <stdint.h>

/*
 * Arithmetic as it is written, whatever the flags say: FMA only where a vocabulary says so (PROOFS.md 12). gcc 12 forgets to
 * round in (double)(float)x where it makes vectors of two doubles of a short loop, from -O2 on. By LTO gcc inlines no function into
 * one of other arithmetic. clang minds no pragma under -ffp-contract=fast, and has no macro that tells of it: dispatch.c finds out.
 */
#if defined(__clang__)
#if defined(__x86_64__) || defined(__i386__) /* others warn that they have no such pragma */
#pragma float_control(precise, on)
#endif
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("no-fast-math", "fp-contract=off", "no-tree-slp-vectorize")
#if defined(__s390__) /* which has float in float, but not by -std=c11 */
#pragma GCC optimize("excess-precision=fast")
#define TRIBOX_FLOAT_IN_FLOAT 1
#elif defined(__i386__) && !defined(__SSE2_MATH__)
#define TRIBOX_SSE2_BY_PRAGMA 1 /* not more: gcc 12 compiles immintrin.h only by the flag -msse2 */
#pragma GCC target("sse2,fpmath=sse")
#define TRIBOX_FLOAT_IN_FLOAT 1
#endif
#elif defined(_MSC_VER)
#pragma float_control(precise, on)
#pragma fp_contract(off)
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(__ASSOCIATIVE_MATH__) || \
    defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "tribox cannot be compiled with -ffast-math or parts of it: its answers rest on IEEE arithmetic; add -fno-fast-math"
#endif
_Static_assert(sizeof 1.0 == sizeof(double), "tribox cannot be compiled with -fsingle-precision-constant");
/* 16 is gcc's method for gnu11 on processors with FP16: only types narrower than float are widened. */
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16 && !defined(TRIBOX_FLOAT_IN_FLOAT)
#error "tribox needs float arithmetic in float (FLT_EVAL_METHOD 0 or 16); on 32-bit x86 compile with -msse2 -mfpmath=sse"
#endif

/* Not forced in unoptimised and sanitized builds: with every word inlined and little folded, gcc takes minutes for a kernel. */
#if defined(_MSC_VER) && !defined(__clang__)
#define TRIBOX_INLINE static __forceinline
#elif (defined(__GNUC__) || defined(__clang__)) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define TRIBOX_INLINE static inline __attribute__((always_inline))
#else
#define TRIBOX_INLINE static inline
#endif

/* Work that is rare, or large and called from several places: one copy of it, outside their loops. */
#if defined(_MSC_VER) && !defined(__clang__)
#define TRIBOX_NOINLINE static __declspec(noinline)
#elif defined(__GNUC__) || defined(__clang__)
#define TRIBOX_NOINLINE static __attribute__((noinline))
#else
#define TRIBOX_NOINLINE static
#endif

/* What compilers lay out as the rarer way. */
#if defined(__GNUC__) || defined(__clang__)
#define TRIBOX_UNLIKELY(condition) __builtin_expect(condition, 0)
#else
#define TRIBOX_UNLIKELY(condition) (condition)
#endif

/* Addresses that are read or written soon: they may come into the cache. */
#if defined(__GNUC__) || defined(__clang__)
#define TRIBOX_AHEAD(at, is_write) __builtin_prefetch(at, is_write)
#else
#define TRIBOX_AHEAD(at, is_write) ((void)(at))
#endif
static inline void tribox_will_read(const void *at) { TRIBOX_AHEAD(at, 0); }
static inline void tribox_will_write(const void *at) { TRIBOX_AHEAD(at, 1); }

/* The one external symbol of a kernel's object: tribox_<part>_<KERNEL>, KERNEL being the name that the object is compiled for. */
#define TRIBOX_PASTE_(part, kernel) tribox_##part##_##kernel
#define TRIBOX_PASTE(part, kernel) TRIBOX_PASTE_(part, kernel)
#define TRIBOX_SYMBOL(part) TRIBOX_PASTE(part, KERNEL)

/* A bit for each lane of a packet; a vocabulary defines V_LANES. */
#define LANES_ALL (~UINT64_C(0) >> (64 - V_LANES))

#endif
