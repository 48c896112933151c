/*
 * count_widths.c - how large the numbers of axes.h become where the input is integers up to 1 in size: PROOFS.md 9.4.
 *
 * In each order of its vertices an axis is a part of a cube, cut along u_j = u_k, whose corners are corners of the cube; there all
 * that the text makes of it is linear, so the corners have the largest of every number.
 */
#include "vec_count.h"
#include "kernel/axes.h"
#include "exact/oriented/oriented.h"
#include "claims.h"

/* Three vertices, and a box whose bounds are in order. */
enum { CORNERS = 24 };

static lane_triangle t;
static lane_box box;
static lane_shape s;
static double most[4]; /* of numbers of so many axes */

static void set_axis(int a, int corner)
{
    for (int j = 0; j < 3; j++)
        t.u[j][a] = count_input(a, corner >> j & 1 ? 1 : -1, true);
    set_bounds(&box, a, count_input(a, corner / 8 == 2 ? 1 : -1, true), count_input(a, corner / 8 == 0 ? -1 : 1, true));
    shape_axis(&s, &t, &box, a);
}

static void look(void)
{
    for (int k = 0; k < count_numbers; k++) {
        const unsigned axes = count_number[k].axes;
        const unsigned degree = (axes & 1) + (axes >> 1 & 1) + (axes >> 2 & 1);
        most[degree] = most_of(most[degree], fabs(count_number[k].x));
    }
}

/* All signs of what has its size taken. */
static void count_corner(int corner)
{
    enum { OF_PLANE = 16, OF_EDGES = 256 };
    count_start(0);
    for (int a = 0; a < 3; a++)
        set_axis(a, a == 0 ? corner % CORNERS : a == 1 ? corner / CORNERS % CORNERS : corner / CORNERS / CORNERS);
    const count_mark axes = count_now();
    for (unsigned script = 0; script < OF_PLANE; script++) {
        count_back_to(axes, script);
        shape_normal(&s);
        plane_slack(&s, plane_reach(&s));
        look();
    }
    for (unsigned script = 0; corner % CORNERS == 0 && script < OF_EDGES; script++) {
        count_back_to(axes, script);
        shape_normal_along(&s, 0);
        edge_slacks_along(&s, 0, true);
        edge_slacks_along(&s, 0, false);
        look();
    }
}

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    count_signs_tried = 8;
    for (int corner = 0; corner < CORNERS * CORNERS * CORNERS; corner++)
        count_corner(corner);
    claim_number("integers, differences", most[1]);
    claim_number("integers, products of two", most[2]);
    /* The plane's slack in the shortest integers, one bit to spare. */
    claim_taken("integers, products of three", most[3], exp2(62 - 3 * TRIBOX_INT64_BITS));
    return claims_end();
}
