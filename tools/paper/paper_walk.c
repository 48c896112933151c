/* paper_walk.c - the paper's test over a soup, with the order of the groups as a constant. PAPER_WALKS names the table. */
#include "paper.h"

#include "paper_axes.h"

PAPER_INLINE void walk(const float center[3], const float half[3], const float (*triangles)[3][3], size_t count, uint64_t *mask,
                       unsigned order)
{
    /* Copies, so that the compiler knows that the mask does not overlap them. */
    const float c[3] = {center[0], center[1], center[2]}, h[3] = {half[0], half[1], half[2]};
    for (size_t first = 0; first < count; first += 64) {
        const size_t lanes = count - first < 64 ? count - first : 64;
        uint64_t word = 0;
        for (size_t lane = 0; lane < lanes; lane++)
            word |= (uint64_t)paper_overlaps(c, h, triangles[first + lane], order) << lane;
        mask[first / 64] = word;
    }
}

#define PAPER_WALK(order) \
    static void walk_##order(const float center[3], const float half[3], const float(*triangles)[3][3], size_t count, \
                             uint64_t *mask) \
    { \
        walk(center, half, triangles, count, mask, order); \
    }
PAPER_WALK(123)
PAPER_WALK(132)
PAPER_WALK(213)
PAPER_WALK(231)
PAPER_WALK(312)
PAPER_WALK(321)

paper_walk *const PAPER_WALKS[PAPER_ORDERS] = {walk_123, walk_132, walk_213, walk_231, walk_312, walk_321};
