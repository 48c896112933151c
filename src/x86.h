/* x86.h - which instructions this processor has, of those whose registers the operating system saves. */
#ifndef TRIBOX_X86_H
#define TRIBOX_X86_H

#include <stdbool.h>

#if defined(_MSC_VER)
#include <intrin.h>

enum { TRIBOX_EBX = 1, TRIBOX_ECX, TRIBOX_EDX };

/* Whether CPUID sets all these bits of a register in a leaf. */
static inline bool tribox_x86_has(int leaf, int name, unsigned bits)
{
    int registers[4];
    __cpuidex(registers, 0, 0);
    if (registers[0] < leaf)
        return false;
    __cpuidex(registers, leaf, 0);
    return ((unsigned)registers[name] & bits) == bits;
}

/* clang lets only functions for processors with XSAVE ask; others never get so far. */
#if defined(__clang__)
__attribute__((target("xsave")))
#endif
static inline bool
tribox_x86_saves(unsigned states)
{
    return ((unsigned)_xgetbv(0) & states) == states;
}

static inline bool tribox_x86_runs_sse2(void) { return tribox_x86_has(1, TRIBOX_EDX, 1u << 26); }

/* FMA, POPCNT, OSXSAVE and AVX; BMI1, AVX2 and BMI2. */
static inline bool tribox_x86_runs_avx2(void)
{
    return tribox_x86_has(1, TRIBOX_ECX, 1u << 12 | 1u << 23 | 1u << 27 | 1u << 28) &&
           tribox_x86_has(7, TRIBOX_EBX, 1u << 3 | 1u << 5 | 1u << 8) && tribox_x86_saves(0x6);
}

/* AVX512F, DQ, CD, BW and VL: /arch:AVX512 makes code of all these. */
static inline bool tribox_x86_runs_avx512(void)
{
    return tribox_x86_runs_avx2() && tribox_x86_has(7, TRIBOX_EBX, 1u << 16 | 1u << 17 | 1u << 28 | 1u << 30 | 1u << 31) &&
           tribox_x86_saves(0xe6);
}

#else

static inline bool tribox_x86_runs_sse2(void)
{
    __builtin_cpu_init();
    return __builtin_cpu_supports("sse2");
}

/* The compiler uses these besides wide vectors. Every processor with AVX2 has them, but an emulated one may not. */
static inline bool tribox_x86_has_bit_instructions(void)
{
    return __builtin_cpu_supports("popcnt") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
}

static inline bool tribox_x86_runs_avx2(void)
{
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && tribox_x86_has_bit_instructions();
}

/*
 * Also where processors of Intel lower their clock for vectors of 512 bits, before Rocket Lake and Sapphire Rapids: libdeflate
 * leaves them out there. None of those could be measured. On Sapphire Rapids avx512 is 1.5 times as fast as avx2 in `paper` and 1.4
 * times in voxels, so that it gains while a clock falls by less than a quarter, and calls are long against a change of clocks.
 * Whoever measures otherwise names avx2 in tribox_options.kernel.
 */
static inline bool tribox_x86_runs_avx512(void)
{
    return tribox_x86_runs_avx2() && __builtin_cpu_supports("avx512f");
}

#endif
#endif
