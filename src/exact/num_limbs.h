/*
 * num_limbs.h - one lane of sign and magnitude in 32-bit limbs, the lowest first, at most LIMBS of them, which the including file
 * defines: at least one more than the longest value takes, for the carry of a sum before it is trimmed (PROOFS.md 9.4).
 */
#include <stdbool.h>
#include <stdint.h>

#include "kernel.h"

typedef struct vnum {
    int used;         /* limbs in use; the highest of them is not zero */
    bool is_negative; /* never set for zero, though a zero of either sign would serve (PROOFS.md 9.4) */
    uint32_t limb[LIMBS];
} vnum;
typedef bool vmask;

static vnum limbs_trimmed(vnum a)
{
    while (a.used && !a.limb[a.used - 1])
        a.used--;
    a.is_negative = a.is_negative && a.used;
    return a;
}

static uint32_t limbs_at(const vnum *a, int k) { return k < a->used ? a->limb[k] : 0; }

/* -1, 0 or 1 as |a| is less than, equal to or greater than |b|. */
static int limbs_compare(const vnum *a, const vnum *b)
{
    for (int k = (a->used > b->used ? a->used : b->used) - 1; k >= 0; k--)
        if (limbs_at(a, k) != limbs_at(b, k))
            return limbs_at(a, k) < limbs_at(b, k) ? -1 : 1;
    return 0;
}

static vnum v_shifted(tribox_integer number)
{
    const int place = number.shift / 32;
    vnum a = {.used = place + 3, .is_negative = number.odd < 0};
    const uint64_t odd = (uint64_t)(number.odd < 0 ? -number.odd : number.odd), low = (odd & 0xffffffff) << number.shift % 32;
    const uint64_t high = (odd >> 32 << number.shift % 32) + (low >> 32);
    for (int k = 0; k < place; k++)
        a.limb[k] = 0;
    a.limb[place] = (uint32_t)low;
    a.limb[place + 1] = (uint32_t)high;
    a.limb[place + 2] = (uint32_t)(high >> 32);
    return limbs_trimmed(a);
}

static vnum v_splat(int a) { return v_shifted((tribox_integer){a, 0}); }

static vnum v_neg(vnum a)
{
    a.is_negative = !a.is_negative && a.used;
    return a;
}

static vnum v_add(vnum a, vnum b)
{
    const bool is_sum = a.is_negative == b.is_negative;
    if (!is_sum && limbs_compare(&a, &b) < 0) {
        const vnum swap = a;
        a = b;
        b = swap;
    }
    vnum c = {.used = (a.used > b.used ? a.used : b.used) + is_sum, .is_negative = a.is_negative};
    int64_t carry = 0;
    for (int k = 0; k < c.used; k++) {
        carry += (int64_t)limbs_at(&a, k) + (is_sum ? 1 : -1) * (int64_t)limbs_at(&b, k);
        c.limb[k] = (uint32_t)(carry & 0xffffffff);
        carry = carry < 0 ? -1 : carry >> 32;
    }
    return limbs_trimmed(c);
}

static vnum v_sub(vnum a, vnum b) { return v_add(a, v_neg(b)); }

static vnum v_mul(vnum a, vnum b)
{
    vnum c = {.used = a.used + b.used, .is_negative = a.is_negative != b.is_negative};
    for (int k = 0; k < c.used; k++)
        c.limb[k] = 0;
    for (int k = 0; k < a.used; k++) {
        uint64_t carry = 0;
        for (int l = 0; l < b.used; l++) {
            carry += (uint64_t)a.limb[k] * b.limb[l] + c.limb[k + l];
            c.limb[k + l] = (uint32_t)carry;
            carry >>= 32;
        }
        c.limb[k + b.used] = (uint32_t)carry;
    }
    return limbs_trimmed(c);
}

static vnum v_fma(vnum a, vnum b, vnum c) { return v_add(v_mul(a, b), c); }

static vnum v_fms(vnum a, vnum b, vnum c) { return v_sub(v_mul(a, b), c); }

static vmask v_gt(vnum a, vnum b)
{
    const vnum difference = v_sub(a, b);
    return difference.used && !difference.is_negative;
}

static vnum v_min(vnum a, vnum b) { return v_gt(b, a) ? a : b; }

static vnum v_max(vnum a, vnum b) { return v_gt(a, b) ? a : b; }

static vnum v_abs(vnum a)
{
    a.is_negative = false;
    return a;
}

static vnum v_flip(vnum a, vnum sign) { return sign.is_negative ? v_neg(a) : a; }

static vmask m_or(vmask a, vmask b) { return a || b; }
