/* settle.c - a batch of open pairs: in double all at once, then one by one in integers. */
#include "settle.h"

#include <math.h>

#include "bits.h"
#include "exact/exact.h"
#include "exact/tame.h"

static tribox_pair batch_pair_at(const tribox_batch *batch, unsigned i)
{
    tribox_pair pair;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            pair.u[j][a] = batch->number[3 * a + j][i];
        pair.lo[a] = batch->number[9 + a][i];
        pair.hi[a] = batch->number[12 + a][i];
    }
    return pair;
}

/* Lanes up to a whole packet repeat the last. Their answers are dropped, but arithmetic on garbage can be slow, or be reported. */
static void fill_up_batch(tribox_batch *batch, unsigned count)
{
    for (int k = 0; k < 15; k++)
        for (unsigned i = count; i % TRIBOX_DOUBLES_MAX; i++)
            batch->number[k][i] = batch->number[k][count - 1];
}

/* The pairs with numbers that the double stage cannot bound: PROOFS.md 6.1. */
static uint64_t wild_pairs(const tribox_batch *batch, unsigned count)
{
    double least[TRIBOX_BATCH], most[TRIBOX_BATCH];
    uint64_t wild = 0;
    for (unsigned i = 0; i < count; i++)
        least[i] = most[i] = 1;
    for (int k = 0; k < 15; k++)
        for (unsigned i = 0; i < count; i++) {
            const double size = fabs(batch->number[k][i]), size_but_zero = size > 0 ? size : 1;
            least[i] = size_but_zero < least[i] ? size_but_zero : least[i];
            most[i] = size > most[i] ? size : most[i];
        }
    for (unsigned i = 0; i < count; i++)
        wild |= (uint64_t)(least[i] < TRIBOX_TAME_LEAST || most[i] > TRIBOX_TAME_MOST) << i;
    return wild;
}

static tribox_verdict settle(tribox_batch *batch, unsigned count, uint64_t wild, const tribox_plan *plan)
{
    const bool is_exact = plan->accuracy != TRIBOX_CONSERVATIVE; /* that takes what stays open for an overlap */
    fill_up_batch(batch, count);
    tribox_verdict verdict = plan->kernel->in_double(batch, count, plan->axes, is_exact);
    verdict.overlapping &= ~wild;
    verdict.open &= ~wild;
    if (!is_exact)
        verdict.overlapping |= verdict.open;
    for (uint64_t open = (is_exact ? verdict.open : 0) | (wild & verdict.finite); open; open &= open - 1) {
        const unsigned i = tribox_lowest_bit(open);
        const tribox_pair pair = batch_pair_at(batch, i);
        verdict.overlapping |= (uint64_t)tribox_exact_overlap(&pair, plan->axes) << i;
    }
    verdict.open = 0;
    return verdict;
}

tribox_verdict tribox_settle_batch(tribox_batch *batch, unsigned count, const tribox_plan *plan)
{
    return settle(batch, count, 0, plan);
}

tribox_verdict tribox_settle_batch_f64(tribox_batch *batch, unsigned count, const tribox_plan *plan)
{
    return settle(batch, count, wild_pairs(batch, count), plan);
}
