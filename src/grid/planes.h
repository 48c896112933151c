/*
 * planes.h - the planes of a window of a grid: origin + p cell in double, rounded once. Call in the environment of environment.h.
 */
#ifndef TRIBOX_PLANES_H
#define TRIBOX_PLANES_H

#include <stdint.h>
#include <string.h>

#include "base/compiler.h"

#if defined(__FMA__) && !defined(TRIBOX_FMA)
#define TRIBOX_FMA 1
#endif
#if defined(__clang__) && defined(TRIBOX_FMA)
#include <immintrin.h>
#endif

typedef struct tribox_planes {
    double origin[3], cell[3]; /* those of the grid */
    double first[3];           /* the number of the window's first plane among those of the grid */
} tribox_planes;

#if (defined(__GNUC__) || defined(__clang__)) && (defined(TRIBOX_FMA) || defined(__aarch64__))

enum { TRIBOX_HAS_FUSED_PLANES = 1 };
#if defined(__clang__) && defined(TRIBOX_FMA) /* where clang takes fast math back, it calls fma() on some systems (compiler.h) */
static inline double tribox_plane_rounded(double origin, double cell, double p)
{
    return _mm_cvtsd_f64(_mm_fmadd_sd(_mm_set_sd(p), _mm_set_sd(cell), _mm_set_sd(origin)));
}
#else
static inline double tribox_plane_rounded(double origin, double cell, double p) { return __builtin_fma(p, cell, origin); }
#endif

#else

enum { TRIBOX_HAS_FUSED_PLANES = 0 };

/* The sum of two numbers, and what its rounding leaves out. */
typedef struct tribox_sum {
    double sum, rest;
} tribox_sum;

static inline tribox_sum tribox_add_exactly(double a, double b)
{
    const double sum = a + b, of_b = sum - a;
    return (tribox_sum){sum, (a - (sum - of_b)) + (b - of_b)};
}

/* The upper 26 bits of a number's 53. */
static inline double tribox_upper_half(double a)
{
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    bits &= ~UINT64_C(0x7ffffff);
    memcpy(&a, &bits, sizeof a);
    return a;
}

/* A sum that is not exact is rounded to the neighbour whose last bit is 1: rounding it once more then rounds the sum itself. */
static inline double tribox_add_to_odd(double a, double b)
{
    const tribox_sum exact = tribox_add_exactly(a, b);
    double odd = exact.sum;
    uint64_t bits;
    memcpy(&bits, &odd, sizeof bits);
    if ((exact.rest < 0 || exact.rest > 0) && !(bits & 1))
        bits += (exact.rest > 0) == (odd > 0) ? 1 : UINT64_MAX;
    memcpy(&odd, &bits, sizeof odd);
    return odd;
}

/*
 * p cell in two parts by halves of 17 and 16, and of 26 and 27 bits, whose products are doubles; then the sum of three (PROOFS.md
 * 7.10). As p is whole, no part of p cell is below the smallest double.
 */
static inline double tribox_plane_within(double origin, double cell, double p)
{
    const double p_low = (double)((uint64_t)p & 0xffff), p_high = p - p_low;
    const double c_high = tribox_upper_half(cell), c_low = cell - c_high, product = p * cell;
    const double error = ((p_high * c_high - product) + p_high * c_low + p_low * c_high) + p_low * c_low;
    const tribox_sum low = tribox_add_exactly(origin, error), high = tribox_add_exactly(product, low.sum);
    return high.sum + tribox_add_to_odd(high.rest, low.rest);
}

/*
 * p is -1 or more. Where p cell can overflow, all is scaled down. An origin that is much smaller only says to which side a tie is
 * rounded.
 */
static inline double tribox_plane_rounded(double origin, double cell, double p)
{
    if (cell < 0x1p900 || !(p > 0))
        return p > 0 ? tribox_plane_within(origin, cell, p) : p < 0 ? origin - cell : origin + 0.0;
    const double least = 0x1p700, size = origin < 0 ? -origin : origin;
    const double seen = size > least || size <= 0 ? origin : origin < 0 ? -least : least;
    return tribox_plane_within(seen * 0x1p-64, cell * 0x1p-64, p) * 0x1p64;
}

#endif

/* Plane p of the window on axis a; also one outside the grid. */
static inline double tribox_plane_at(const tribox_planes *planes, int a, int64_t p)
{
    return tribox_plane_rounded(planes->origin[a], planes->cell[a], planes->first[a] + (double)p);
}

#endif
