/* order_paper.c - baseline.c with the order of the groups as a constant: leaves at the first axis that separates, as published. */
#include "order_paper.h"

#include "paper_axes.h"

#if defined(__GNUC__)
#define PAPER_INLINE static inline __attribute__((always_inline))
#else
#define PAPER_INLINE static inline
#endif

typedef struct shape {
    float v[3][3], f[3][3];
} shape;

PAPER_INLINE bool apart_on_group(const shape *s, const float h[3], unsigned group)
{
    const float(*const v)[3] = s->v, (*const f)[3] = s->f;
    if (group == 1)
        return apart_on_box_normal(v, h, 0) || apart_on_box_normal(v, h, 1) || apart_on_box_normal(v, h, 2);
    if (group == 2)
        return apart_on_plane(v[0], f[0], f[1], h);
    return apart_on_axes_of_edge(v[0], v[2], f[0], h) || apart_on_axes_of_edge(v[1], v[0], f[1], h) ||
           apart_on_axes_of_edge(v[2], v[1], f[2], h);
}

PAPER_INLINE bool overlap(const float c[3], const float h[3], const float u[3][3], unsigned order)
{
    shape s;
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            s.v[j][a] = u[j][a] - c[a];
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            s.f[j][a] = s.v[(j + 1) % 3][a] - s.v[j][a];
    return !apart_on_group(&s, h, order / 100) && !apart_on_group(&s, h, order / 10 % 10) && !apart_on_group(&s, h, order % 10);
}

PAPER_INLINE void walk(const float center[3], const float half[3], const float (*triangles)[3][3], size_t count, uint64_t *mask,
                       unsigned order)
{
    /* Copies, which the compiler knows that the mask does not overlap. */
    const float c[3] = {center[0], center[1], center[2]}, h[3] = {half[0], half[1], half[2]};
    for (size_t first = 0; first < count; first += 64) {
        const size_t lanes = count - first < 64 ? count - first : 64;
        uint64_t word = 0;
        for (size_t lane = 0; lane < lanes; lane++)
            word |= (uint64_t)overlap(c, h, triangles[first + lane], order) << lane;
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

paper_walk *paper_in_order(unsigned order)
{
    return order == 123   ? walk_123
           : order == 132 ? walk_132
           : order == 213 ? walk_213
           : order == 231 ? walk_231
           : order == 312 ? walk_312
                          : walk_321;
}
