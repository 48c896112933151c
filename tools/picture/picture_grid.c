/* picture_grid.c - reduces voxels that are finer than pixels, and measures the empty space around them. */
#include "picture_grid.h"

#include <stdlib.h>
#include <string.h>

/* Cells along the longest side, beyond which some are joined, and the words of a copy, beyond which more are. */
enum { SIDE_MOST = 1536, COPY_WORDS_MOST = 7 << 20 };

static tribox_grid reduced(const tribox_grid *grid, uint32_t factor)
{
    tribox_grid g = *grid;
    for (int a = 0; a < 3; a++) {
        g.size[a] = (g.size[a] - 1) / factor + 1;
        g.cell[a] *= (float)factor;
    }
    return g;
}

/* How many cells along each axis become one. */
static uint32_t factor_for(const tribox_grid *grid, bool is_copied)
{
    for (uint32_t factor = 1;; factor++) {
        const tribox_grid g = reduced(grid, factor);
        const bool is_small = g.size[0] <= SIDE_MOST && g.size[1] <= SIDE_MOST && g.size[2] <= SIDE_MOST;
        if (is_small && (tribox_grid_words(&g) <= COPY_WORDS_MOST || (factor == 1 && !is_copied)))
            return factor;
    }
}

static size_t bricks_of(const tribox_grid *grid, int bricks[3])
{
    size_t count = 1;
    for (int a = 0; a < 3; a++) {
        bricks[a] = ((int)grid->size[a] + BRICK - 1) / BRICK;
        count *= (size_t)bricks[a];
    }
    return count;
}

uint64_t picture_grid_memory(const tribox_grid *grid)
{
    int bricks[3];
    const tribox_grid direct = reduced(grid, factor_for(grid, false)), copied = reduced(grid, factor_for(grid, true));
    return bricks_of(&direct, bricks) + tribox_grid_words(&copied) * sizeof(uint64_t);
}

static void reduce_row(const uint64_t *row, uint32_t cells, uint32_t factor, uint64_t *to)
{
    for (uint32_t i = 0; i < cells; i++)
        if (voxels_bit(row, i))
            to[i / factor / 64] |= UINT64_C(1) << i / factor % 64;
}

static void copy_reduced(const voxels *v, uint32_t factor, picture_grid *g)
{
    const size_t row_words = tribox_grid_row_words(&v->grid);
    for (uint32_t k = 0; k < v->grid.size[2]; k++) {
        const uint64_t *row = voxels_layer(v, k);
        for (uint32_t j = 0; j < v->grid.size[1]; j++, row += row_words)
            if (voxels_count(row, row_words))
                reduce_row(row, v->grid.size[0], factor,
                           g->copy + ((size_t)(k / factor) * (size_t)g->size[1] + j / factor) * g->row_words);
    }
}

static void include(picture_grid *g, int a, int from, int to)
{
    g->lo[a] = from < g->lo[a] ? from : g->lo[a];
    g->hi[a] = to > g->hi[a] ? to : g->hi[a];
}

/* Marks the bricks of a row, eight cells a byte, and widens the bounds. */
static void mark_row(picture_grid *g, int j, int k)
{
    const uint64_t *row = picture_grid_row(g, j, k);
    unsigned char *away = g->away + ((size_t)(k / BRICK) * (size_t)g->bricks[1] + (size_t)(j / BRICK)) * (size_t)g->bricks[0];
    for (int w = 0; w < (int)g->row_words; w++)
        for (int b = 0; b < 8 && row[w] >> 8 * b; b++) {
            const unsigned cells = row[w] >> 8 * b & 255;
            if (!cells)
                continue;
            int first = 0, last = 7;
            while (!(cells >> first & 1))
                first++;
            while (!(cells >> last & 1))
                last--;
            away[8 * w + b] = 0;
            include(g, 0, 64 * w + 8 * b + first, 64 * w + 8 * b + last + 1);
            include(g, 1, j, j + 1);
            include(g, 2, k, k + 1);
        }
}

static void find_cells(picture_grid *g, size_t bricks)
{
    memset(g->away, 255, bricks);
    memcpy(g->lo, g->size, sizeof g->lo);
    memset(g->hi, 0, sizeof g->hi);
    for (int k = 0; k < g->size[2]; k++)
        for (int j = 0; j < g->size[1]; j++)
            mark_row(g, j, k);
    for (int a = 0; a < 3; a++)
        g->lo[a] = g->lo[a] < g->hi[a] ? g->lo[a] : 0;
}

/* The neighbours that come before a brick in memory, or behind it: one more than the least of them is enough. */
static void spread_from(picture_grid *g, const int at[3], size_t index, int side)
{
    int least = g->away[index];
    for (int n = 0; n < 13; n++) {
        const int d[3] = {side * (n % 3 - 1), side * (n / 3 % 3 - 1), side * (n / 9 - 1)};
        size_t other = index;
        bool is_inside = true;
        for (int a = 2; a >= 0; a--)
            is_inside &= at[a] + d[a] >= 0 && at[a] + d[a] < g->bricks[a];
        if (!is_inside)
            continue;
        other += (size_t)(d[0] + g->bricks[0] * (d[1] + g->bricks[1] * d[2]));
        least = g->away[other] + 1 < least ? g->away[other] + 1 : least;
    }
    g->away[index] = (unsigned char)least;
}

/* Two sweeps, forwards and backwards, are exact for distances along the farthest axis. */
static void measure_space(picture_grid *g, size_t bricks)
{
    for (int side = 1; side >= -1; side -= 2)
        for (size_t n = 0; n < bricks; n++) {
            const size_t index = side > 0 ? n : bricks - 1 - n;
            const size_t row = index / (size_t)g->bricks[0];
            const int at[3] = {(int)(index % (size_t)g->bricks[0]), (int)(row % (size_t)g->bricks[1]),
                               (int)(row / (size_t)g->bricks[1])};
            if (g->away[index])
                spread_from(g, at, index, side);
        }
}

bool picture_grid_make(const voxels *v, picture_grid *g)
{
    const bool is_copied = v->slabs != 1;
    const uint32_t factor = factor_for(&v->grid, is_copied);
    const tribox_grid grid = reduced(&v->grid, factor);
    const size_t bricks = bricks_of(&grid, g->bricks);
    g->row_words = tribox_grid_row_words(&grid);
    for (int a = 0; a < 3; a++) {
        g->size[a] = (int)grid.size[a];
        g->cell[a] = (double)grid.cell[a];
    }
    g->copy = is_copied || factor > 1 ? calloc(tribox_grid_words(&grid), sizeof *g->copy) : NULL;
    g->bits = g->copy ? g->copy : v->slab[0].bits;
    g->away = malloc(bricks);
    if (!g->away || (!g->copy && (is_copied || factor > 1))) {
        picture_grid_free(g);
        return false;
    }
    if (g->copy)
        copy_reduced(v, factor, g);
    find_cells(g, bricks);
    measure_space(g, bricks);
    return true;
}

void picture_grid_free(picture_grid *g)
{
    free(g->copy);
    free(g->away);
}
