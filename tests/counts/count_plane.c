/* count_plane.c - counts the roundings of the plane's slack and of its bound: PROOFS.md 3.5, 14.2. */
#include "vec_count.h"
#include "kernel/axes.h"
#include "kernel/settle/bounds.h"
#include "claims.h"
#include "tally.h"
#include "rays.h"

/* The signs of n: bits 0 to 2. That of d need not be tried: with all four turned the slack is too. */
enum { SIGNS = 8 };

static tally plane, near_plane;
static double under_normal, under_rest;

/* Where the signs of the script are those of n, and that of d its own: the slack of the paper. */
static void check_slack(const counted *slack)
{
    double reach = 0, d = 0;
    for (int i = 0; i < 3; i++) {
        const counted *const n = count_of(s.n[i]);
        if (n->turned * n->x < 0)
            return;
        reach += exact_H(i) * fabs(n->x);
        d += exact_V(0, i) * n->x;
    }
    COUNT_MUST(d < 0 || !(fabs(slack->x - (reach - d)) > 0));
}

static void look_at_underflow(const counted *slack)
{
    for (int m = 0; m < 8; m++)
        COUNT_MUST(m == 0 || m == 1 || m == 2 || m == 4 || !(slack->under[m] > 0));
    for (int i = 0; i < 3; i++)
        if (exact_M(i) > 0)
            under_normal = most_of(under_normal, slack->under[1 << i] / (exact_M(i) / 2));
    under_rest = most_of(under_rest, slack->under[0]);
}

/* The axes are set. */
static void count_point(bool is_near)
{
    const count_mark axes = count_now();
    const lane_bounds bounds = bounds_of(&t, &box);
    const counted bound = *count_of(bounds.plane);
    const double S = exact_S();
    for (unsigned script = 0; script < SIGNS; script++) {
        count_back_to(axes, script);
        shape_normal(&s);
        const counted *const slack = count_of(plane_slack(&s, plane_reach(&s)));
        check_slack(slack);
        tally_both(is_near ? &near_plane : &plane, slack, S, &bound, 16);
        if (!is_near)
            look_at_underflow(slack);
    }
}

static void count_all(bool is_near)
{
    count_start(0);
    const count_mark start = count_now();
    for (int x = 0; x < RAYS; x++) {
        count_back_to(start, 0);
        set_axis(0, &rays[x], is_near);
        const count_mark has_x = count_now();
        for (int y = 0; y < RAYS; y++) {
            count_back_to(has_x, 0);
            set_axis(1, &rays[y], is_near);
            const count_mark has_y = count_now();
            for (int z = 0; z < RAYS; z++) {
                count_back_to(has_y, 0);
                set_axis(2, &rays[z], is_near);
                count_point(is_near);
            }
        }
    }
}

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    find_rays();
    count_signs_tried = 4;
    count_all(false);
    claim_tally("plane", &plane);
    if (COUNT_BITS == 24) { /* doubles are rounded to floats for it */
        count_all(true);
        claim_tally("plane, near", &near_plane);
    }
    claim_number("plane, underflow of n", under_normal);
    claim_number("plane, underflow of the rest", under_rest);
    return claims_end();
}
