/*
 * count_margin.c - how often the margins of margin.h are rounded, beside what their coefficients leave for it: PROOFS.md 4.4, 4.5;
 * and which boxes local.h takes: 14.3.
 *
 * Differences of two numbers of the input, rounded once, are given. What coefficients are needed margins.py proves.
 */
#include "vec_depth.h"
#include "kernel/axes.h"
#include "kernel/pairs/margin.h"
#include "kernel/pairs/local.h"
#include "claims.h"

/* Without BOX, m_a is bounded by a V_0 that was computed: as if each term of the bound were rounded so often before (4.5). */
enum { OF_V = 3 };

/* Of a triangle whose s is this, and a box whose longest side is h; without BOX, the |V_0a| are `away` together. */
static lane_margin margin_at(double extents, double h, double away, bool is_box_asked)
{
    const int before = is_box_asked ? 0 : OF_V;
    lane_box box;
    lane_shape s;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = box.hi[a] = v_splat(0);
        box.H[a] = (vnum){h, 1 + before};
        s.V[a] = (vnum){away / 3, before};
        for (int j = 0; j < 3; j++)
            s.f[j][a] = (vnum){extents / 6, 1 + before};
    }
    const lane_box_margin of_box = box_margin_of(&box);
    return margin_of(&s, &of_box, is_box_asked);
}

/* `least`: the least of what the margin has over what is needed. */
static void claim_margin(const char *name, vnum margin, double least)
{
    claim(&(count_claim){name, margin.depth, 1 / (least * pow(1 - V_UNIT, margin.depth)), 0});
}

/* Lengths are those of the box, or the distance that stands for them. */
static void claim_margins(bool is_box_asked, const char *edges, const char *plane)
{
    const lane_margin of_triangle = margin_at(1, 0, 0, is_box_asked), of_box = margin_at(1, 1, 0, is_box_asked);
    const lane_margin of_distance = is_box_asked ? of_box : margin_at(1, 0, 1, false);
    const double ss = of_triangle.edges.x / (16 * V_UNIT), sss = of_triangle.plane.x / (16 * V_UNIT / 3);
    const double sh = (fmin(of_box.edges.x, of_distance.edges.x) - of_triangle.edges.x) / (32 * V_UNIT);
    const double ssh = (fmin(of_box.plane.x, of_distance.plane.x) - of_triangle.plane.x) / (16 * V_UNIT);
    claim_margin(edges, of_box.edges, fmin(ss, sh));
    claim_margin(plane, of_box.plane, fmin(sss, ssh));
}

/*
 * How long the thinnest side has to be: with e_a = u (m_a + H_a) <= 2 u (sigma + h) taken away on either side, something must be
 * left of it. The text's least is that of which sigma + h is the most.
 */
static void claim_thinnest(void)
{
    const double thinnest = 1, longest = 3;
    lane_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = box.hi[a] = v_splat(0);
        box.H[a] = v_splat(a ? longest : thinnest);
    }
    const lane_box_margin near = local_margin_of(&box), any = box_margin_of(&box);
    const double taken = thinnest / (V_UNIT * (near.most.x + longest)), needed = 4;
    if (fabs(near.edges.x - any.edges.x) > 0 || fabs(near.eta.x - any.eta.x) > 0 || near.most.x > any.most.x)
        exit(1);
    claim(&(count_claim){"thinnest side, near", needed, needed / taken, taken});
}

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    claim_margins(true, "margin of the edges, depth", "margin of the plane, depth");
    claim_margins(false, "margin of the edges without BOX, depth", "margin of the plane without BOX, depth");
    claim_thinnest();
    return claims_end();
}
