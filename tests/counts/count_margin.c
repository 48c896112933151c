/*
 * count_margin.c - how often the margins of margin.h are rounded, beside what their coefficients leave for it: PROOFS.md 4.4.
 *
 * Differences of two numbers of the input, rounded once, are given. What coefficients are needed margins.py proves.
 */
#include "vec_depth.h"
#include "kernel/axes.h"
#include "kernel/pairs/margin.h"
#include "claims.h"

/* Of a triangle whose s is this, and a box whose longest side is h. */
static lane_margin margin_at(double extents, double h)
{
    lane_box box;
    lane_shape s;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = box.hi[a] = v_splat(0);
        box.H[a] = (vnum){h, 1};
        for (int j = 0; j < 3; j++)
            s.f[j][a] = (vnum){extents / 6, 1};
    }
    const lane_box_margin of_box = box_margin_of(&box);
    return margin_of(&s, &of_box, true);
}

/* `least`: the least of what the margin has over what is needed. */
static void claim_margin(const char *name, vnum margin, double least)
{
    claim(&(count_claim){name, margin.depth, 1 / (least * pow(1 - V_UNIT, margin.depth)), 0});
}

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    const lane_margin of_triangle = margin_at(1, 0), of_both = margin_at(1, 1);
    const double ss = of_triangle.edges.x / (16 * V_UNIT), sh = (of_both.edges.x - of_triangle.edges.x) / (32 * V_UNIT);
    const double sss = of_triangle.plane.x / (16 * V_UNIT / 3), ssh = (of_both.plane.x - of_triangle.plane.x) / (16 * V_UNIT);
    claim_margin("margin of the edges, depth", of_both.edges, fmin(ss, sh));
    claim_margin("margin of the plane, depth", of_both.plane, fmin(sss, ssh));
    return claims_end();
}
