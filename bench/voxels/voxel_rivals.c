/* voxel_rivals.c - the paper's test for each cell, and the voxelization of Schwarz and Seidel. */
#include "voxel_rivals.h"

#include <math.h>

#include "paper/paper.h"
#include "paper/paper_axes.h"

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
