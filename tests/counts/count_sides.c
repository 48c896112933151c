/*
 * count_sides.c - counts the roundings of the sides of edges on which rays along x are, of n_x, and of where they cross: PROOFS.md
 * 15.4.
 *
 * The ray lies within the box of the triangle. On an axis that leaves cones by the order of its place and those of the vertices, of
 * which the least and the greatest are vertices': their edges have every number 0 or 1, and not all vertices alike.
 */
#include "vec_count.h"
#include "kernel/axes.h"
#include "fill/fill_crossings.h"
#include "kernel/rows/crossings.h"
#include "claims.h"
#include "tally.h"

/* Bits 0 to 2 the vertices, bit 3 the ray. */
enum { FIRST = 1, LAST = 14 };

static tally side, area, crossing;
static vnum ray[3], least[3], most[3];

static void set_axis(int a, unsigned numbers, vnum u[9])
{
    for (int j = 0; j < 3; j++)
        u[3 * a + j] = count_input(a, numbers >> j & 1, true);
    ray[a] = count_input(a, numbers >> 3, true);
    least[a] = lane_min3(u[3 * a], u[3 * a + 1], u[3 * a + 2]);
    most[a] = lane_max3(u[3 * a], u[3 * a + 1], u[3 * a + 2]);
}

static void count_point(unsigned y, unsigned z)
{
    vnum u[9];
    lane_seen s;
    count_start(0);
    set_axis(0, FIRST, u); /* not met */
    set_axis(1, y, u);
    set_axis(2, z, u);
    find_edges(&s, u);
    const counted *const bound = count_of(side_error(v_sub(most[1], least[1]), v_sub(most[2], least[2])));
    tally_both(&area, count_of(s.area), 1, bound, 1); /* extents are 1 */
    for (int e = 0; e < 3; e++)
        tally_both(&side, count_of(side_of_edge(&s, e, ray[1], ray[2])), 1, bound, 1);
}

/* A number of y and z. */
static vnum given(double x)
{
    const vnum a = count_new(6);
    count_of(a)->x = x;
    return a;
}

/* Sides 0 and 2, which are n_x at the most together, as they are computed; times n_x, a crossing is linear in them. */
static void count_crossing(unsigned x, double side_0, double side_2)
{
    vnum u[9];
    lane_seen s;
    count_start(0);
    set_axis(0, x, u);
    set_axis(1, FIRST, u);
    set_axis(2, FIRST, u);
    find_edges(&s, u);
    s.area = given(1);
    s.per_area = v_div(v_splat(1), s.area);
    tally_first(&crossing, count_of(crossing_past(&s, given(side_0), given(side_2))), 1);
}

static bool has_extent(unsigned numbers) { return (numbers & 7) != 0 && (numbers & 7) != 7; }

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    for (unsigned y = FIRST; y <= LAST; y++)
        for (unsigned z = FIRST; z <= LAST; z++)
            if (has_extent(y) && has_extent(z))
                count_point(y, z);
    for (unsigned x = FIRST; x <= LAST; x++)
        for (int k = 0; has_extent(x) && k < 3; k++)
            count_crossing(x, k == 1, k == 2);
    claim_tally("side of a ray", &side);
    claim_tally("crossing of a ray", &crossing);
    claim_tally("n_x of a ray", &area);
    return claims_end();
}
