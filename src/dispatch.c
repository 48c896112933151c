/* dispatch.c - which kernel runs: the widest that this processor and operating system can, or the one that was named. */
#include "dispatch.h"
#include "base/bits.h"
#include "base/environment.h"
#include "base/relaxed.h"
#include "base/targets.h"

extern const tribox_kernel tribox_kernel_scalar, tribox_kernel_sse2, tribox_kernel_avx2, tribox_kernel_avx512, tribox_kernel_neon,
    tribox_kernel_wasm128;

#if TRIBOX_ON_X86
#include "x86.h"
#endif

/*
 * NEON is in every AArch64 processor that runs an operating system. An engine without SIMD takes no module of WebAssembly that has
 * it: whatever runs, runs this.
 */
static bool runs_anywhere(void) { return true; }

static const struct {
    const tribox_kernel *kernel;
    bool (*runs_here)(void);
} table[] = {
#if TRIBOX_AVX512
    {&tribox_kernel_avx512, tribox_x86_runs_avx512},
#endif
#if TRIBOX_AVX2
    {&tribox_kernel_avx2, tribox_x86_runs_avx2},
#endif
#if TRIBOX_SSE2
    {&tribox_kernel_sse2, tribox_x86_runs_sse2},
#endif
#if TRIBOX_NEON
    {&tribox_kernel_neon, runs_anywhere},
#endif
#if TRIBOX_WASM128
    {&tribox_kernel_wasm128, runs_anywhere},
#endif
#if !defined(TRIBOX_SMALL)
    {&tribox_kernel_scalar, runs_anywhere},
#endif
};

size_t tribox_kernel_count(void) { return sizeof table / sizeof table[0]; }

const tribox_kernel *tribox_kernel_at(size_t i) { return table[i].kernel; }

/* Not strcmp, whose calls would take longer than the rest of a small call. */
static bool is_name(const char *name, const char *other)
{
    while (*name && *name == *other) {
        name++;
        other++;
    }
    return *name == *other;
}

enum { LAST = sizeof table / sizeof table[0] - 1 };

/* One that fuses what it should not gives wrong answers; if the last one does, so do all files compiled for its processor. */
static unsigned find_kernels(void)
{
    unsigned here = 0;
    const tribox_environment callers = tribox_environment_enter();
    for (size_t i = 0; i <= LAST; i++)
        here |= (unsigned)(table[i].runs_here() && table[i].kernel->rounds_products()) << i;
    tribox_environment_leave(callers);
    return here >> LAST & 1 ? here : 0;
}

/* Bit i: kernel i of the table runs here, and gives right answers. */
static unsigned kernels_here(void)
{
    /* Two threads may both ask on first use: they learn the same. */
    static tribox_relaxed known;
    enum { IS_KNOWN = 1 << (LAST + 1) };
    unsigned here = tribox_relaxed_read(&known);
    if (!here) {
        here = find_kernels() | IS_KNOWN;
        tribox_relaxed_write(&known, here);
    }
    return here & ~(unsigned)IS_KNOWN;
}

bool tribox_kernel_runs_here(size_t i) { return kernels_here() >> i & 1; }

const char *tribox_kernel_list(size_t i)
{
    for (size_t k = 0; k < tribox_kernel_count(); k++)
        if (tribox_kernel_runs_here(k) && !i--)
            return table[k].kernel->name;
    return NULL;
}

const tribox_kernel *tribox_kernel_any(void)
{
    const unsigned here = kernels_here();
    return table[here ? tribox_lowest_bit(here) : LAST].kernel;
}

const tribox_kernel *tribox_kernel_find(const char *name)
{
    const unsigned here = kernels_here();
    if (!name && here)
        return table[tribox_lowest_bit(here)].kernel;
    for (size_t i = 0; name && i <= LAST; i++)
        if (here >> i & 1 && is_name(name, table[i].kernel->name))
            return table[i].kernel;
    return NULL;
}
