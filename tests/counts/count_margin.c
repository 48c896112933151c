/* count_margin.c - how often the margins of margin.h are rounded, beside what their constants leave for it: PROOFS.md 4.4. */
#include "vec_depth.h"
#include "kernel/axes.h"
#include "kernel/margin.h"
#include "claims.h"

/* What is left of a margin at the least, over what was meant. */
static double rounded_down(int depth) { return pow(1 - V_UNIT, depth); }

int main(int argc, char **argv)
{
    lane_box box;
    lane_shape s;
    claims_start(argc, argv);
    for (int a = 0; a < 3; a++) {
        box.lo[a] = box.hi[a] = (vnum){0};
        box.H[a] = (vnum){1};
        for (int j = 0; j < 3; j++)
            s.f[j][a] = (vnum){1};
    }
    const lane_box_margin of_box = box_margin_of(&box);
    const lane_margin margin = margin_of(&s, &of_box, true);
    /* 17 and 34 for 16 and 32; s (17 s + 34 h) for s (16 s / 3 + 16 h): margin.py has the polynomials. */
    claim("margin of the edges, depth", margin.edges.depth, 16.0 / 17 / rounded_down(margin.edges.depth));
    claim("margin of the plane, depth", margin.plane.depth, 16.0 / 34 / rounded_down(margin.plane.depth));
    return claims_end();
}
