/*
 * small_draws.h - tiny floats of the input as whole numbers, drawn so that they are often equal or next to each other; and what a
 * program that draws them says in the end.
 * After: vec_small.h.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/bits.h"
#include "common/arguments.h"
#include "common/random_draws.h"

/* The numbers of the input have SMALL_BITS bits and lie in so many binades above those that all have the same last bit. */
#if !defined(SMALL_BINADES)
#define SMALL_BINADES 2
#endif

enum { SMALL_HALF = 1 << (SMALL_BITS - 1), SMALL_NUMBERS = (SMALL_BINADES + 1) * SMALL_HALF };

typedef int64_t whole;

static inline whole whole_size(whole a) { return a < 0 ? -a : a; }
static inline whole whole_least(whole a, whole b) { return a < b ? a : b; }
static inline whole whole_most(whole a, whole b) { return a > b ? a : b; }

/* The k-th tiny float that is not negative. */
static inline whole small_number(int k)
{
    return k < 2 * SMALL_HALF ? k : (whole)(SMALL_HALF + k % SMALL_HALF) << (k / SMALL_HALF - 1);
}

static inline whole small_greatest(void) { return small_number(SMALL_NUMBERS - 1); }

/* Its last bit. */
static inline whole small_spacing(whole a)
{
    const int more = (int)tribox_bit_length((uint64_t)whole_size(a)) - SMALL_BITS;
    return (whole)1 << (more > 0 ? more : 0);
}

/* The tiny float next to a number, toward zero. */
static inline whole small_near(whole a)
{
    const whole size = whole_least(whole_size(a), small_greatest());
    const whole cut = size & -small_spacing(size);
    return a < 0 ? -cut : cut;
}

/* One of `count`. Cheaper than random_int, and it is most of the time that a pair takes. */
static inline int small_draw(random_source *r, unsigned count) { return (int)((random_bits(r) >> 32) * count >> 32); }

/* A tiny float or one of its two neighbours. */
static inline whole small_beside(random_source *r, whole a) { return small_near(a + (small_draw(r, 3) - 1) * small_spacing(a)); }

/* Of either sign, one of the first `count` in size. */
static inline whole small_one_of(random_source *r, unsigned count)
{
    const whole size = small_number(small_draw(r, count));
    return small_draw(r, 4) ? size : -size;
}

static inline whole small_any(random_source *r) { return small_one_of(r, SMALL_NUMBERS); }

/* One axis of a triangle and of a box, on which they are not beside each other. */
typedef struct small_axis {
    whole u[3], lo, hi;
} small_axis;

static inline bool small_is_beside(const small_axis *x)
{
    return whole_most(whole_most(x->u[0], x->u[1]), x->u[2]) < x->lo || whole_least(whole_least(x->u[0], x->u[1]), x->u[2]) > x->hi;
}

static inline small_axis small_any_axis(random_source *r)
{
    small_axis x;
    do {
        whole v[5];
        const whole first = small_any(r);
        for (int k = 0; k < 5; k++) {
            if (k && small_draw(r, 2))
                v[k] = small_beside(r, v[small_draw(r, (unsigned)k)]);
            else
                v[k] = small_draw(r, 2) ? small_any(r) : first;
        }
        x = (small_axis){{v[0], v[1], v[2]}, whole_least(v[3], v[4]), whole_most(v[3], v[4])};
    } while (small_is_beside(&x));
    return x;
}

static inline void small_print_axis(char name, const small_axis *x)
{
    printf("  %c: u %" PRId64 " %" PRId64 " %" PRId64 ", box %" PRId64 " to %" PRId64 "\n", name, x->u[0], x->u[1], x->u[2], x->lo,
           x->hi);
}

/* What became of the pairs. */
typedef struct small_tally {
    uint64_t pairs, misses, overlaps; /* the last two certain */
    uint64_t wrong_misses, wrong_overlaps;
    double off; /* the most that a slack was off, of its bound */
} small_tally;

static inline uint64_t small_wrong(const small_tally *of) { return of->wrong_misses + of->wrong_overlaps; }

/* A control ends with the first wrong answer. */
#if defined(SMALL_MUST_FAIL)
enum { SMALL_IS_CONTROL = 1 };
#else
enum { SMALL_IS_CONTROL = 0 };
#endif

static inline bool small_is_over(const small_tally *of) { return SMALL_IS_CONTROL && small_wrong(of); }

/* Prints it. The status of the program: right if no answer was wrong and many were certain, of a control if one was wrong. */
static inline int small_verdict(const small_tally *of)
{
    printf("p %d, %s, K %g%s: %" PRIu64 " pairs, %" PRIu64 " certain misses (%" PRIu64 " wrong), %" PRIu64
           " certain overlaps (%" PRIu64 " wrong)%s\n",
           SMALL_BITS, V_FUSED ? "fused" : "unfused", (double)SMALL_K, SMALL_HAS_LEAST ? ", with a least number" : "", of->pairs,
           of->misses, of->wrong_misses, of->overlaps, of->wrong_overlaps,
           SMALL_IS_CONTROL ? ": a control, which must be wrong" : "");
    if (SMALL_IS_CONTROL)
        return small_wrong(of) == 0;
    const uint64_t many = of->pairs / 2000;
    return small_wrong(of) != 0 || of->off > 1 || of->misses < many || of->overlaps < many;
}
