/* count_plane.c - counts the roundings of the plane's slack and of its bound: PROOFS.md 3.5, 14.2. */
#include "vec_count.h"
#include "kernel/axes.h"
#include "kernel/settle/bounds.h"
#include "claims.h"
#include "tally.h"
#include "rays.h"
#include "taken.h"

/* The signs of n: bits 0 to 2. That of d need not be tried: with all four turned the slack is too. */
enum { SIGNS = 8 };

/*
 * Boxes of floats, those that triangles of doubles are rounded to, and of doubles. Of these one form needs the most on all axes:
 * what rounds in C and in u_0 less the origin meets n_a alone, and is the most where the origin is m_a below lo (PROOFS.md 3.9).
 */
enum { FORMS = 3, DRAWN = 5000 };
static const axis_form form[FORMS] = {OF_FLOATS, NEAR, FAR_ORIGIN(-1)};
static const axis_form of_doubles[4] = {FAR_ORIGIN(-1), FAR_ORIGIN(1), NEXT_ORIGIN(-1), NEXT_ORIGIN(1)};

static tally plane[FORMS];
static double under_normal[FORMS], under_rest[FORMS], under_lengths;

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

static void look_at_underflow(int k, const counted *slack)
{
    for (int m = 0; m < 8; m++)
        COUNT_MUST(m != 7 || !(slack->under[m] > 0));
    for (int i = 0; i < 3; i++) {
        const double FF = exact_F((i + 1) % 3) * exact_F((i + 2) % 3);
        if (exact_M(i) > 0)
            under_normal[k] = most_of(under_normal[k], slack->under[1 << i] / (exact_M(i) / 2));
        COUNT_MUST(FF > 0 || !(slack->under[7 - (1 << i)] > 0));
        if (FF > 0)
            under_lengths = most_of(under_lengths, slack->under[7 - (1 << i)] / FF);
    }
    under_rest[k] = most_of(under_rest[k], slack->under[0]);
}

/* The axes are set. */
static void count_point(int k)
{
    const lane_bounds bounds = bounds_of(&t, &truth);
    const counted bound = *count_of(bounds.plane);
    const double S = exact_S();
    shape_normal(&s);
    const count_mark has_normal = count_now();
    for (unsigned script = 0; script < SIGNS; script++) {
        count_back_to(has_normal, script);
        for (int i = 0; i < 3; i++)
            count_of(s.n[i])->turned = 0; /* asked anew */
        const counted *const slack = count_of(plane_slack(&s, plane_reach(&s)));
        check_slack(slack);
        tally_both(&plane[k], slack, S, &bound, 16);
        look_at_underflow(k, slack);
    }
}

static void count_all(int k)
{
    count_start(0);
    const count_mark start = count_now();
    for (int x = 0; x < RAYS; x++) {
        count_back_to(start, 0);
        set_axis(0, &rays[x], form[k]);
        const count_mark has_x = count_now();
        for (int y = 0; y < RAYS; y++) {
            count_back_to(has_x, 0);
            set_axis(1, &rays[y], form[k]);
            const count_mark has_y = count_now();
            for (int z = 0; z < RAYS; z++) {
                count_back_to(has_y, 0);
                set_axis(2, &rays[z], form[k]);
                count_point(k);
            }
        }
    }
}

/* Not for the proof: no other point, and no other form, needs more. */
static void count_drawn(int k)
{
    for (int drawn = 0; drawn < DRAWN; drawn++) {
        count_start(0);
        for (int a = 0; a < 3; a++) {
            const ray r = drawn_ray();
            set_axis(a, &r, form[k].has_doubles ? drawn_form(of_doubles[drawn_below(4)]) : form[k]);
        }
        count_point(k);
    }
}

int main(int argc, char **argv)
{
    static const char *const names[FORMS] = {"plane", "plane, near", "plane"};
    claims_start(argc, argv);
    find_rays();
    for (int k = 0; k < (COUNT_BITS == 24 ? FORMS : 1); k++) { /* what doubles are rounded to is float */
        check_cones(&form[k], 1);
        count_signs_tried = 4;
        count_all(k);
        count_drawn(k);
        claim_tally(names[k], &plane[k]);
        claim_taken("plane, underflow of n", under_normal[k], taken_tau());
        claim_taken("plane, underflow of the rest", under_rest[k], taken_eta());
    }
    if (COUNT_BITS == 24)
        claim_number("plane, underflow of H and C", under_lengths);
    return claims_end();
}
