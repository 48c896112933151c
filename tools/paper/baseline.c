/*
 * baseline.c - the paper as published: T. Akenine-Moller, "Fast 3D Triangle-Box Overlap Testing", journal of graphics tools 6(1),
 * 2001. In the order that its section 3 found the fastest: bullet 3 (nine edge axes), bullet 1 (box normals), bullet 2 (plane),
 * leaving at the first axis that separates.
 */
#include "baseline.h"

#include "paper_axes.h"

static inline bool overlap(const float c[3], const float h[3], const float u[3][3])
{
    float v[3][3], f[3][3];
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            v[j][a] = u[j][a] - c[a];
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            f[j][a] = v[(j + 1) % 3][a] - v[j][a];
    if (apart_on_axes_of_edge(v[0], v[2], f[0], h) || apart_on_axes_of_edge(v[1], v[0], f[1], h) ||
        apart_on_axes_of_edge(v[2], v[1], f[2], h))
        return false;
    for (int a = 0; a < 3; a++)
        if (apart_on_box_normal((const float(*)[3])v, h, a))
            return false;
    return !apart_on_plane(v[0], f[0], f[1], h);
}

int baseline_overlap(const float center[3], const float half[3], const float triangle[3][3])
{
    return overlap(center, half, triangle);
}

void baseline_overlap_soup(const float center[3], const float half[3], const float (*triangles)[3][3], size_t count, uint64_t *mask)
{
    /* Copies, which the compiler knows that the mask does not overlap. */
    const float c[3] = {center[0], center[1], center[2]}, h[3] = {half[0], half[1], half[2]};
    for (size_t first = 0; first < count; first += 64) {
        const size_t lanes = count - first < 64 ? count - first : 64;
        uint64_t word = 0;
        for (size_t lane = 0; lane < lanes; lane++)
            word |= (uint64_t)overlap(c, h, triangles[first + lane]) << lane;
        mask[first / 64] = word;
    }
}
