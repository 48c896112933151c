/* choice.c - the cheapest order on what surveys saw. */
#include "choice.h"

#include "base/bits.h"

enum { BOX = TRIBOX_AXES_BOX, PLANE = TRIBOX_AXES_PLANE, EDGES = TRIBOX_AXES_EDGES };

/*
 * What stages cost, in hundredths of what 132 costs a packet of which it asks everything: measured with the benchmark `order`, and
 * much alike for all kernels, as they run one text. The group that is first pays for loading and preparing the packet; of what it
 * leaves alone, everything is tested from the start.
 */
enum { COST_X = 14, COST_Y = 4, COST_Z = 4, COST_UNFORESEEN_EXIT = 50 };

static const struct order_cost {
    unsigned sequence;
    unsigned first, both; /* groups: what is asked first, and what is asked before the last */
    unsigned fast[3];     /* cost of the stages; of the box normals that come first, none here */
    unsigned exact[3];    /* the same for EXACT and CONSERVATIVE */
} orders[TRIBOX_CHOICE_ORDERS] = {
    {TRIBOX_SEQUENCE_123,
     BOX,
     BOX | PLANE,
     {0, 36, 48},
     {0, 40, 52}},                                                   /* taken where all is apart from the box, in case that ends */
    {TRIBOX_SEQUENCE_132, BOX, BOX | EDGES, {0, 78, 0}, {0, 78, 0}}, /* edges and plane together */
    {TRIBOX_SEQUENCE_213, PLANE, BOX | PLANE, {34, 28, 78}, {40, 28, 78}},
    {TRIBOX_SEQUENCE_312, EDGES, BOX | EDGES, {80, 28, 78}, {80, 28, 78}},
};

/* Of the packets of a word: how many are left by some groups, and how often one is and the next is not, or the other way round. */
typedef struct fates {
    unsigned left, changes;
} fates;

static unsigned count_of(uint64_t packets) { return packets ? tribox_count_bits(packets) : 0; }

static fates fates_of(uint64_t among, uint64_t rejected)
{
    return (fates){count_of(among & ~rejected), count_of((rejected ^ rejected >> 1) & among & among >> 1)};
}

/* What is not known of packets apart from the box is taken to be as in the others, of which there is one at least. */
static fates fates_by_groups(const tribox_seen *seen, unsigned groups, uint64_t all, uint64_t apart)
{
    if (groups & BOX || !apart)
        return fates_of(all, seen->rejected[groups] | apart);
    const fates known = fates_of(all & ~apart, seen->rejected[groups]);
    const unsigned others = seen->packets - count_of(apart);
    return (fates){known.left * seen->packets / others, known.changes * seen->packets / others};
}

static unsigned least_of(unsigned a, unsigned b) { return a < b ? a : b; }

/*
 * What a stage costs that `reached` packets come to and some are left for. Where a packet leaves and the next does not, branch
 * prediction is likely to be wrong, but at most as often as one of the two is the exception.
 */
static unsigned stage_cost(unsigned reached, fates of, unsigned cost)
{
    const unsigned gone = reached > of.left ? reached - of.left : 0;
    return cost ? cost * of.left + COST_UNFORESEEN_EXIT * least_of(least_of(of.left, gone), of.changes) : 0;
}

void tribox_choice_costs(const tribox_seen *seen, tribox_accuracy accuracy, unsigned cost[TRIBOX_CHOICE_ORDERS])
{
    const unsigned packets = seen->packets;
    const uint64_t all = ~UINT64_C(0) >> (64 - packets), apart_y = seen->apart[0] | seen->apart[1];
    const uint64_t apart = apart_y | seen->apart[2];
    const fates y = fates_of(all, seen->apart[0]), z = fates_of(all, apart_y);
    const unsigned box = COST_X * packets + stage_cost(packets, y, COST_Y) + stage_cost(y.left, z, COST_Z);
    fates of[TRIBOX_AXES_ALL];
    for (unsigned groups = 1; groups < TRIBOX_AXES_ALL; groups++)
        of[groups] = fates_by_groups(seen, groups, all, apart);
    for (unsigned o = 0; o < TRIBOX_CHOICE_ORDERS; o++) {
        const struct order_cost *const order = &orders[o];
        const unsigned *const stage = accuracy == TRIBOX_FAST ? order->fast : order->exact;
        cost[o] = order->first == BOX ? box : stage[0] * packets;
        cost[o] += stage_cost(order->first == BOX ? z.left : packets, of[order->first], stage[1]);
        cost[o] += stage_cost(of[order->first].left, of[order->both], stage[2]);
    }
}

/* Whether the box normals rejected every packet: then nothing else is known, nor needs to be. */
static bool is_all_apart(const tribox_seen *seen)
{
    return (seen->apart[0] | seen->apart[1] | seen->apart[2]) == ~UINT64_C(0) >> (64 - seen->packets);
}

/* Surveys are close at first, and then every other block (pairs.h) begins with one: it can take as long as eight words. */
static size_t rest_after(unsigned surveys) { return surveys == 1 ? 15 : surveys == 2 ? 47 : 127; }

static unsigned cheapest(const unsigned cost[TRIBOX_CHOICE_ORDERS])
{
    unsigned best = 0;
    for (unsigned o = 1; o < TRIBOX_CHOICE_ORDERS; o++)
        best = cost[o] < cost[best] ? o : best;
    return best;
}

void tribox_choice_learn(tribox_choice *choice, const tribox_seen *seen, tribox_accuracy accuracy)
{
    unsigned cost[TRIBOX_CHOICE_ORDERS];
    if (is_all_apart(seen))
        for (unsigned o = 0; o < TRIBOX_CHOICE_ORDERS; o++)
            cost[o] = (orders[o].first == BOX ? COST_X : orders[o].fast[0]) * seen->packets;
    else
        tribox_choice_costs(seen, accuracy, cost);
    /* An order that has become a fifth too dear is a sign that what was seen before tells nothing of what comes. */
    const bool is_new = 5 * cost[choice->best] > 6 * cost[cheapest(cost)];
    for (unsigned o = 0; o < TRIBOX_CHOICE_ORDERS; o++)
        choice->cost[o] = cost[o] + (is_new ? 0 : choice->cost[o] / 2);
    choice->best = cheapest(choice->cost);
    choice->sequence = orders[choice->best].sequence;
    choice->rest = rest_after(++choice->surveys);
    if (seen->has_ties)
        choice->ties = seen->are_ties_exact ? TRIBOX_TIES_AT_ONCE : TRIBOX_TIES_LEFT;
}
