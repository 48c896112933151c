#include "common/grid_planes.h"

#include <math.h>

#include "contact.h"

float grid_planes_place(const tribox_grid *grid, int axis, double p)
{
    return nearest_float(fma(p, grid->cell[axis], grid->origin[axis]));
}

bool grid_planes_make(grid_planes *l, const tribox_grid *grid)
{
    l->grid = *grid;
    for (int a = 0; a < 3; a++) {
        if (grid->size[a] > GRID_PLANES_CELLS)
            return false;
        for (uint32_t p = 0; p <= grid->size[a]; p++) {
            l->plane[a][p] = fma(p, grid->cell[a], grid->origin[a]);
            if (!isfinite(l->plane[a][p]) || (p && !(l->plane[a][p] > l->plane[a][p - 1])))
                return false;
        }
    }
    l->row_words = (grid->size[0] + 63) / 64;
    l->words = l->row_words * grid->size[1] * grid->size[2];
    return true;
}

tribox_box grid_planes_cell(const grid_planes *l, int i, int j, int k)
{
    const int at[3] = {i, j, k};
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = l->plane[a][at[a]];
        box.hi[a] = l->plane[a][at[a] + 1];
    }
    return box;
}

void grid_planes_range(const grid_planes *l, int axis, float least, float most, int *first, int *last)
{
    const int size = (int)l->grid.size[axis];
    const double *const plane = l->plane[axis];
    *first = size;
    *last = -1;
    for (int c = 0; c < size; c++)
        if (plane[c] <= most && plane[c + 1] >= least) {
            *first = c < *first ? c : *first;
            *last = c;
        }
}

void grid_planes_print(FILE *out, const tribox_grid *grid)
{
    for (int a = 0; a < 3; a++)
        fprintf(out, "  %c   origin %a, cell %a, size %u\n", "xyz"[a], grid -> origin[a], grid -> cell[a],
                (unsigned)grid -> size[a]);
}
