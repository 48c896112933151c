/*
 * voxel_strips.c - triangles that the kernel takes one by one, row after row: they wait in strips, one for each shape.
 *
 * Of those that the kernel's float cannot tell the cells, the planes of the grid do.
 */
#include "voxelizing.h"

#include "base/finite.h"

/* The rows of a strip's triangles, and empties it. Lanes up to a whole packet repeat the last triangle. */
static void set_full_strip(tribox_voxels *v, tribox_shape shape)
{
    tribox_strip *const strip = &v->sinks.strip[shape];
    for (unsigned t = strip->count; t % TRIBOX_DOUBLES_MAX; t++) {
        for (int n = 0; n < 9; n++)
            strip->u[n][t] = strip->u[n][strip->count - 1]; /* numbers are not read */
        for (int a = 0; a < 3; a++) {
            strip->base[a][t] = strip->base[a][strip->count - 1];
            strip->cells[a][t] = strip->cells[a][strip->count - 1];
        }
    }
    v->plan.kernel->rows->set_strip[shape](v);
    strip->count = 0;
}

void tribox_voxels_set_strips(tribox_voxels *v)
{
    for (tribox_shape shape = TRIBOX_SOLID; shape < TRIBOX_SHAPES; shape++)
        if (v->sinks.strip[shape].count)
            set_full_strip(v, shape);
}

static void join(tribox_voxels *v, const tribox_triangle *triangle, const int64_t base[3], const int64_t cells[3],
                 tribox_shape shape)
{
    tribox_strip *const strip = &v->sinks.strip[shape];
    const int64_t layer = tribox_greatest(base[2], v->window.first_layer) - v->window.first_layer;
    const unsigned t = strip->count;
    for (int n = 0; n < 9; n++)
        strip->u[n][t] = triangle->u[n];
    strip->number[t] = triangle->number;
    for (int a = 0; a < 3; a++) {
        strip->base[a][t] = (double)base[a];
        strip->cells[a][t] = (double)cells[a];
    }
    /* Of the window, which has 2^31 words at most: the grid may have more, and the triangle begin far below (PROOFS.md 7.8). */
    strip->word[t] = (int32_t)((layer * v->window.size[1] + base[1]) * (int64_t)v->sinks.row_words + base[0] / 64);
    strip->bit[t] = (int32_t)(base[0] % 64);
    if (++strip->count == TRIBOX_STRIP)
        set_full_strip(v, shape);
}

/* Of a line of cells from cell `first` of the row that begins with word `row`: more than one on one axis at most. */
static void name_line(tribox_voxels *v, size_t row, int64_t first, const size_t cells[3], int32_t number)
{
    const int64_t last = first + (int64_t)cells[0] - 1;
    for (size_t k = 0; k < cells[2]; k++)
        for (size_t j = 0; j < cells[1]; j++) {
            const size_t at = row + (k * v->window.size[1] + j) * v->sinks.row_words;
            if (v->sinks.pairs)
                tribox_voxels_pair_row(v, at, first, last, number);
            else
                tribox_lower_row(&v->sinks.ids, v->sinks.occupied, at, first, last, tribox_voxels_id(v, number));
        }
}

/* Where its box spans one cell on two axes, a triangle overlaps every cell that it spans on the third. */
static void set_line(tribox_voxels *v, const tribox_triangle *triangle, const int64_t base[3], const int64_t cells[3])
{
    const int64_t from = tribox_greatest(base[2], v->window.first_layer),
                  end = tribox_least(base[2] + cells[2], v->window.end_layer);
    const size_t layer_words = v->sinks.row_words * v->window.size[1];
    const size_t first = (size_t)(from - v->window.first_layer) * layer_words + (size_t)base[1] * v->sinks.row_words;
    const uint64_t bit = UINT64_C(1) << base[0] % 64;
    if (v->sinks.ids.of || v->sinks.pairs)
        name_line(v, first, base[0], (const size_t[3]){(size_t)cells[0], (size_t)cells[1], (size_t)(end - from)}, triangle->number);
    if (v->sinks.pairs)
        return;
    uint64_t *const row = v->sinks.occupied + first;
    if (cells[0] > 1)
        v->counts.overlapping += tribox_set_cells(row, base[0], base[0] + cells[0] - 1);
    else if (cells[1] > 1)
        v->counts.overlapping += tribox_set_column(row + base[0] / 64, v->sinks.row_words, cells[1], bit);
    else
        v->counts.overlapping += tribox_set_column(row + base[0] / 64, layer_words, end - from, bit);
}

/* By the axes on which the box spans more than one cell, even if some lie outside the grid (kernel_voxels.h). */
static tribox_shape shape_of(const bool spans[3], unsigned axes)
{
    if (!(axes & TRIBOX_AXES_EDGES)) /* without edges a shadow has no limits: only the plane has */
        return TRIBOX_SOLID;
    return !spans[0] ? TRIBOX_FLAT_X : !spans[1] ? TRIBOX_FLAT_Y : !spans[2] ? TRIBOX_FLAT_Z : TRIBOX_SOLID;
}

/*
 * Whether limits in double are right about a triangle: edges are zero or of a size, in cells, whose products neither
 * overflow nor vanish (PROOFS.md 7.10).
 */
static bool has_limits(const tribox_voxels *v, const double u[9])
{
    bool has = v->window.has_limits;
    if (v->window.has_all_limits)
        return true;
    for (int a = 0; a < 3; a++)
        for (int j = 0; j < 3; j++) {
            const double f = u[3 * a + (j + 1) % 3] - u[3 * a + j], size = (f < 0 ? -f : f) * v->window.lattice.per_cell[a];
            has &= !(f < 0 || f > 0) || (size >= 0x1p-250 && size <= 0x1p250);
        }
    return has;
}

void tribox_voxels_take_triangle(tribox_voxels *v, const tribox_triangle *triangle, const tribox_cell_range *range)
{
    if (range->spans[0] + range->spans[1] + range->spans[2] < 2)
        set_line(v, triangle, range->base, range->cells);
    else if (!has_limits(v, triangle->u))
        tribox_voxels_ask_blocks(v, triangle, range);
    else
        join(v, triangle, range->base, range->cells, shape_of(range->spans, v->plan.axes));
}

void tribox_voxels_add_triangle(tribox_voxels *v, const tribox_triangle *triangle)
{
    const double *const u = triangle->u;
    tribox_cell_range range;
    if (!tribox_are_finite_doubles(u, 9))
        return;
    for (int a = 0; a < 3; a++) {
        double least = u[3 * a], most = least;
        for (int j = 1; j < 3; j++) {
            least = u[3 * a + j] < least ? u[3 * a + j] : least;
            most = u[3 * a + j] > most ? u[3 * a + j] : most;
        }
        const tribox_cells touched = tribox_planes_cells(&v->window.planes, a, v->window.size[a], least, most);
        const int64_t from = a == 2 ? v->window.first_layer : 0, end = a == 2 ? v->window.end_layer : v->window.size[a];
        if (touched.first >= end || touched.last < from)
            return;
        range.spans[a] = touched.last > touched.first;
        range.base[a] = tribox_greatest(touched.first, 0);
        range.cells[a] = tribox_least(touched.last + 1, v->window.size[a]) - range.base[a];
    }
    tribox_voxels_take_triangle(v, triangle, &range);
}
