#include "planes.h"

#include <math.h>

static tribox_box library_cell(const tribox_grid *grid, int axis, uint32_t c)
{
    return tribox_grid_cell(grid, axis == 0 ? c : 0, axis == 1 ? c : 0, axis == 2 ? c : 0);
}

bool planes_make(planes *p, const tribox_grid *grid)
{
    *p = (planes){.grid = *grid};
    for (int a = 0; a < 3; a++) {
        p->size[a] = (int)grid->size[a];
        if (p->size[a] < 1 || p->size[a] > PLANES_CELLS)
            return false;
        p->at[a][0] = library_cell(grid, a, 0).lo[a];
        for (int c = 0; c < p->size[a]; c++) {
            const tribox_box cell = library_cell(grid, a, (uint32_t)c);
            if (cell.lo[a] != p->at[a][c] || !(cell.hi[a] > cell.lo[a]))
                return false;
            p->at[a][c + 1] = cell.hi[a];
        }
    }
    return true;
}

tribox_box planes_cell(const planes *p, const int cell[3])
{
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = p->at[a][cell[a]];
        box.hi[a] = p->at[a][cell[a] + 1];
    }
    return box;
}

/* How many planes of an axis lie below x, or at it if it is closed. */
static int planes_below(const planes *p, int axis, double x, bool is_closed)
{
    int below = 0, above = p->size[axis] + 1;
    while (below < above) {
        const int middle = (below + above) / 2;
        const double plane = p->at[axis][middle];
        if (plane < x || (is_closed && plane == x))
            below = middle + 1;
        else
            above = middle;
    }
    return below;
}

span planes_met(const planes *p, int axis, double least, double most)
{
    const int below = planes_below(p, axis, least, false), until = planes_below(p, axis, most, true);
    return (span){below > 0 ? below - 1 : 0, until <= p->size[axis] ? until - 1 : p->size[axis] - 1};
}

block planes_candidates(const planes *p, const triangle *t)
{
    block b;
    for (int a = 0; a < 3; a++) {
        const float least = fminf(fminf(t->u[0][a], t->u[1][a]), t->u[2][a]);
        const float most = fmaxf(fmaxf(t->u[0][a], t->u[1][a]), t->u[2][a]);
        const span met = planes_met(p, a, (double)least, (double)most);
        b.first[a] = met.first > 0 ? met.first - 1 : 0;
        const int last = met.last + 1 < p->size[a] ? met.last + 1 : p->size[a] - 1;
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

size_t planes_bit(const planes *p, const int cell[3])
{
    const size_t row = (size_t)cell[2] * (size_t)p->size[1] + (size_t)cell[1];
    return 64 * row * tribox_grid_row_words(&p->grid) + (size_t)cell[0];
}
