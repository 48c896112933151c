/* count_edges.c - counts the roundings of the edges' slacks and of their bounds: PROOFS.md 3.1 to 3.4, 14.2. */
#include "vec_count.h"
#include "kernel/axes.h"
#include "kernel/settle/bounds.h"
#include "claims.h"
#include "tally.h"
#include "rays.h"

static tally one[3], own[3], two, near_one[3], normal, rejection, near_rejection;
enum { DRAWN = 5000 };
static double beside_own; /* of edge 2, but for twice its own B'_2 */
static double turned, under[3], under_two, under_normal;

/* In halves of the least number. An edge meets both its axes, so nothing that underflows meets another. */
static double underflow_of(const counted *number)
{
    for (int m = 1; m < 8; m++)
        COUNT_MUST(!(number->under[m] > 0));
    return number->under[0];
}

/* What an exact slack is: the text computes it, or this does not. */
static double exact_slack(double sign, int j)
{
    const double r = exact_H(1) * fabs(exact_f(j, 2)) + exact_H(2) * fabs(exact_f(j, 1));
    return r + sign * (exact_V(j, 1) * exact_f(j, 2) - exact_V(j, 2) * exact_f(j, 1));
}

/*
 * Of a slack with the sign of n turned, |n| is at most what can turn it: so r + s P + 2 |n| with the right one is at most what is
 * computed and, scaled alike, what both are off by. q of edge 1 has its 2 n already.
 */
static void look_at_rejection(tally *to, const counted *slack, double sign, double B, const counted *bound)
{
    counted both = *slack;
    const counted *const n = count_of(s.n[0]);
    for (int k = 0; k < n->width; k++)
        both.c[k] -= 2 * sign * n->c[k];
    both.rest += 2 * n->rest;
    tally_both(to, &both, B, bound, 1);
}

static void look_at_one_side(const counted *bound, tally to[3])
{
    const edge_slacks slack = edge_slacks_along(&s, 0, true);
    const double B = exact_B(1, 2), sign = count_sign(s.n[0]);
    for (int j = 0; j < 3; j++) {
        const counted *const e = count_of(slack.of[j]);
        COUNT_MUST(!(fabs(e->x - exact_slack(sign, j)) > 0));
        tally_both(&to[j], e, B, bound, 1);
        look_at_rejection(to == one ? &rejection : &near_rejection, e, sign, B, bound);
        if (to == near_one)
            continue;
        if (j == 2 && B > 0)
            beside_own = most_of(beside_own, (count_first(e) - 2 * exact_own_B(j, 1, 2)) / B);
        if (exact_own_B(j, 1, 2) > 0)
            tally_first(&own[j], e, exact_own_B(j, 1, 2));
        under[j] = most_of(under[j], underflow_of(e));
    }
}

static void look_at_normal(void)
{
    const counted *const n = count_of(s.n[0]);
    const double D = fabs(exact_f(0, 1) * exact_f(1, 2)) + fabs(exact_f(0, 2) * exact_f(1, 1));
    under_normal = most_of(under_normal, underflow_of(n));
    if (!(D > 0))
        return;
    tally_first(&normal, n, D);
    turned = most_of(turned, (count_first(n) - fabs(n->x)) / D); /* all but the last difference */
}

/* The bound of one side covers both. */
static void look_at_both_sides(const counted *bound, int j, unsigned script)
{
    const counted *const e = count_of(edge_slack_both_sides(&s, 0, j));
    const counted *const n = count_of(s.n[0]);
    const double r = exact_H(1) * fabs(exact_f(j, 2)) + exact_H(2) * fabs(exact_f(j, 1));
    const double middle = n->x - (exact_V(j, 1) * exact_f(j, 2) - exact_V(j, 2) * exact_f(j, 1));
    const double as_computed = j == 1 ? -middle : middle, sign = script & 1 ? -1 : 1; /* that of the middle is asked first */
    COUNT_MUST(n->turned * n->x < 0 || sign * as_computed < 0 || !(fabs(e->x - (r + fabs(n->x) - fabs(middle))) > 0));
    tally_both(&two, e, exact_B(1, 2), bound, 16);
    under_two = most_of(under_two, underflow_of(e));
}

static void set_axes(const ray *y, const ray *z, bool is_near)
{
    count_start(0);
    set_axis(0, &rays[0], is_near); /* not met */
    set_axis(1, y, is_near);
    set_axis(2, z, is_near);
}

/* Two signs of n; of both sides, those of n and of the middle. */
static void count_point(const ray *y, const ray *z, bool is_near)
{
    set_axes(y, z, is_near);
    const lane_bounds bounds = bounds_of(&t, &box);
    const counted bound = *count_of(bounds.edges[0]);
    const count_mark axes = count_now();
    count_signs_tried = 1;
    for (unsigned script = 0; script < 2; script++) {
        count_back_to(axes, script);
        shape_normal_along(&s, 0);
        look_at_one_side(&bound, is_near ? near_one : one);
        look_at_normal();
    }
    count_signs_tried = 2;
    for (unsigned script = 0; script < 4 && !is_near; script++)
        for (int j = 0; j < 3; j++) {
            count_back_to(axes, script);
            shape_normal_along(&s, 0);
            look_at_both_sides(&bound, j, script);
        }
}

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    find_rays();
    check_cones();
    for (int k = 0; k < RAYS * RAYS; k++) {
        count_point(&rays[k % RAYS], &rays[k / RAYS], false);
        count_point(&rays[k % RAYS], &rays[k / RAYS], true);
    }
    /* Not for the proof: no other point needs more. */
    for (int k = 0; k < DRAWN; k++) {
        const ray y = drawn_ray(), z = drawn_ray();
        count_point(&y, &z, k % 2);
    }
    for (int j = 0; j < 3; j++) {
        static const char *const names[3] = {"edge 0", "edge 1", "edge 2"};
        static const char *const own_names[3] = {"edge 0, of its own", "edge 1, of its own", NULL};
        static const char *const near_names[3] = {"edge 0, near", "edge 1, near", "edge 2, near"};
        static const char *const under_names[3] = {"edge 0, underflow", "edge 1, underflow", "edge 2, underflow"};
        claim_tally(names[j], &one[j]);
        if (own_names[j])
            claim_tally(own_names[j], &own[j]);
        claim_tally(near_names[j], &near_one[j]);
        claim_number(under_names[j], under[j]);
    }
    claim_number("edge 2, but for 2 u B'_2", beside_own);
    claim_tally("edge, rejected by a turned sign", &rejection);
    claim_tally("edge, rejected near", &near_rejection);
    claim_tally("edge, both sides", &two);
    claim_number("edge, both sides, underflow", under_two);
    claim_tally("normal", &normal);
    claim_number("normal, its sign", turned);
    claim_number("normal, underflow", under_normal);
    return claims_end();
}
