/*
 * voxelize.c - a soup into the cells of a grid: triangles sorted by the cells that their bounding boxes touch.
 *
 * The kernel finds those cells for a word of triangles at a time. If they are more than one on a single axis at most, the triangle
 * overlaps them all, as it is connected (PROOFS.md 7.4). The others wait in strips, one for each shape; the kernel limits them row
 * after row (voxel_rows.c). Cells that rounding leaves open are settled by their own boxes, unless they are already set.
 */
#include <math.h>

#include "environment.h"
#include "finite.h"
#include "grid_cells.h"
#include "voxel_rows.h"

/* One call. */
typedef struct voxelization {
    tribox_voxels voxels;
    tribox_lattice lattice;
    tribox_strip strips[TRIBOX_SHAPES]; /* triangles that wait for their rows */
} voxelization;

/* Sets the rows of a strip's triangles, and empties the strip. */
static void set_strip(voxelization *call, tribox_shape shape)
{
    const tribox_plan *const plan = &call->voxels.plan;
    tribox_strip *const strip = &call->strips[shape];
    tribox_limits limits;
    if (!strip->count)
        return;
    for (unsigned t = strip->count; t % TRIBOX_DOUBLES_MAX; t++) {
        for (int n = 0; n < 9; n++)
            strip->u[n][t] = strip->u[n][strip->count - 1];
        for (int a = 0; a < 3; a++) {
            strip->base[a][t] = strip->base[a][strip->count - 1];
            strip->cells[a][t] = strip->cells[a][strip->count - 1];
        }
    }
    plan->kernel->grid->prepare[shape](strip, &call->lattice, plan->axes, plan->accuracy == TRIBOX_FAST ? 0 : 1, &limits);
    for (unsigned t = 0; t < strip->count; t++)
        tribox_voxels_set_rows(&call->voxels, strip, t, shape, &limits);
    strip->count = 0;
}

/* Triangle i of the soup joins the strip of its shape. */
static void join_strip(voxelization *call, const tribox_soup *soup, size_t i, const tribox_touched *touched, tribox_shape shape)
{
    const unsigned lane = i % 64;
    tribox_strip *const strip = &call->strips[shape];
    const unsigned t = strip->count;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            strip->u[3 * a + j][t] = tribox_soup_axis(soup, a)[j][i];
        strip->base[a][t] = touched->base[a][lane];
        strip->cells[a][t] = touched->cells[a][lane];
    }
    strip->word[t] = touched->word[lane];
    strip->bit[t] = touched->bit[lane];
    if (++strip->count == TRIBOX_STRIP)
        set_strip(call, shape);
}

/* Where its box spans one cell on two axes, a triangle overlaps every cell that it spans on the third. */
static void set_line(tribox_voxels *v, const tribox_touched *touched, unsigned lane)
{
    const int64_t along = (int64_t)touched->cells[0][lane], rows = (int64_t)touched->cells[1][lane];
    const int64_t first_k = (int64_t)touched->base[2][lane], end_k = first_k + (int64_t)touched->cells[2][lane];
    size_t set = 0;
    for (int64_t k = tribox_greatest(first_k, v->first_layer); k < tribox_least(end_k, v->end_layer); k++) {
        uint64_t *row = v->occupied + touched->word[lane] + (k - first_k) * (int64_t)v->grid->size[1] * (int64_t)v->row_words;
        for (int64_t j = 0; j < rows; j++, row += v->row_words)
            set += tribox_set_cells(row, touched->bit[lane], touched->bit[lane] + along - 1);
    }
    v->counts.overlapping += set;
}

/* The cells that triangle i of the soup touches, where the kernel was not certain: from the planes themselves. */
static void touch_by_planes(const tribox_voxels *v, const tribox_soup *soup, size_t i, tribox_touched *touched, uint64_t *touching)
{
    const unsigned lane = i % 64;
    const uint64_t bit = UINT64_C(1) << lane;
    bool is_inside = true;
    int64_t base[3];
    for (int a = 0; a < 3; a++) {
        const float *const *const stream = tribox_soup_axis(soup, a);
        float least = stream[0][i], most = least;
        for (int j = 1; j < 3; j++) {
            least = stream[j][i] < least ? stream[j][i] : least;
            most = stream[j][i] > most ? stream[j][i] : most;
        }
        const tribox_cells cells = tribox_grid_cells(v->grid, a, least, most);
        const int64_t from = a == 2 ? v->first_layer : 0, end = a == 2 ? v->end_layer : v->grid->size[a];
        is_inside &= cells.first < end && cells.last >= from;
        base[a] = tribox_greatest(cells.first, 0);
        touched->base[a][lane] = (double)base[a];
        touched->cells[a][lane] = (double)(tribox_least(cells.last + 1, v->grid->size[a]) - base[a]);
        touched->spans[a] = cells.last > cells.first ? touched->spans[a] | bit : touched->spans[a] & ~bit;
    }
    touched->word[lane] =
        (int32_t)(((base[2] - v->first_layer) * v->grid->size[1] + base[1]) * (int64_t)v->row_words + base[0] / 64);
    touched->bit[lane] = (int32_t)(base[0] % 64);
    if (!is_inside)
        *touching &= ~bit;
}

static void set_word(voxelization *call, const tribox_soup *soup, size_t word)
{
    tribox_voxels *const v = &call->voxels;
    tribox_touched touched;
    uint64_t touching = v->plan.kernel->grid->touched(soup, word, &call->lattice, &touched);
    for (uint64_t left = touched.uncertain; left; left &= left - 1)
        touch_by_planes(v, soup, 64 * word + tribox_lowest_bit(left), &touched, &touching);
    const uint64_t x = touched.spans[0], y = touched.spans[1], z = touched.spans[2];

    size_t set = 0;
    for (uint64_t left = touching & ~(x | y | z); left; left &= left - 1) {
        const unsigned lane = tribox_lowest_bit(left);
        set += tribox_set_bits(v->occupied + touched.word[lane], UINT64_C(1) << touched.bit[lane]);
    }
    v->counts.overlapping += set;
    for (uint64_t left = touching & (x ^ y ^ z) & ~(x & y & z); left; left &= left - 1)
        set_line(v, &touched, tribox_lowest_bit(left));

    uint64_t shaped[TRIBOX_SHAPES] = {x & y & z, ~x & y & z, x & ~y & z, x & y & ~z};
    if (!(v->plan.axes & TRIBOX_AXES_EDGES)) { /* without edges a shadow has no limits: only the plane has */
        shaped[TRIBOX_SOLID] = (x & y) | (y & z) | (z & x);
        shaped[TRIBOX_FLAT_X] = shaped[TRIBOX_FLAT_Y] = shaped[TRIBOX_FLAT_Z] = 0;
    }
    for (tribox_shape shape = TRIBOX_SOLID; shape < TRIBOX_SHAPES; shape++)
        for (uint64_t left = touching & shaped[shape]; left; left &= left - 1)
            join_strip(call, soup, 64 * word + tribox_lowest_bit(left), &touched, shape);
}

static tribox_lattice lattice_of(const tribox_grid *grid, uint32_t first, uint32_t layers)
{
    tribox_lattice lattice = {
        .first_layer = first, .end_layer = (double)first + layers, .row_words = (double)tribox_grid_row_words(grid)};
    for (int a = 0; a < 3; a++) {
        const double lowest = tribox_grid_plane(grid, a, 0), highest = tribox_grid_plane(grid, a, grid->size[a]);
        const double farthest = -lowest > highest ? -lowest : highest;
        lattice.origin[a] = grid->origin[a];
        lattice.per_cell[a] = 1 / (double)grid->cell[a];
        lattice.size[a] = grid->size[a];
        /* planes: half a spacing of floats, and of doubles while they are made; places: three roundings in double. The
         * 0x1.001 alone would cover the other two terms (PROOFS.md 7.2). */
        lattice.error[a] = (0x1.001p-24 * farthest + 0x1p-149) * lattice.per_cell[a] + 0x1p-50 * (lattice.size[a] + 4);
    }
    return lattice;
}

static void set_soup(voxelization *call, const tribox_soup *soup)
{
    for (size_t word = 0; word < soup->count / 64; word++)
        set_word(call, soup, word);
    if (soup->count % 64) {
        float scratch[9][64];
        for (int k = 0; k < 9; k++)
            for (int i = 0; i < 64; i++)
                scratch[k][i] = NAN; /* not a triangle */
        const tribox_soup tail = tribox_soup_tail(soup, scratch);
        set_word(call, &tail, 0);
    }
    for (tribox_shape shape = TRIBOX_SOLID; shape < TRIBOX_SHAPES; shape++)
        set_strip(call, shape);
}

/* Without the box normals a triangle may overlap cells anywhere: every cell is tested by its own box. */
static void set_soup_by_cells(voxelization *call, const tribox_soup *soup)
{
    tribox_voxels *const v = &call->voxels;
    for (size_t t = 0; t < soup->count; t++) {
        float u[9];
        for (int k = 0; k < 9; k++)
            u[k] = tribox_soup_axis(soup, k / 3)[k % 3][t];
        const float triangle[3][3] = {{u[0], u[3], u[6]}, {u[1], u[4], u[7]}, {u[2], u[5], u[8]}};
        if (tribox_triangle_is_finite(triangle))
            for (int64_t k = v->first_layer; k < v->end_layer; k++)
                for (int64_t j = 0; j < v->grid->size[1]; j++)
                    tribox_voxels_add_open(v, u, 0, (int64_t)v->grid->size[0] - 1, j, k);
    }
}

tribox_status tribox_voxelize_layers(const tribox_soup *soup, const tribox_grid *grid, uint32_t first, uint32_t layers,
                                     const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    voxelization call;
    tribox_voxels *const v = &call.voxels;
    if (!grid || !occupied || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = tribox_plan_make(options, &v->plan);
    if (status)
        return status;

    const tribox_environment callers = tribox_environment_enter();
    const bool is_sound = tribox_grid_is_sound(grid),
               has_layers = is_sound && first <= grid->size[2] && layers <= grid->size[2] - first;
    if (has_layers) {
        v->grid = grid;
        v->first_layer = first;
        v->end_layer = (int64_t)first + layers;
        v->row_words = tribox_grid_row_words(grid);
        v->occupied = occupied;
        v->counts = (tribox_report){0, 0};
        v->open = 0;
        call.lattice = lattice_of(grid, first, layers);
        for (tribox_shape shape = TRIBOX_SOLID; shape < TRIBOX_SHAPES; shape++)
            call.strips[shape].count = 0;
        (v->plan.axes & TRIBOX_AXES_BOX ? set_soup : set_soup_by_cells)(&call, soup);
        tribox_voxels_settle_open(v);
        tribox_plan_report(&v->plan, v->counts, report);
    }
    tribox_environment_leave(callers);
    return has_layers ? TRIBOX_OK : is_sound ? TRIBOX_BAD_ARGUMENT : TRIBOX_BAD_GRID;
}

tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options, uint64_t *occupied,
                              tribox_report *report)
{
    return tribox_voxelize_layers(soup, grid, 0, grid ? grid->size[2] : 0, options, occupied, report);
}
