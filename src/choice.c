/* choice.c - the cheapest order on what surveys saw. */
#include "choice.h"

#include "bits.h"

/*
 * What the stages cost, in hundredths of what a packet costs that 132 asks everything: measured with the benchmark `order`, and
 * about alike for all kernels, as they run one text. The stage that comes first pays for loading the packet.
 */
enum { COST_X = 14, COST_Y = 4, COST_Z = 4, COST_UNFORESEEN_EXIT = 20 };

static const struct order_cost {
    unsigned sequence;
    unsigned first, both;                /* groups: what is asked first, and what is asked before the last */
    unsigned cost[TRIBOX_ACCURACIES][3]; /* of each stage; of the box normals that come first, none */
} orders[TRIBOX_CHOICE_ORDERS] = {
#define ORDER(first, second, third, ...) \
    { \
        TRIBOX_SEQUENCE_##first##second##third, 1u << (first - 1), 1u << (first - 1) | 1u << (second - 1), { __VA_ARGS__ } \
    }
    ORDER(1, 3, 2, {0, 78, 0}, {0, 78, 0}, {0, 78, 0}),       ORDER(1, 2, 3, {0, 40, 52}, {0, 40, 52}, {0, 36, 48}),
    ORDER(2, 1, 3, {50, 10, 60}, {50, 10, 60}, {42, 10, 56}), ORDER(2, 3, 1, {50, 60, 10}, {50, 60, 10}, {42, 56, 10}),
    ORDER(3, 1, 2, {80, 10, 20}, {80, 10, 20}, {80, 10, 16}), ORDER(3, 2, 1, {80, 22, 10}, {80, 22, 10}, {80, 16, 10}),
#undef ORDER
};

tribox_choice tribox_choice_fixed(unsigned sequence) { return (tribox_choice){.sequence = sequence}; }

tribox_choice tribox_choice_start(void) { return (tribox_choice){.sequence = orders[0].sequence, .is_open = true}; }

/* Of the packets of a word: those that a set of groups leaves, and how often the next packet meets another fate. */
typedef struct fates {
    unsigned left, changes;
} fates;

static fates fates_of(const tribox_seen *seen, uint64_t rejected)
{
    const uint64_t all = ~UINT64_C(0) >> (64 - seen->packets);
    return (fates){tribox_count_bits(all & ~rejected), tribox_count_bits((rejected ^ rejected >> 1) & all >> 1)};
}

/* What a stage costs the packets left to it, and the exits before it, of which those that nobody can foresee cost most. */
static unsigned cost_of(fates before, unsigned cost)
{
    return cost ? cost * before.left + COST_UNFORESEEN_EXIT * before.changes : 0;
}

void tribox_choice_costs(const tribox_seen *seen, tribox_accuracy accuracy, unsigned cost[TRIBOX_CHOICE_ORDERS])
{
    fates of[TRIBOX_AXES_ALL];
    const uint64_t beside = seen->rejected[TRIBOX_AXES_BOX];
    const unsigned box = COST_X * seen->packets + cost_of(fates_of(seen, seen->beside[0]), COST_Y) +
                         cost_of(fates_of(seen, seen->beside[1]), COST_Z);
    for (unsigned groups = 1; groups < TRIBOX_AXES_ALL; groups++)
        of[groups] = fates_of(seen, seen->rejected[groups]);
    const fates plane = fates_of(seen, seen->rejected[TRIBOX_AXES_PLANE] | beside);
    const fates edges = fates_of(seen, seen->rejected[TRIBOX_AXES_EDGES] | beside);
    for (unsigned o = 0; o < TRIBOX_CHOICE_ORDERS; o++) {
        const struct order_cost *const order = &orders[o];
        const unsigned *const stage = order->cost[accuracy];
        const fates first = order->both == (TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE) && order->first == TRIBOX_AXES_PLANE ? plane
                            : order->both == (TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES) && order->first == TRIBOX_AXES_EDGES
                                ? edges
                                : of[order->first];
        cost[o] = order->first == TRIBOX_AXES_BOX ? box : stage[0] * seen->packets;
        cost[o] += cost_of(first, stage[1]) + cost_of(of[order->both], stage[2]);
    }
}

/* Whether every packet is beside the box: then nothing else is known, and the box normals come first. */
static bool is_all_beside(const tribox_seen *seen)
{
    return seen->rejected[TRIBOX_AXES_BOX] == ~UINT64_C(0) >> (64 - seen->packets);
}

void tribox_choice_learn(tribox_choice *choice, const tribox_seen *seen, tribox_accuracy accuracy)
{
    enum { FIRST_REST = 15, MOST_REST = 63 };
    unsigned best = 0;
    unsigned cost[TRIBOX_CHOICE_ORDERS];
    if (is_all_beside(seen))
        for (unsigned o = 0; o < TRIBOX_CHOICE_ORDERS; o++)
            cost[o] = (orders[o].first == TRIBOX_AXES_BOX ? COST_X + COST_Y : orders[o].cost[accuracy][0]) * seen->packets;
    else
        tribox_choice_costs(seen, accuracy, cost);
    for (unsigned o = 0; o < TRIBOX_CHOICE_ORDERS; o++) {
        choice->cost[o] = choice->cost[o] / 2 + cost[o];
        best = choice->cost[o] < choice->cost[best] ? o : best;
    }
    choice->sequence = orders[best].sequence;
    choice->rest = choice->surveys++ ? MOST_REST : FIRST_REST;
}
