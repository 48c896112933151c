/* settle.c - a batch of undecided pairs: in double all at once, then one by one in integers. */
#include "settle.h"

#include "base/bits.h"
#include "exact/exact.h"

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
static void fill_up_batch(tribox_batch *batch, tribox_packed *packed, unsigned count)
{
    for (unsigned i = count; i % TRIBOX_DOUBLES_MAX; i++) {
        for (int k = packed ? 9 : 0; k < 15; k++)
            batch->number[k][i] = batch->number[k][count - 1];
        for (int k = 0; packed && k < 9; k++)
            packed->number[k][i] = packed->number[k][count - 1];
    }
}

tribox_verdict tribox_settle_packed(tribox_batch *batch, tribox_packed *packed, unsigned count, const tribox_plan *plan)
{
    /* CONSERVATIVE counts undecided pairs as overlaps; wild ones are settled exactly. */
    const bool is_exact = plan->accuracy != TRIBOX_CONSERVATIVE;
    fill_up_batch(batch, packed, count);
    tribox_verdict verdict = plan->kernel->settle->in_double(batch, packed, count, plan->axes, is_exact);
    if (!is_exact)
        verdict.overlapping |= verdict.undecided & ~verdict.wild;
    for (uint64_t undecided = is_exact ? verdict.undecided : verdict.wild; undecided; undecided &= undecided - 1) {
        const unsigned i = tribox_lowest_bit(undecided);
        const tribox_pair pair = batch_pair_at(batch, i);
        verdict.overlapping |= (uint64_t)tribox_exact_overlap(&pair, plan->axes) << i;
    }
    verdict.undecided = verdict.wild = 0;
    return verdict;
}
