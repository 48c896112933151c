/* fill_crossings.c - one triangle and the rays along x through the middles of rows of cells. */
#include "fill_crossings.h"

#include "exact/crossing.h"
#include "finite.h"
#include "grid_cells.h"
#include "grid_f64.h"

static double plane_at(const tribox_crossings *c, int a, int64_t p)
{
    return c->grid ? tribox_grid_plane(c->grid, a, (uint64_t)p) : tribox_plane_at(&c->planes, a, p);
}

/* The double nearest to the middle of a cell: rounded once, as a sum is exact where its half is subnormal (PROOFS.md 15.2). */
static double middle_of(const tribox_crossings *c, int a, int64_t cell)
{
    const double lo = plane_at(c, a, cell), hi = plane_at(c, a, cell + 1), sum = lo + hi;
    return tribox_is_finite_f64(sum) ? sum / 2 : lo / 2 + hi / 2;
}

static double least_of(double u[3][3], int a)
{
    const double least = u[0][a] < u[1][a] ? u[0][a] : u[1][a];
    return least < u[2][a] ? least : u[2][a];
}

static double most_of(double u[3][3], int a)
{
    const double most = u[0][a] > u[1][a] ? u[0][a] : u[1][a];
    return most > u[2][a] ? most : u[2][a];
}

/* The closed cells that the triangle's box touches, -1 and size standing for those beside the grid. */
static tribox_cells cells_of(const tribox_crossings *c, double u[3][3], int a)
{
    const double least = least_of(u, a), most = most_of(u, a);
    return c->grid ? tribox_grid_cells(c->grid, a, 0, c->size[a], (float)least, (float)most)
                   : tribox_planes_cells(&c->planes, a, c->size[a], least, most);
}

/* The side of all three edges that the ray of a row passes on; 0 where it passes beside the triangle. */
static int side_of(double u[3][3], const double at[2])
{
    int side = 0;
    for (int j = 0; j < 3; j++) {
        const int of_edge = tribox_exact_side(&u[j][1], &u[(j + 1) % 3][1], at);
        if (!of_edge || (j && of_edge != side))
            return 0;
        side = of_edge;
    }
    return side;
}

/* The first cell from `first` to `last` whose middle lies past the crossing, or last + 1. */
static int64_t cell_past(const tribox_crossings *c, double u[3][3], const double at[2], int side, int64_t first, int64_t last)
{
    int64_t before = first - 1, past = last + 1;
    while (past - before > 1) {
        const int64_t cell = before + (past - before) / 2;
        const bool is_past = tribox_exact_height(u, (double[3]){middle_of(c, 0, cell), at[0], at[1]}) == side;
        *(is_past ? &past : &before) = cell;
    }
    return past;
}

static void turn(const tribox_crossings *c, size_t row, int64_t cell)
{
    if (cell < c->size[0])
        c->solid[row * c->rows.words + (size_t)(cell / 64)] ^= UINT64_C(1) << cell % 64;
    else
        c->beyond[row / 64] ^= UINT64_C(1) << row % 64;
}

void tribox_crossings_add(const tribox_crossings *c, double u[3][3])
{
    if (!tribox_are_finite_f64(&u[0][0], 9))
        return;
    tribox_cells cells[3];
    for (int a = 1; a < 3; a++) {
        cells[a] = cells_of(c, u, a);
        cells[a].first = cells[a].first < 0 ? 0 : cells[a].first;
        cells[a].last = cells[a].last < c->size[a] ? cells[a].last : (int64_t)c->size[a] - 1;
        if (cells[a].first > cells[a].last)
            return;
    }
    cells[0] = cells_of(c, u, 0);
    cells[0].first = cells[0].first < 0 ? 0 : cells[0].first;
    cells[0].last = cells[0].last < c->size[0] ? cells[0].last : (int64_t)c->size[0] - 1;
    for (int64_t k = cells[2].first; k <= cells[2].last; k++)
        for (int64_t j = cells[1].first; j <= cells[1].last; j++) {
            const double at[2] = {middle_of(c, 1, j), middle_of(c, 2, k)};
            const int side = side_of(u, at);
            if (side)
                turn(c, (size_t)k * c->size[1] + (size_t)j, cell_past(c, u, at, side, cells[0].first, cells[0].last));
        }
}
