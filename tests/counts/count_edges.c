/* count_edges.c - counts the roundings of the edges' slacks and of their bounds: PROOFS.md 3.1 to 3.4, 14.2. */
#include "vec_count.h"
#include "kernel/axes.h"
#include "kernel/settle/bounds.h"
#include "claims.h"
#include "tally.h"
#include "rays.h"
#include "taken.h"

enum { DRAWN = 5000, FORMS = 4 };

/* Ways to give an axis, about which PROOFS.md makes claims of their own; and what was counted of these. */
typedef struct asked {
    const char *suffix; /* of the names of claims */
    int forms;
    axis_form of[FORMS];
    tally one[3], own[3], rejection, two;
    double beside_own; /* of edge 2, but for twice its own B'_2 */
    double under[3], under_two, under_lengths;
} asked;

/* Boxes of floats, those that triangles of doubles are rounded to, and of doubles, which need what those of floats do. */
static asked about[] = {
    {.suffix = "", .forms = 1, .of = {OF_FLOATS}},
    {.suffix = ", near", .forms = 1, .of = {NEAR}},
    {.suffix = "", .forms = 4, .of = {FAR_ORIGIN(-1), FAR_ORIGIN(1), NEXT_ORIGIN(-1), NEXT_ORIGIN(1)}},
};
static tally normal, distance;
static double turned, under_normal;

/* In halves of the least number. An edge meets both its axes, so but for lengths nothing that underflows meets another. */
static double underflow_of(const counted *number)
{
    for (int m = 1; m < 8; m++)
        COUNT_MUST(m == 2 || m == 4 || !(number->under[m] > 0));
    return number->under[0];
}

/* The same of lengths that are given, in F_a + F_b: each meets an edge. */
static void look_at_lengths(asked *to, const counted *number)
{
    for (int a = 1; a < 3; a++) {
        COUNT_MUST(!(number->under[1 << a] > 0) || exact_F(a) > 0);
        if (exact_F(a) > 0)
            to->under_lengths = most_of(to->under_lengths, number->under[1 << a] / exact_F(a));
    }
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

static void look_at_one_side(asked *to, const counted *bound)
{
    const edge_slacks slack = edge_slacks_along(&s, 0, true);
    const double B = exact_B(1, 2), sign = count_sign(s.n[0]);
    for (int j = 0; j < 3; j++) {
        const counted *const e = count_of(slack.of[j]);
        COUNT_MUST(!(fabs(e->x - exact_slack(sign, j)) > 0));
        tally_both(&to->one[j], e, B, bound, 1);
        look_at_rejection(&to->rejection, e, sign, B, bound);
        look_at_lengths(to, e);
        if (j == 2 && B > 0)
            to->beside_own = most_of(to->beside_own, (count_first(e) - 2 * exact_own_B(j, 1, 2)) / B);
        if (exact_own_B(j, 1, 2) > 0)
            tally_first(&to->own[j], e, exact_own_B(j, 1, 2));
        to->under[j] = most_of(to->under[j], underflow_of(e));
    }
}

static void look_at_normal(void)
{
    for (int a = 1; a < 3; a++)
        if (exact_M(a) > 0)
            tally_first(&distance, count_of(s.V[a]), exact_M(a));
    const counted *const n = count_of(s.n[0]);
    const double D = fabs(exact_f(0, 1) * exact_f(1, 2)) + fabs(exact_f(0, 2) * exact_f(1, 1));
    under_normal = most_of(under_normal, underflow_of(n));
    if (!(D > 0))
        return;
    tally_first(&normal, n, D);
    turned = most_of(turned, (count_first(n) - fabs(n->x)) / D); /* all but the last difference */
}

/* The bound of one side covers both. */
static void look_at_both_sides(asked *to, const counted *bound, int j, unsigned script)
{
    const counted *const e = count_of(edge_slack_both_sides(&s, 0, j));
    const counted *const n = count_of(s.n[0]);
    const double r = exact_H(1) * fabs(exact_f(j, 2)) + exact_H(2) * fabs(exact_f(j, 1));
    const double middle = n->x - (exact_V(j, 1) * exact_f(j, 2) - exact_V(j, 2) * exact_f(j, 1));
    const double as_computed = j == 1 ? -middle : middle, sign = script & 1 ? -1 : 1; /* that of the middle is asked first */
    COUNT_MUST(n->turned * n->x < 0 || sign * as_computed < 0 || !(fabs(e->x - (r + fabs(n->x) - fabs(middle))) > 0));
    tally_both(&to->two, e, exact_B(1, 2), bound, 16);
    to->under_two = most_of(to->under_two, underflow_of(e));
    look_at_lengths(to, e);
}

static void set_axes(const ray *y, axis_form of_y, const ray *z, axis_form of_z)
{
    count_start(0);
    set_axis(0, &rays[0], of_y); /* not met */
    set_axis(1, y, of_y);
    set_axis(2, z, of_z);
}

/* The axes are set. Two signs of n; of both sides, those of n and of the middle. */
static void count_point(asked *to)
{
    const lane_bounds bounds = bounds_of(&t, &truth);
    const counted bound = *count_of(bounds.edges[0]);
    const count_mark axes = count_now();
    count_signs_tried = 1;
    for (unsigned script = 0; script < 2; script++) {
        count_back_to(axes, script);
        shape_normal_along(&s, 0);
        look_at_one_side(to, &bound);
        look_at_normal();
    }
    count_signs_tried = 2;
    for (unsigned script = 0; script < 4; script++)
        for (int j = 0; j < 3; j++) {
            count_back_to(axes, script);
            shape_normal_along(&s, 0);
            look_at_both_sides(to, &bound, j, script);
        }
}

static void count_all(asked *to)
{
    const int each = RAYS * to->forms;
    for (int k = 0; k < each * each; k++) {
        set_axes(&rays[k % RAYS], to->of[k % each / RAYS], &rays[k / each % RAYS], to->of[k / each / RAYS]);
        count_point(to);
    }
    /* Not for the proof: no other point needs more. */
    for (int k = 0; k < DRAWN; k++) {
        const ray y = drawn_ray(), z = drawn_ray();
        set_axes(&y, drawn_form(to->of[k % to->forms]), &z, drawn_form(to->of[k / to->forms % to->forms]));
        count_point(to);
    }
}

static const char *named(const char *name, const asked *of)
{
    static char text[64];
    snprintf(text, sizeof text, "%s%s", name, of->suffix);
    return text;
}

static void claim_all(const asked *of)
{
    static const char *const names[3] = {"edge 0", "edge 1", "edge 2"};
    static const char *const own_names[2] = {"edge 0, of its own", "edge 1, of its own"};
    static const char *const under_names[3] = {"edge 0, underflow", "edge 1, underflow", "edge 2, underflow"};
    for (int j = 0; j < 3; j++)
        claim_tally(named(names[j], of), &of->one[j]);
    claim_tally(named("edge, rejected by a turned sign", of), &of->rejection);
    if (of->of[0].is_relative && !of->of[0].has_doubles) /* no proof asks for more */
        return;
    for (int j = 0; j < 3; j++)
        claim_taken(under_names[j], of->under[j], taken_eta());
    for (int j = 0; j < 2; j++)
        claim_tally(own_names[j], &of->own[j]);
    claim_number("edge 2, but for 2 u B'_2", of->beside_own);
    claim_tally("edge, both sides", &of->two);
    claim_taken("edge, both sides, underflow", of->under_two, taken_eta());
    if (of->of[0].has_doubles)
        claim_number("edge, underflow of H and C", of->under_lengths);
}

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    find_rays();
    for (int k = 0; k < (COUNT_BITS == 24 ? 3 : 1); k++) { /* what doubles are rounded to is float */
        check_cones(about[k].of, about[k].forms < 2 ? 1 : 2);
        check_cones(about[k].of + about[k].forms / 2, about[k].forms < 2 ? 1 : 2);
        count_all(&about[k]);
        claim_all(&about[k]);
    }
    claim_tally("V_0", &distance);
    claim_tally("normal", &normal);
    claim_number("normal, its sign", turned);
    claim_number("normal, underflow", under_normal);
    return claims_end();
}
