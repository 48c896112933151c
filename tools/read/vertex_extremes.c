/* vertex_extremes.c - finds bounds in lanes, and a vertex for each by its block. */
#include "vertex_extremes.h"

#include <math.h>
#include <string.h>

enum { LANES = 48 }; /* sixteen vertices: each lane is of one axis, and many are taken at once */

typedef struct lanes {
    float lo[LANES], hi[LANES], sound[LANES]; /* sound: 0, or NaN where something is not finite */
    uint32_t negative_zero[LANES];            /* not 0 where there was one */
} lanes;

vertex_extremes vertex_extremes_none(void)
{
    return (vertex_extremes){.is_finite = true, .bound = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY}};
}

static bool is_beyond(float number, float bound, int side) { return side < 3 ? number < bound : number > bound; }

static void add_number(float number, size_t block, int side, vertex_extremes *e)
{
    if (is_beyond(number, e->bound[side], side) || (number == e->bound[side] && block < e->at[side])) {
        e->bound[side] = number;
        e->at[side] = block;
    }
}

static uint32_t negative_zero(float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits == UINT32_C(0x80000000);
}

static lanes bounds_in_lanes(const float *numbers, size_t count)
{
    lanes l;
    for (int k = 0; k < LANES; k++) {
        l.lo[k] = INFINITY;
        l.hi[k] = -INFINITY;
        l.sound[k] = 0;
        l.negative_zero[k] = 0;
    }
    for (size_t i = 0; i < count; i += LANES)
        for (int k = 0; k < LANES; k++) {
            const float number = numbers[i + (size_t)k];
            l.lo[k] = number < l.lo[k] ? number : l.lo[k];
            l.hi[k] = number > l.hi[k] ? number : l.hi[k];
            l.sound[k] += number * 0;
            l.negative_zero[k] |= negative_zero(number);
        }
    return l;
}

void vertex_extremes_look(const float *positions, size_t first, size_t count, vertex_extremes *e)
{
    const float *const numbers = positions + 3 * first;
    const size_t whole = 3 * count / LANES * LANES;
    const lanes l = bounds_in_lanes(numbers, whole);
    for (int k = 0; k < LANES && whole; k++) {
        add_number(l.lo[k], first, k % 3, e);
        add_number(l.hi[k], first, k % 3 + 3, e);
        e->is_finite &= l.sound[k] == 0;
        e->has_negative_zero |= l.negative_zero[k] != 0;
    }
    for (size_t i = whole; i < 3 * count; i++) {
        add_number(numbers[i], first, (int)(i % 3), e);
        add_number(numbers[i], first, (int)(i % 3) + 3, e);
        e->is_finite &= isfinite(numbers[i]) != 0;
        e->has_negative_zero |= negative_zero(numbers[i]) != 0;
    }
}

void vertex_extremes_join(const vertex_extremes *part, vertex_extremes *all)
{
    all->is_finite &= part->is_finite;
    all->has_negative_zero |= part->has_negative_zero;
    for (int side = 0; side < EXTREMES; side++)
        add_number(part->bound[side], part->at[side], side, all);
}

bool vertex_extremes_box(const vertex_extremes *e, tribox_box *box)
{
    bool is_sure = e->is_finite;
    for (int a = 0; a < 3; a++) {
        box->lo[a] = (double)e->bound[a];
        box->hi[a] = (double)e->bound[a + 3];
        is_sure &= !e->has_negative_zero || (e->bound[a] != 0 && e->bound[a + 3] != 0);
    }
    return is_sure;
}

void vertex_extremes_find(const vertex_extremes *e, const float *positions, size_t block, uint32_t vertex[EXTREMES])
{
    for (size_t side = 0; side < EXTREMES; side++) {
        size_t v = e->at[side];
        while (v + 1 < e->at[side] + block && positions[3 * v + side % 3] != e->bound[side])
            v++;
        vertex[side] = (uint32_t)v;
    }
}

static bool is_among(uint32_t vertex, const uint32_t *corners, size_t count)
{
    uint32_t is_met = 0;
    for (size_t i = 0; i < count; i++)
        is_met |= corners[i] == vertex;
    return is_met;
}

unsigned vertex_extremes_meet(const uint32_t vertex[EXTREMES], const uint32_t *corners, size_t count, unsigned met)
{
    for (unsigned side = 0; side < EXTREMES; side++)
        if (!(met >> side & 1) && is_among(vertex[side], corners, count))
            met |= 1U << side;
    return met;
}
