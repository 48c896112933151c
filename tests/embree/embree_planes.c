#include "embree_planes.h"

#include <math.h>

bool planes_make(grid_planes *p, const tribox_grid *grid)
{
    if (!grid_planes_make(p, grid))
        return false;
    for (int a = 0; a < 3; a++)
        for (uint32_t c = 0; c < grid->size[a]; c++) {
            const tribox_box cell = tribox_grid_cell(grid, a == 0 ? c : 0, a == 1 ? c : 0, a == 2 ? c : 0);
            if (cell.lo[a] != p->plane[a][c] || cell.hi[a] != p->plane[a][c + 1] || cell.hi[a] != (double)(float)cell.hi[a])
                return false;
        }
    return true;
}

/* How many planes of an axis lie below x, or at it if it is closed. */
static int planes_below(const grid_planes *p, int axis, double x, bool is_closed)
{
    int below = 0, above = (int)p->grid.size[axis] + 1;
    while (below < above) {
        const int middle = (below + above) / 2;
        const double plane = p->plane[axis][middle];
        if (plane < x || (is_closed && plane == x))
            below = middle + 1;
        else
            above = middle;
    }
    return below;
}

span planes_met(const grid_planes *p, int axis, double least, double most)
{
    const int below = planes_below(p, axis, least, false), until = planes_below(p, axis, most, true);
    return (span){below > 0 ? below - 1 : 0, until <= (int)p->grid.size[axis] ? until - 1 : (int)p->grid.size[axis] - 1};
}

block planes_candidates(const grid_planes *p, const triangle *t)
{
    block b;
    for (int a = 0; a < 3; a++) {
        const float least = fminf(fminf(t->u[0][a], t->u[1][a]), t->u[2][a]);
        const float most = fmaxf(fmaxf(t->u[0][a], t->u[1][a]), t->u[2][a]);
        const span met = planes_met(p, a, (double)least, (double)most);
        b.first[a] = met.first > 0 ? met.first - 1 : 0;
        const int last = met.last + 1 < (int)p->grid.size[a] ? met.last + 1 : (int)p->grid.size[a] - 1;
        b.count[a] = last >= b.first[a] ? last - b.first[a] + 1 : 0;
    }
    return b;
}

bool block_has(const block *b, const int cell[3])
{
    bool is_in = true;
    for (int a = 0; a < 3; a++)
        is_in = is_in && cell[a] >= b->first[a] && cell[a] < b->first[a] + b->count[a];
    return is_in;
}

size_t block_number(const block *b, const int cell[3])
{
    const int i = cell[0] - b->first[0], j = cell[1] - b->first[1], k = cell[2] - b->first[2];
    return ((size_t)k * (size_t)b->count[1] + (size_t)j) * (size_t)b->count[0] + (size_t)i;
}

void block_cell(const block *b, size_t number, int cell[3])
{
    const size_t row = number / (size_t)b->count[0];
    cell[0] = b->first[0] + (int)(number % (size_t)b->count[0]);
    cell[1] = b->first[1] + (int)(row % (size_t)b->count[1]);
    cell[2] = b->first[2] + (int)(row / (size_t)b->count[1]);
}

size_t planes_bit(const grid_planes *p, const int cell[3])
{
    return 64 * grid_planes_word(p, cell[0], cell[1], cell[2]) + (size_t)cell[0] % 64;
}
