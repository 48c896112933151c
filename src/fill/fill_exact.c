/* fill_exact.c - one triangle and the rays along x, by exact signs: of any numbers, in any grid. */
#include "exact/crossing.h"
#include "fill_crossings.h"

static double least_coordinate(double u[3][3], int a)
{
    const double least = u[0][a] < u[1][a] ? u[0][a] : u[1][a];
    return least < u[2][a] ? least : u[2][a];
}

static double greatest_coordinate(double u[3][3], int a)
{
    const double most = u[0][a] > u[1][a] ? u[0][a] : u[1][a];
    return most > u[2][a] ? most : u[2][a];
}

/* The cells of the grid that the triangle's box touches: none if last < first. */
static tribox_cells cells_of_triangle(const tribox_crossings *c, double u[3][3], int a)
{
    const int64_t size = c->middles.size[a];
    tribox_cells cells = tribox_planes_cells(&c->middles.planes, a, size, least_coordinate(u, a), greatest_coordinate(u, a));
    cells.first = cells.first < 0 ? 0 : cells.first;
    cells.last = cells.last < size ? cells.last : size - 1;
    return cells;
}

/* The side of all three edges that the ray of a row passes on; 0 where it misses the triangle. */
static int side_of_ray(double u[3][3], const double at[2])
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

/* The sign of n . (mark - u_0). */
static int height_of_mark(const tribox_crossings *c, double u[3][3], const double at[2], int64_t cell)
{
    const double mark = tribox_mark(&c->middles, cell);
    const bool is_lowest = c->middles.are_planes && cell < 0 && c->middles.planes.first[0] < 1;
    double mirrored[3][3];
    if (!is_lowest)
        return tribox_exact_height(u, (double[3]){mark, at[0], at[1]});
    /* The lowest plane of the grid is moved down, so that what lies in it is in the cell above. Seen in a mirror that is up. */
    memcpy(mirrored, u, sizeof mirrored);
    for (int j = 0; j < 3; j++)
        mirrored[j][0] = -u[j][0];
    return -tribox_exact_height(mirrored, (double[3]){-mark, at[0], at[1]});
}

/*
 * The first of the cells whose mark lies past the crossing, or the one after them: others lie wholly on either side of it. But the
 * upper plane of the cell before them may lie past it.
 */
static int64_t cell_past(const tribox_crossings *c, double u[3][3], const double at[2], int side)
{
    const tribox_cells cells = cells_of_triangle(c, u, 0);
    int64_t before = cells.first - (c->middles.are_planes ? 2 : 1), past = cells.last + 1;
    while (past - before > 1) {
        const int64_t cell = before + (past - before) / 2;
        const bool is_past = height_of_mark(c, u, at, cell) == side;
        *(is_past ? &past : &before) = cell;
    }
    return past;
}

void tribox_crossings_row(tribox_crossings *c, double u[3][3], int64_t j, int64_t k)
{
    const double at[2] = {tribox_middle(&c->middles, 1, j), tribox_middle(&c->middles, 2, k)};
    const int side = side_of_ray(u, at);
    if (side)
        tribox_crossings_turn(c, j, k, cell_past(c, u, at, side));
}

void tribox_crossings_exactly(tribox_crossings *c, double u[3][3])
{
    const tribox_cells y = cells_of_triangle(c, u, 1), z = cells_of_triangle(c, u, 2);
    for (int64_t k = z.first; k <= z.last; k++)
        for (int64_t j = y.first; j <= y.last; j++)
            tribox_crossings_row(c, u, j, k);
}
