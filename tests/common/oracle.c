#include "oracle.h"

#include <limits.h>
#include <math.h>

#include <gmp.h>

typedef mpz_t num;
#define NUM(name) mpz_##name
#include "separating.h"

/* A finite number as odd * 2^exponent; zero as 0. */
static int64_t odd_of(double number, int *exponent)
{
    const int64_t digits = (int64_t)ldexp(frexp(number, exponent), 53);
    const int zeros = digits ? __builtin_ctzll((unsigned long long)digits) : 0;
    *exponent += zeros - 53;
    return digits / (INT64_C(1) << zeros);
}

oracle_integers oracle_integers_of(const pair_f64 *pair)
{
    oracle_integers in;
    int exponent[15], unit = INT_MAX, end = INT_MIN;
    for (int k = 0; k < 15; k++) {
        in.odd[k] = odd_of(pair_f64_number(pair, k), &exponent[k]);
        if (!in.odd[k])
            continue;
        unit = exponent[k] < unit ? exponent[k] : unit;
        const int top = ilogb(pair_f64_number(pair, k)) + 1;
        end = top > end ? top : end;
    }
    for (int k = 0; k < 15; k++)
        in.shift[k] = in.odd[k] ? (unsigned long)(exponent[k] - unit) : 0;
    in.bits = end > unit ? end - unit : 0;
    return in;
}

bool oracle_overlaps(oracle_axes truth, unsigned groups)
{
    const unsigned plane = 1u << ORACLE_PLANE, box = plane - 1, edges = (1u << ORACLE_AXES) - (1u << ORACLE_EDGES);
    const unsigned chosen =
        (groups & TRIBOX_AXES_BOX ? box : 0) | (groups & TRIBOX_AXES_PLANE ? plane : 0) | (groups & TRIBOX_AXES_EDGES ? edges : 0);
    return !(truth.apart & chosen);
}

bool oracle_pair_overlaps(const pair_f64 *pair, oracle_axes truth, unsigned groups)
{
    return pair_f64_is_finite(pair) && !box_is_empty(&pair->box) && oracle_overlaps(truth, groups);
}

void oracle_explain(FILE *out, const pair_f64 *pair)
{
    static const char *const name[ORACLE_AXES] = {"x",          "y",          "z",          "plane",      "x cross f0",
                                                  "x cross f1", "x cross f2", "y cross f0", "y cross f1", "y cross f2",
                                                  "z cross f0", "z cross f1", "z cross f2"};
    for (int j = 0; j < 3; j++)
        fprintf(out, "  u%d  %a %a %a\n", j, pair->u[j][0], pair->u[j][1], pair->u[j][2]);
    fprintf(out, "  lo  %a %a %a\n", pair->box.lo[0], pair->box.lo[1], pair->box.lo[2]);
    fprintf(out, "  hi  %a %a %a\n", pair->box.hi[0], pair->box.hi[1], pair->box.hi[2]);
    if (!pair_f64_is_finite(pair) || box_is_empty(&pair->box))
        return;
    const oracle_axes truth = oracle_separating_gmp(pair);
    for (int k = 0; k < ORACLE_AXES; k++)
        fprintf(out, "  %-10s  %s\n", name[k],
                truth.apart >> k & 1      ? "apart"
                : truth.touching >> k & 1 ? "touching"
                                          : "overlapping");
}

oracle_axes oracle_separating_gmp(const pair_f64 *pair)
{
    const oracle_integers in = oracle_integers_of(pair);
    return separating(&in);
}

oracle_axes oracle_separating(const pair_f64 *pair)
{
    const oracle_integers in = oracle_integers_of(pair);
#if defined(__SIZEOF_INT128__)
    if (in.bits <= ORACLE_INT128_BITS)
        return oracle_separating_int128(&in);
#endif
    return separating(&in);
}
