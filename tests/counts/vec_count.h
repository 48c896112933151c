/*
 * vec_count.h - a vocabulary whose numbers count their roundings: the kernels' texts compile with it as with any instruction set's.
 *
 * A number is   x + sum over k of c_k d_k + rest,   |d_k| <= u for each rounding so far,   |rest| <= u^2 `rest`
 * with x the exact number, at one point of input space, and c_k what rounding k does to it. One rounding that meets a slack along
 * two ways is counted once, with the signs that it has. Underflow, in units of half the least number, is kept by the axes that it
 * still has to meet: under[m]. A quotient is its numerator, and `over` the number that it is divided by, as that was computed.
 *
 * Numbers are linear in those of the input on each axis that they are of, and of nothing else. What makes counts at a few points a
 * proof for all inputs (PROOFS.md 3.8) is checked as a text runs; one that leaves this scheme is refused, with its file and line.
 */
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernel.h"

#define V_LANES 1
#if !defined(V_FUSED)
#define V_FUSED 0
#endif
#if !defined(COUNT_BITS)
#define COUNT_BITS 24
#endif
#define V_UNIT (1.0 / (double)(UINT64_C(1) << COUNT_BITS))
#define V_ETA 0x1p-1000 /* nothing against any number, but adding it rounds */

enum { COUNT_NUMBERS = 2000, COUNT_ROUNDINGS = 256, COUNT_COMPARISONS = 400, COUNT_NONE = -1 };
typedef struct vnum {
    int at;
} vnum;
typedef bool vmask;

typedef struct counted {
    unsigned axes;   /* linear in the numbers of each of these axes; none of a constant */
    bool is_place;   /* a number of the input of which only differences from others mean anything */
    bool keeps_sign; /* off by a factor next to 1 */
    int turned;      /* 0, or the sign that the computed number is said to have: -1 or 1 */
    int over;        /* the number that it is divided by, or COUNT_NONE */
    int order;       /* at most so many roundings meet in one term */
    int width;       /* c_k of later roundings are 0 */
    double x, rest, under[8], c[COUNT_ROUNDINGS];
} counted;

typedef struct count_place {
    const char *file;
    int line;
} count_place;

static counted count_number[COUNT_NUMBERS];
static count_place count_rounding[COUNT_ROUNDINGS]; /* where each was made */
static int count_numbers, count_roundings, count_signs;
static unsigned count_script; /* bit k: the k-th sign that nothing tells is negative */
static int count_signs_tried; /* how many signs the scripts try */
static count_place count_here;
static vnum count_unit[3]; /* where constants are lengths on an axis, their unit; COUNT_NONE elsewhere */

static vnum count_least_divisor; /* what the last choice between a number and a quotient left */

/* What comparisons on one axis compared, in order: on each chamber of its numbers all must have one sign. */
static double count_compared[COUNT_COMPARISONS];
static int count_comparisons;
static inline void count_compare(double difference)
{
    if (count_comparisons < COUNT_COMPARISONS)
        count_compared[count_comparisons++] = difference;
}

static inline void count_refuse(const char *what)
{
    fprintf(stderr, "%s:%d: the text leaves what can be counted: not %s\n", count_here.file, count_here.line, what);
    exit(1);
}
#define COUNT_MUST(what) ((what) ? (void)0 : count_refuse(#what))
#define COUNT_ROOM 1.000001 /* the roundings of the count itself */

static inline void count_start(unsigned script)
{
    count_numbers = count_roundings = count_signs = count_comparisons = 0;
    count_script = script;
    count_unit[0] = count_unit[1] = count_unit[2] = count_least_divisor = (vnum){COUNT_NONE};
}

/* All that was counted since is dropped, and another script begins. */
typedef struct count_mark {
    int numbers, roundings;
} count_mark;
static inline count_mark count_now(void) { return (count_mark){count_numbers, count_roundings}; }
static inline void count_back_to(count_mark mark, unsigned script)
{
    count_numbers = mark.numbers;
    count_roundings = mark.roundings;
    count_signs = 0;
    count_script = script;
    count_least_divisor = (vnum){COUNT_NONE};
}

static inline counted *count_of(vnum a) { return &count_number[a.at]; }

static inline vnum count_new(unsigned axes)
{
    COUNT_MUST(count_numbers < COUNT_NUMBERS);
    counted *const to = &count_number[count_numbers];
    memset(to, 0, offsetof(counted, c));
    to->axes = axes;
    to->over = COUNT_NONE;
    return (vnum){count_numbers++};
}

static inline vnum count_constant(double x)
{
    const vnum a = count_new(0);
    count_of(a)->x = x;
    count_of(a)->keeps_sign = true;
    return a;
}

/* A number of the input: a place, or a difference that is known exactly. */
static inline vnum count_input(int axis, double x, bool is_place)
{
    const vnum a = count_new(1u << axis);
    count_of(a)->x = x;
    count_of(a)->is_place = is_place;
    count_of(a)->keeps_sign = !is_place;
    return a;
}

/* The sum of |c_k|: the error to first order, in u. Four sums at a time, as it is what takes the time. */
static inline double count_first(const counted *a)
{
    double sum[4] = {0, 0, 0, 0};
    int k = 0;
    for (; k + 4 <= a->width; k += 4)
        for (int n = 0; n < 4; n++)
            sum[n] += fabs(a->c[k + n]);
    for (; k < a->width; k++)
        sum[0] += fabs(a->c[k]);
    return sum[0] + sum[1] + (sum[2] + sum[3]);
}

/* All of the error but underflow. */
static inline double count_error(const counted *a) { return V_UNIT * (count_first(a) + V_UNIT * a->rest) * COUNT_ROOM; }

static inline bool count_is_exact(const counted *a) { return a->width == 0 && !(a->rest > 0); }
static inline bool count_is_constant(const counted *a) { return a->axes == 0 && a->over == COUNT_NONE && count_is_exact(a); }
static inline bool count_is_zero(const counted *a) { return count_is_constant(a) && !(fabs(a->x) > 0); }
static inline bool count_is_nothing(const counted *a) { return count_is_constant(a) && fabs(a->x) <= V_ETA; }

static inline bool count_is_power(const counted *a)
{
    int exponent;
    return count_is_constant(a) && !(fabs(frexp(a->x, &exponent)) > 0.5);
}

/* `under`: whether an underflow is possible, half the least number. */
static inline vnum count_rounded(vnum a, double under)
{
    counted *const r = count_of(a);
    COUNT_MUST(count_roundings < COUNT_ROUNDINGS);
    r->rest = r->rest * (1 + 2 * V_UNIT) * COUNT_ROOM + count_first(r);
    memset(r->c + r->width, 0, sizeof *r->c * (size_t)(count_roundings - r->width));
    count_rounding[count_roundings] = count_here;
    r->c[count_roundings++] = r->x;
    r->width = count_roundings;
    r->order++;
    r->under[0] += under;
    return a;
}

/* Not rounded. */
static inline vnum count_product(vnum a, vnum b)
{
    const counted *const p = count_of(a), *const q = count_of(b);
    COUNT_MUST(!(p->axes & q->axes) && !p->is_place && !q->is_place && (p->over == COUNT_NONE || q->over == COUNT_NONE));
    const vnum to = count_new(p->axes | q->axes);
    counted *const r = count_of(to);
    const double d = count_first(p), e = count_first(q);
    r->x = p->x * q->x;
    r->over = p->over == COUNT_NONE ? q->over : p->over;
    r->order = p->order + q->order;
    r->width = p->width > q->width ? p->width : q->width;
    for (int k = 0; k < p->width; k++)
        r->c[k] = p->c[k] * q->x;
    for (int k = p->width; k < q->width; k++)
        r->c[k] = 0;
    for (int k = 0; k < q->width; k++)
        r->c[k] += p->x * q->c[k];
    r->rest =
        (fabs(p->x) * q->rest + fabs(q->x) * p->rest + d * e + V_UNIT * (d * q->rest + e * p->rest + V_UNIT * p->rest * q->rest)) *
        COUNT_ROOM;
    const double most_p = fabs(p->x) + V_UNIT * (d + V_UNIT * p->rest) * COUNT_ROOM;
    const double most_q = fabs(q->x) + V_UNIT * (e + V_UNIT * q->rest) * COUNT_ROOM;
    for (unsigned m = 0; m < 8; m++) {
        r->under[m | q->axes] += p->under[m] * most_q;
        r->under[m | p->axes] += q->under[m] * most_p;
    }
    r->keeps_sign = p->keeps_sign && q->keeps_sign && (p->axes == 0 || q->axes == 0);
    return to;
}

/* A constant that is added to a number of an axis is a length there. */
static inline vnum count_on_axes(vnum a, unsigned axes)
{
    for (int axis = 0; axis < 3; axis++)
        if (axes & ~count_of(a)->axes & 1u << axis) {
            COUNT_MUST(count_unit[axis].at != COUNT_NONE);
            a = count_product(a, count_unit[axis]);
        }
    return a;
}

/* a + sign b, not rounded. */
static inline vnum count_sum(vnum a, vnum b, double sign)
{
    if (count_of(a)->over != count_of(b)->over) {
        const int over = count_of(a)->over == COUNT_NONE ? count_of(b)->over : count_of(a)->over;
        a = count_of(a)->over == COUNT_NONE ? count_product(a, (vnum){over}) : a;
        b = count_of(b)->over == COUNT_NONE ? count_product(b, (vnum){over}) : b;
        COUNT_MUST(count_of(a)->over == count_of(b)->over || count_of(a)->over == COUNT_NONE || count_of(b)->over == COUNT_NONE);
        count_of(a)->over = count_of(b)->over = over;
    }
    if (!count_is_nothing(count_of(a)) && !count_is_nothing(count_of(b))) {
        const unsigned axes = count_of(a)->axes | count_of(b)->axes;
        a = count_on_axes(a, axes);
        b = count_on_axes(b, axes);
    }
    const counted *const p = count_of(a), *const q = count_of(b);
    COUNT_MUST(p->is_place == q->is_place && (!p->is_place || sign < 0));
    const vnum to = count_new(p->axes | q->axes);
    counted *const r = count_of(to);
    r->x = count_is_nothing(q) ? p->x : p->x + sign * q->x;
    r->over = p->over;
    r->order = p->order > q->order ? p->order : q->order;
    r->width = p->width > q->width ? p->width : q->width;
    for (int k = 0; k < p->width; k++)
        r->c[k] = p->c[k];
    for (int k = p->width; k < q->width; k++)
        r->c[k] = 0;
    for (int k = 0; k < q->width; k++)
        r->c[k] += sign * q->c[k];
    r->rest = p->rest + q->rest;
    for (int m = 0; m < 8; m++)
        r->under[m] = p->under[m] + q->under[m];
    /* What rounding makes of an exact number of one axis is off by a factor. */
    r->keeps_sign = count_is_exact(r) && !(r->axes & (r->axes - 1));
    return to;
}

static inline vnum count_add(vnum a, vnum b, double sign)
{
    const bool rounds = !count_is_zero(count_of(a)) && !count_is_zero(count_of(b));
    const vnum sum = count_sum(a, b, sign);
    return rounds ? count_rounded(sum, 0) : sum;
}

/* A power of two rounds nothing, nor does zero. */
static inline bool count_is_free(vnum a, vnum b)
{
    return count_is_power(count_of(a)) || count_is_power(count_of(b)) || count_is_zero(count_of(a)) || count_is_zero(count_of(b));
}

static inline vnum count_multiply(vnum a, vnum b)
{
    return count_is_free(a, b) ? count_product(a, b) : count_rounded(count_product(a, b), 1);
}

static inline vnum count_fused(vnum a, vnum b, vnum c, double sign)
{
    if (!V_FUSED || count_is_free(a, b) || count_is_zero(count_of(c)))
        return count_add(count_multiply(a, b), c, sign);
    return count_rounded(count_sum(count_product(a, b), c, sign), 1);
}

static inline vnum count_quotient(vnum a, vnum b)
{
    COUNT_MUST(count_of(a)->over == COUNT_NONE && count_of(b)->over == COUNT_NONE && !count_of(a)->is_place &&
               !count_of(b)->is_place);
    const vnum to = count_product(a, count_constant(1));
    count_of(to)->over = b.at;
    return count_rounded(to, 0);
}

/* Either, and the same whenever it is asked. */
static inline double count_forked(counted *a)
{
    COUNT_MUST(a->turned || count_signs < count_signs_tried);
    if (!a->turned)
        a->turned = count_script >> count_signs++ & 1 ? -1 : 1;
    return a->turned;
}

/*
 * The sign of a computed number: of one that is off by a factor, its own; of others either. What divides has either where it is 0,
 * as it is never divided there.
 */
static inline double count_sign(vnum a)
{
    counted *const p = count_of(a);
    if (p->over != COUNT_NONE) {
        counted *const q = count_of((vnum){p->over});
        COUNT_MUST(p->axes == 0 && p->x > 0);
        return q->keeps_sign && q->x < 0 ? -1 : q->keeps_sign && q->x > 0 ? 1 : count_forked(q);
    }
    if (count_is_constant(p))
        return signbit(p->x) ? -1 : 1;
    if (!p->keeps_sign || p->turned)
        return count_forked(p);
    COUNT_MUST(!(p->axes & (p->axes - 1)));
    count_compare(p->x);
    return p->x < 0 ? -1 : 1;
}

static inline vnum count_turned(vnum a, double sign)
{
    COUNT_MUST(!count_of(a)->is_place);
    const vnum to = count_new(0);
    counted *const r = count_of(to);
    *r = *count_of(a);
    r->x *= sign;
    r->turned = r->keeps_sign ? 0 : (int)(sign * r->turned);
    for (int k = 0; k < r->width; k++)
        r->c[k] *= sign;
    return to;
}

static inline vnum count_abs(vnum a) { return count_turned(a, count_sign(a)); }
static inline vnum count_flip(vnum a, vnum sign) { return count_turned(a, count_sign(sign)); }

/* Of a number and zero. */
static inline vnum count_part(vnum a, double sign)
{
    if (count_sign(a) * sign > 0)
        return a;
    const vnum none = count_new(count_of(a)->axes);
    count_of(none)->keeps_sign = true;
    return none;
}

/* Of exact numbers one of them; of others what is off by no more than either was. */
static inline vnum count_choice(vnum a, vnum b, double sign)
{
    const counted *const p = count_of(a), *const q = count_of(b);
    if (count_is_zero(p) || count_is_zero(q))
        return count_part(count_is_zero(p) ? b : a, sign);
    if (q->over != COUNT_NONE) { /* the least that a divisor is taken for: what that moves is counted besides */
        COUNT_MUST(sign > 0 && count_least_divisor.at == COUNT_NONE);
        count_least_divisor = b;
        return a;
    }
    COUNT_MUST(p->axes == q->axes && p->is_place == q->is_place && p->over == COUNT_NONE);
    count_compare(p->x - q->x);
    const bool is_a = sign * (p->x - q->x) > 0;
    if (p->is_place || (count_is_exact(p) && count_is_exact(q)))
        return is_a ? a : b;
    COUNT_MUST(p->keeps_sign && q->keeps_sign && p->axes && !(p->axes & (p->axes - 1)) && count_roundings < COUNT_ROUNDINGS);
    const vnum to = count_new(p->axes);
    counted *const r = count_of(to);
    r->x = is_a ? p->x : q->x;
    r->keeps_sign = true;
    r->order = p->order > q->order ? p->order : q->order;
    r->rest = p->rest > q->rest ? p->rest : q->rest;
    memset(r->c, 0, sizeof *r->c * (size_t)count_roundings);
    count_rounding[count_roundings] = count_here;
    r->c[count_roundings++] = count_first(p) > count_first(q) ? count_first(p) : count_first(q);
    r->width = count_roundings;
    return to;
}

/* The words: each says where it stands. */
static inline vnum count_at(count_place here, vnum (*word)(vnum, vnum, double), vnum a, vnum b, double sign)
{
    count_here = here;
    return word(a, b, sign);
}
static inline vnum count_product_at(count_place here, vnum a, vnum b)
{
    count_here = here;
    return count_multiply(a, b);
}
static inline vnum count_quotient_at(count_place here, vnum a, vnum b)
{
    count_here = here;
    return count_quotient(a, b);
}
static inline vnum count_fused_at(count_place here, vnum a, vnum b, vnum c, double sign)
{
    count_here = here;
    return count_fused(a, b, c, sign);
}
#define COUNT_HERE ((count_place){__FILE__, __LINE__})
#define v_splat(a) count_constant(a)
#define v_add(a, b) count_at(COUNT_HERE, count_add, a, b, 1)
#define v_sub(a, b) count_at(COUNT_HERE, count_add, a, b, -1)
#define v_mul(a, b) count_product_at(COUNT_HERE, a, b)
#define v_div(a, b) count_quotient_at(COUNT_HERE, a, b)
#define v_fma(a, b, c) count_fused_at(COUNT_HERE, a, b, c, 1)
#define v_fms(a, b, c) count_fused_at(COUNT_HERE, a, b, c, -1)
#define v_min(a, b) count_at(COUNT_HERE, count_choice, a, b, -1)
#define v_max(a, b) count_at(COUNT_HERE, count_choice, a, b, 1)
#define v_abs(a) count_abs(a)
#define v_flip(a, sign) count_flip(a, sign)

/* Comparisons are exact. What they leave out is counted all the same: all that may be asked is. */
TRIBOX_INLINE vmask v_gt(vnum a, vnum b)
{
    (void)a, (void)b;
    return true;
}
TRIBOX_INLINE vmask v_is_zero(vnum a)
{
    COUNT_MUST(count_of(a)->keeps_sign);
    return !(fabs(count_of(a)->x) > 0);
}
/* Between a number and what leaves it out: zero, or infinity. */
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b)
{
    COUNT_MUST(m && count_is_constant(count_of(b)) && (count_is_zero(count_of(b)) || isinf(count_of(b)->x)));
    return a;
}
/* What stays is counted, as of v_gt. */
TRIBOX_INLINE vnum v_drop(vmask m, vnum a)
{
    (void)m;
    return a;
}
TRIBOX_INLINE vmask m_all(void) { return true; }
TRIBOX_INLINE vmask m_none(void) { return false; }
TRIBOX_INLINE vmask m_not(vmask a) { return !a; }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return a || b; }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return a && b; }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return a && !b; }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return a; }

/* What texts read: a number is told by its place among those that are given. Others besides those that are counted read, too. */
static const vnum *count_memory;
TRIBOX_INLINE vnum v_load(const float *p) { return count_memory ? count_memory[(int)*p] : count_constant(*p); }
TRIBOX_INLINE vnum v_load_few(const float *p, size_t count) { return (void)count, v_load(p); }
TRIBOX_INLINE vnum v_load_up_to(const float *p, size_t count) { return (void)count, v_load(p); }
TRIBOX_INLINE vnum v_read(const double *p) { return count_constant(*p); }
#define v_write(p, a) ((void)(*(p) = 0), (void)(a))
