/*
 * count_sides.c - counts the roundings of the sides of edges on which rays along x are, and of n_x: PROOFS.md 15.4.
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

static tally side, area;
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

static bool has_extent(unsigned numbers) { return (numbers & 7) != 0 && (numbers & 7) != 7; }

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    for (unsigned y = FIRST; y <= LAST; y++)
        for (unsigned z = FIRST; z <= LAST; z++)
            if (has_extent(y) && has_extent(z))
                count_point(y, z);
    claim_tally("side of a ray", &side);
    claim_tally("n_x of a ray", &area);
    return claims_end();
}
