/* fans.c - finds the fans of all 256 ways in which cells meet in a point. */
#include "fans.h"

#include <stdbool.h>
#include <string.h>

enum { FACES = 12, NONE = 255 };

/* The number of the face across an axis of the cell at a side. */
static unsigned face_of(int axis, unsigned side)
{
    const unsigned low = side & ((1U << axis) - 1), high = side >> (axis + 1);
    return 4 * (unsigned)axis + (low | high << axis);
}

static bool has(unsigned around, unsigned side) { return around >> side & 1; }

static void join(uint8_t fan[FACES], unsigned a, unsigned b)
{
    const uint8_t from = fan[b];
    for (int f = 0; f < FACES; f++)
        if (fan[f] == from)
            fan[f] = fan[a];
}

/* The edge from the point along an axis, `end` 0 or 1: its four cells, one after the other around it. */
static void join_at_edge(unsigned around, int axis, unsigned end, uint8_t fan[FACES])
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const unsigned U = 1U << u, V = 1U << v, base = end << axis;
    const unsigned cell[4] = {base, base | U, base | U | V, base | V};
    unsigned face[4], faces = 0;
    for (int n = 0; n < 4; n++) /* face n is between cells n and n + 1 */
        if (has(around, cell[n]) != has(around, cell[(n + 1) % 4]))
            face[faces++] = face_of(n % 2 ? v : u, cell[n]);
    if (faces == 2)
        join(fan, face[0], face[1]);
    if (faces != 4)
        return;
    const int first = has(around, cell[0]) ? 3 : 0; /* faces n and n + 1 are those of cell n + 1 */
    join(fan, face[first], face[(first + 1) % 4]);
    join(fan, face[(first + 2) % 4], face[(first + 3) % 4]);
}

static void find(unsigned around, uint8_t *count, uint8_t of[FACES])
{
    uint8_t fan[FACES], number[FACES];
    for (int f = 0; f < FACES; f++)
        fan[f] = (uint8_t)f;
    for (int axis = 0; axis < 3; axis++)
        for (unsigned end = 0; end < 2; end++)
            join_at_edge(around, axis, end, fan);
    memset(number, NONE, sizeof number);
    *count = 0;
    for (int axis = 0; axis < 3; axis++)
        for (unsigned side = 0; side < 8; side++)
            if (!(side >> axis & 1) && has(around, side) != has(around, side | 1U << axis)) {
                const unsigned face = face_of(axis, side);
                if (number[fan[face]] == NONE)
                    number[fan[face]] = (*count)++;
                of[face] = number[fan[face]];
            }
}

void fans_make(fans *f)
{
    memset(f, 0, sizeof *f);
    for (unsigned around = 0; around < 256; around++)
        find(around, &f->count[around], f->of[around]);
}
