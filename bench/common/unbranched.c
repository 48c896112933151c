/*
 * unbranched.c - thirteen axes over nine streams, 64 triangles at a time. After the box normals it asks whether any of the 64 is
 * left; there is no other branch, and no intrinsic: layout and compiler alone.
 */
#include "unbranched.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 64 };

/* 1 for each triangle that nothing separates so far. */
typedef struct block {
    float v[3][3][BLOCK]; /* v[j][a]: axis a of vertex j, seen from the centre */
    uint32_t is_left[BLOCK];
} block;

static inline float least(float a, float b) { return a < b ? a : b; }

static inline float most(float a, float b) { return a > b ? a : b; }

static inline uint32_t box_normals(block *b, const float *at[3][3], const float c[3], const float h[3], size_t count)
{
    uint32_t any = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t is_left = 1;
        for (int a = 0; a < 3; a++) {
            const float p = at[0][a][i] - c[a], q = at[1][a][i] - c[a], r = at[2][a][i] - c[a];
            b->v[0][a][i] = p;
            b->v[1][a][i] = q;
            b->v[2][a][i] = r;
            is_left &= (uint32_t)(least(least(p, q), r) <= h[a]) & (uint32_t)(most(most(p, q), r) >= -h[a]);
        }
        b->is_left[i] = is_left;
        any |= is_left;
    }
    return any;
}

static inline uint32_t on_edge(const float end[3], const float third[3], const float f[3], const float h[3], int a, int b)
{
    const float p = f[a] * end[b] - f[b] * end[a], q = f[a] * third[b] - f[b] * third[a];
    const float r = h[a] * fabsf(f[b]) + h[b] * fabsf(f[a]);
    return (uint32_t)(least(p, q) <= r) & (uint32_t)(most(p, q) >= -r);
}

static inline void plane_and_edges(block *b, const float h[3])
{
    for (size_t i = 0; i < BLOCK; i++) {
        float v[3][3], f[3][3];
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                v[j][a] = b->v[j][a][i];
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                f[j][a] = v[(j + 1) % 3][a] - v[j][a];
        uint32_t is_left = b->is_left[i];
        for (int j = 0; j < 3; j++)
            is_left &= on_edge(v[j], v[(j + 2) % 3], f[j], h, 1, 2) & on_edge(v[j], v[(j + 2) % 3], f[j], h, 2, 0) &
                       on_edge(v[j], v[(j + 2) % 3], f[j], h, 0, 1);
        float d = 0, r = 0;
        for (int a = 0; a < 3; a++) {
            const int s = (a + 1) % 3, t = (a + 2) % 3;
            const float n = f[0][s] * f[1][t] - f[0][t] * f[1][s];
            d += n * v[0][a];
            r += h[a] * fabsf(n);
        }
        b->is_left[i] = is_left & (uint32_t)(fabsf(d) <= r);
    }
}

/* Eight bytes of 0 or 1 at a time. */
static inline uint64_t word_of(const block *b)
{
    uint8_t bytes[BLOCK];
    uint64_t word = 0;
    for (size_t i = 0; i < BLOCK; i++)
        bytes[i] = (uint8_t)b->is_left[i];
    for (size_t k = 0; k < 8; k++) {
        uint64_t eight;
        memcpy(&eight, bytes + 8 * k, sizeof eight);
        word |= (eight * UINT64_C(0x0102040810204080)) >> 56 << 8 * k;
    }
    return word;
}

void unbranched_overlap(const tribox_soup *soup, const float center[3], const float half[3], uint64_t *mask)
{
    const float c[3] = {center[0], center[1], center[2]}, h[3] = {half[0], half[1], half[2]};
    block b;
    memset(&b, 0, sizeof b);
    for (size_t first = 0; first < soup->count; first += BLOCK, mask++) {
        const size_t count = soup->count - first < BLOCK ? soup->count - first : BLOCK;
        const float *at[3][3];
        for (int j = 0; j < 3; j++) {
            at[j][0] = soup->x[j] + first;
            at[j][1] = soup->y[j] + first;
            at[j][2] = soup->z[j] + first;
        }
        memset(b.is_left, 0, sizeof b.is_left);
        const uint32_t any = count == BLOCK ? box_normals(&b, at, c, h, BLOCK) : box_normals(&b, at, c, h, count);
        if (any)
            plane_and_edges(&b, h);
        *mask = any ? word_of(&b) : 0;
    }
}
