/* picture_normal.c - the direction in which the cells around a cell spread least. */
#include "picture_normal.h"

enum { REACH = 3, WIDTH = 2 * REACH + 1, POWER_STEPS = 8 };

/* Sums over cells: how many, their offsets, and the products of those. */
typedef struct spread {
    double count, sum[3], product[3][3];
} spread;

/* Bit REACH + d: the cell d to the right is occupied. */
static unsigned row_around(const picture_grid *g, const int cell[3], int j, int k)
{
    if (j < 0 || j >= g->size[1] || k < 0 || k >= g->size[2])
        return 0;
    const uint64_t *row = picture_grid_row(g, j, k);
    const int first = cell[0] - REACH, start = first < 0 ? 0 : first, word = start / 64;
    uint64_t bits = row[word] >> start % 64;
    if (start % 64 && (size_t)word + 1 < g->row_words)
        bits |= row[word + 1] << (64 - start % 64);
    return (unsigned)(bits << (start - first)) & ((1u << WIDTH) - 1);
}

static void add_row(spread *s, unsigned bits, double y, double z)
{
    double count = 0, sum = 0, square = 0;
    for (int d = -REACH; d <= REACH; d++)
        if (bits >> (REACH + d) & 1) {
            count++;
            sum += d;
            square += d * d;
        }
    s->count += count;
    s->sum[0] += sum;
    s->sum[1] += count * y;
    s->sum[2] += count * z;
    s->product[0][0] += square;
    s->product[0][1] += sum * y;
    s->product[0][2] += sum * z;
    s->product[1][1] += count * y * y;
    s->product[1][2] += count * y * z;
    s->product[2][2] += count * z * z;
}

vec picture_normal(const picture_grid *g, const int cell[3], vec face, vec direction)
{
    spread s = {.count = 0};
    double m[3][3], trace = 0;
    for (int z = -REACH; z <= REACH; z++)
        for (int y = -REACH; y <= REACH; y++) {
            const unsigned bits = row_around(g, cell, cell[1] + y, cell[2] + z);
            if (bits)
                add_row(&s, bits, y, z);
        }
    for (int a = 0; a < 3; a++)
        for (int b = a; b < 3; b++)
            m[b][a] = m[a][b] = (s.product[a][b] - s.sum[a] * s.sum[b] / s.count) * g->cell[a] * g->cell[b];
    for (int a = 0; a < 3; a++)
        trace += m[a][a];
    /* Where the spread is least, the trace less the spread is greatest: what repeated multiplication tends to. */
    vec n = vec_sum(1, face, -0.5, direction);
    double greatest = 0;
    for (int i = 0; i < POWER_STEPS && trace > 0; i++) {
        vec next;
        for (int a = 0; a < 3; a++)
            next.at[a] = trace * n.at[a] - m[a][0] * n.at[0] - m[a][1] * n.at[1] - m[a][2] * n.at[2];
        greatest = sqrt(vec_dot(next, next));
        n = greatest > 0 ? vec_unit(next) : n;
    }
    n = vec_dot(n, direction) > 0 ? vec_sum(-1, n, 0, n) : n;
    /* Steps of a plane lie within a cell of it; where cells spread farther, or the plane
       shows its other side, there is an edge, whose faces are to be seen. */
    const double spread_most = 1.0, spread_least = 0.45, least = (trace - greatest) / s.count / (g->cell[0] * g->cell[0]);
    const double flatness = (spread_most - least) / (spread_most - spread_least), side = 1 + vec_dot(n, face) / 0.3;
    const double trust = fmin(fmax(fmin(flatness, side), 0), 1);
    return vec_unit(vec_sum(trust, n, 1 - trust + 1e-3, face));
}
