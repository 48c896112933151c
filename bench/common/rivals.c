/* rivals.c - what tribox is measured against, with the best that this compiler can do for this processor. */
#include "rivals.h"

#include <math.h>
#include <string.h>

#include "paper/paper.h"
#include "paper/paper_axes.h"

/* ---- what memory alone allows: loads, and nothing else ----------------------------------------------------------------------- */

/* Integers, since the compiler may not reorder a sum of floats, and so may not put it into vectors. */
uint32_t loads_words(const void *words, size_t count)
{
    uint32_t all = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t word;
        memcpy(&word, (const char *)words + 4 * i, sizeof word);
        all ^= word;
    }
    return all;
}

uint32_t loads_all(const tribox_soup *soup)
{
    uint32_t all = 0;
    for (int v = 0; v < 3; v++)
        all ^= loads_words(soup->x[v], soup->count) ^ loads_words(soup->y[v], soup->count) ^ loads_words(soup->z[v], soup->count);
    return all;
}

/* ---- the paper's test for compilers to vectorize ----------------------------------------------------------------------------- */

/*
 * Thirteen axes over nine streams, 64 triangles at a time. After the box normals it asks whether any of the 64 is left; there is no
 * other branch, and no intrinsic: layout and compiler alone.
 */
enum { BLOCK = 64 };

/* 1 for each triangle that nothing separates so far. */
typedef struct block {
    float v[3][3][BLOCK]; /* v[j][a]: axis a of vertex j, seen from the centre */
    uint32_t is_left[BLOCK];
} block;

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
            is_left &= (uint32_t)(min2(min2(p, q), r) <= h[a]) & (uint32_t)(max2(max2(p, q), r) >= -h[a]);
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
    return (uint32_t)(min2(p, q) <= r) & (uint32_t)(max2(p, q) >= -r);
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

/* ---- voxels in float, cell by cell and by Schwarz and Seidel ----------------------------------------------------------------- */

/* A grid as these ways take it. */
typedef struct float_grid {
    float origin[3], cell[3];
    const uint32_t *size;
} float_grid;

static float_grid rounded(const tribox_grid *grid)
{
    float_grid narrow = {.size = grid->size};
    for (int a = 0; a < 3; a++) {
        narrow.origin[a] = (float)grid->origin[a];
        narrow.cell[a] = (float)grid->cell[a];
    }
    return narrow;
}

/* The cells of a triangle's bounding box, first to last on each axis. */
typedef struct cell_range {
    int first[3], last[3], axes_spanned;
} cell_range;

static cell_range range_of(const float_grid *grid, const float v[3][3])
{
    cell_range range = {.axes_spanned = 0};
    for (int a = 0; a < 3; a++) {
        const float least = fminf(fminf(v[0][a], v[1][a]), v[2][a]), most = fmaxf(fmaxf(v[0][a], v[1][a]), v[2][a]);
        const int end = (int)grid->size[a] - 1;
        range.first[a] = least < 0 ? 0 : (int)least < end ? (int)least : end;
        range.last[a] = most < 0 ? 0 : (int)most < end ? (int)most : end;
        range.axes_spanned += range.last[a] > range.first[a];
    }
    return range;
}

/* The vertices in cells from the grid's corner. */
static void place(const float_grid *grid, const float u[3][3], float v[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            v[j][a] = (u[j][a] - grid->origin[a]) / grid->cell[a];
}

static uint64_t *row_of(const float_grid *grid, uint64_t *occupied, int j, int k)
{
    return occupied + ((size_t)k * grid->size[1] + (size_t)j) * ((grid->size[0] + 63) / 64);
}

/* Called for each cell, as the published code is: a function of a box and a triangle. */
#if defined(__GNUC__)
__attribute__((noinline))
#endif
static bool
overlaps(const float center[3], const float half[3], const float triangle[3][3])
{
    return paper_overlaps(center, half, triangle, PAPER_ORDER);
}

void voxelize_cell_by_cell(const tribox_grid *of_doubles, const float (*triangles)[3][3], size_t count, uint64_t *occupied)
{
    const float_grid of_floats = rounded(of_doubles), *const grid = &of_floats;
    const float half[3] = {grid->cell[0] / 2, grid->cell[1] / 2, grid->cell[2] / 2};
    for (size_t t = 0; t < count; t++) {
        float v[3][3];
        place(grid, triangles[t], v);
        const cell_range range = range_of(grid, (const float(*)[3])v);
        for (int k = range.first[2]; k <= range.last[2]; k++)
            for (int j = range.first[1]; j <= range.last[1]; j++) {
                uint64_t *const row = row_of(grid, occupied, j, k);
                for (int i = range.first[0]; i <= range.last[0]; i++) {
                    const int at[3] = {i, j, k};
                    float center[3];
                    for (int a = 0; a < 3; a++)
                        center[a] = grid->origin[a] + ((float)at[a] + 0.5f) * grid->cell[a];
                    row[i / 64] |= (uint64_t)overlaps(center, half, triangles[t]) << i % 64;
                }
            }
    }
}

/* The set-up of a triangle, in cells: an edge function is a x + b y + c with (x, y) the axes after i, for the corner of a cell. */
typedef struct set_up {
    float n[3], d[2];                /* plane, at the two critical points */
    float a[3][3], b[3][3], c[3][3]; /* [i][j]: of edge j in the projection along axis i */
} set_up;

static set_up set_up_of(const float v[3][3])
{
    set_up s;
    float e[3][3];
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            e[j][a] = v[(j + 1) % 3][a] - v[j][a];
    s.d[0] = s.d[1] = 0;
    for (int i = 0; i < 3; i++) {
        const int x = (i + 1) % 3, y = (i + 2) % 3;
        s.n[i] = e[0][x] * e[1][y] - e[0][y] * e[1][x];
        const float critical = s.n[i] > 0;
        s.d[0] += s.n[i] * (critical - v[0][i]);
        s.d[1] += s.n[i] * (1 - critical - v[0][i]);
        const float side = s.n[i] < 0 ? -1.0f : 1.0f;
        for (int j = 0; j < 3; j++) {
            s.a[i][j] = -e[j][y] * side;
            s.b[i][j] = e[j][x] * side;
            s.c[i][j] = fmaxf(0, s.a[i][j]) + fmaxf(0, s.b[i][j]) - s.a[i][j] * v[j][x] - s.b[i][j] * v[j][y];
        }
    }
    return s;
}

/* The bits of a row's cells that pass: those of one word at a time. `thin`: the axis on which the box is one cell thick, or 3. */
static inline void set_row(const set_up *s, const cell_range *range, int j, int k, int thin, uint64_t *row)
{
    const float y = (float)j, z = (float)k, plane = s->n[1] * y + s->n[2] * z;
    float zx[3], xy[3];
    for (int e = 0; e < 3; e++) {
        zx[e] = s->a[1][e] * z + s->c[1][e];
        xy[e] = s->b[2][e] * y + s->c[2][e];
    }
    for (int word = range->first[0] / 64; word <= range->last[0] / 64; word++) {
        const int from = word * 64 > range->first[0] ? word * 64 : range->first[0];
        const int last = word * 64 + 63 < range->last[0] ? word * 64 + 63 : range->last[0];
        uint64_t bits = 0;
        for (int i = from; i <= last; i++) {
            const float x = (float)i, p = plane + s->n[0] * x;
            bool is_set = thin < 3 || (p + s->d[0]) * (p + s->d[1]) <= 0;
            for (int e = 0; e < 3; e++) {
                if (thin == 1 || thin == 3)
                    is_set &= zx[e] + s->b[1][e] * x >= 0;
                if (thin == 2 || thin == 3)
                    is_set &= xy[e] + s->a[2][e] * x >= 0;
            }
            bits |= (uint64_t)is_set << i % 64;
        }
        row[word] |= bits;
    }
}

static inline void set_rows(const float_grid *grid, const set_up *s, const cell_range *range, int thin, uint64_t *occupied)
{
    for (int k = range->first[2]; k <= range->last[2]; k++)
        for (int j = range->first[1]; j <= range->last[1]; j++) {
            bool is_inside = true;
            for (int e = 0; e < 3 && (thin == 0 || thin == 3); e++)
                is_inside &= s->a[0][e] * (float)j + s->b[0][e] * (float)k + s->c[0][e] >= 0;
            if (is_inside)
                set_row(s, range, j, k, thin, row_of(grid, occupied, j, k));
        }
}

static int thin_axis(const cell_range *range)
{
    for (int a = 0; a < 3; a++)
        if (range->first[a] == range->last[a])
            return a;
    return 3;
}

void voxelize_schwarz_seidel(const tribox_grid *of_doubles, const float (*triangles)[3][3], size_t count, uint64_t *occupied)
{
    const float_grid of_floats = rounded(of_doubles), *const grid = &of_floats;
    for (size_t t = 0; t < count; t++) {
        float v[3][3];
        place(grid, triangles[t], v);
        const cell_range range = range_of(grid, (const float(*)[3])v);
        if (range.axes_spanned > 1) {
            const set_up s = set_up_of((const float(*)[3])v);
            set_rows(grid, &s, &range, thin_axis(&range), occupied);
            continue;
        }
        for (int k = range.first[2]; k <= range.last[2]; k++)
            for (int j = range.first[1]; j <= range.last[1]; j++)
                for (int i = range.first[0]; i <= range.last[0]; i++)
                    row_of(grid, occupied, j, k)[i / 64] |= UINT64_C(1) << i % 64;
    }
}
