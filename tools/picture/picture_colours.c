/* picture_colours.c - looks up the cells that are seen. */
#include "picture_colours.h"

#include "colours/cell_colours.h"

picture_colours picture_colours_of(const voxels *v, uint32_t factor)
{
    return (picture_colours){.v = v, .factor = factor, .curve = rgb_curve_make()};
}

static void add_row(const picture_colours *c, const uint32_t first[3], uint32_t j, uint32_t k, vec *sum, int *count)
{
    const tribox_grid *const grid = &c->v->grid;
    const uint64_t *const row = voxels_layer(c->v, k) + j * voxels_row_words(grid);
    for (uint32_t i = first[0]; i < first[0] + c->factor && i < grid->size[0]; i++)
        if (voxels_bit(row, i)) {
            const rgb colour = cell_colours_at(c->v->colours, (const uint32_t[3]){i, j, k});
            for (int a = 0; a < 3; a++)
                sum->at[a] += c->curve.light[colour.at[a]];
            ++*count;
        }
}

bool picture_colours_at(const picture_colours *c, const int cell[3], vec *colour)
{
    vec sum = {{0, 0, 0}};
    uint32_t first[3];
    int count = 0;
    if (cell[0] < 0 || cell[1] < 0 || cell[2] < 0)
        return false;
    for (int a = 0; a < 3; a++)
        first[a] = (uint32_t)cell[a] * c->factor;
    for (uint32_t k = first[2]; k < first[2] + c->factor && k < c->v->grid.size[2]; k++)
        for (uint32_t j = first[1]; j < first[1] + c->factor && j < c->v->grid.size[1]; j++)
            add_row(c, first, j, k, &sum, &count);
    for (int a = 0; a < 3 && count; a++)
        colour->at[a] = sum.at[a] / (float)count;
    return count;
}
