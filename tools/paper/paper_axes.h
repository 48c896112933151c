/*
 * paper_axes.h - the axes as published: T. Akenine-Moller, "Fast 3D Triangle-Box Overlap Testing", journal of graphics tools 6(1),
 * 2001. Written from the formulas of its section 2, in the paper's symbols (c, h, v, f, n, p, r). A predicate is true if an axis
 * separates a triangle from the box [-h, h].
 */
#ifndef PAPER_AXES_H
#define PAPER_AXES_H

#include <math.h>
#include <stdbool.h>

static inline float min2(float a, float b) { return a < b ? a : b; }

static inline float max2(float a, float b) { return a > b ? a : b; }

/*
 * Bullet 3, axis e_i x f, where f = v_(j+1) - v_j and (a, b) are the axes after i: component a is -f_b, component b is f_a.
 * The ends of the edge project to one number, p; the third vertex to another, q; the box to [-r, r].
 */
static inline bool apart_on_edge(const float v_end[3], const float v_third[3], const float f[3], const float h[3], int a, int b)
{
    const float p = f[a] * v_end[b] - f[b] * v_end[a];
    const float q = f[a] * v_third[b] - f[b] * v_third[a];
    const float r = h[a] * fabsf(f[b]) + h[b] * fabsf(f[a]);
    return min2(p, q) > r || max2(p, q) < -r;
}

static inline bool apart_on_axes_of_edge(const float v_end[3], const float v_third[3], const float f[3], const float h[3])
{
    return apart_on_edge(v_end, v_third, f, h, 1, 2) || apart_on_edge(v_end, v_third, f, h, 2, 0) ||
           apart_on_edge(v_end, v_third, f, h, 0, 1);
}

/* Bullet 1, axis e_a: the triangle's bounding box against the box. */
static inline bool apart_on_box_normal(const float v[3][3], const float h[3], int a)
{
    return min2(min2(v[0][a], v[1][a]), v[2][a]) > h[a] || max2(max2(v[0][a], v[1][a]), v[2][a]) < -h[a];
}

/*
 * Bullet 2: the plane through v_0 with normal n = f_0 x f_1 against the two corners of the box that lie farthest along n.
 * The critical corner is h with the signs of n, and n . h of it is r.
 */
static inline bool apart_on_plane(const float v_0[3], const float f_0[3], const float f_1[3], const float h[3])
{
    const float n[3] = {f_0[1] * f_1[2] - f_0[2] * f_1[1], f_0[2] * f_1[0] - f_0[0] * f_1[2], f_0[0] * f_1[1] - f_0[1] * f_1[0]};
    const float d = n[0] * v_0[0] + n[1] * v_0[1] + n[2] * v_0[2];
    const float r = h[0] * fabsf(n[0]) + h[1] * fabsf(n[1]) + h[2] * fabsf(n[2]);
    return fabsf(d) > r;
}

#if defined(__GNUC__)
#define PAPER_INLINE static inline __attribute__((always_inline))
#else
#define PAPER_INLINE static inline
#endif

/* A triangle seen from the centre of the box: its vertices, and its edges. */
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

/*
 * The whole test of triangle u against the box with centre c and half size h. order: of the groups, a constant if it is to be
 * fast.
 */
PAPER_INLINE bool paper_overlaps(const float c[3], const float h[3], const float u[3][3], unsigned order)
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

#endif
