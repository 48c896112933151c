/*
 * count_limits_plane.c - counts the roundings of the limits that planes of triangles put on cells: PROOFS.md 7.7.
 *
 * They are compared as in count_limits.c, with the n_x that was computed. That a larger one may take its place is counted by hand.
 */
#include "vec_count.h"
#include "kernel/axes.h"
#include "kernel/limits.h"
#include "claims.h"
#include "tally.h"
#include "cone.h"
#include "places.h"

/* The signs of n. */
enum { SIGNS = 8 };

static limit_tally plane;
static double taken;    /* K u S, */
static double replaced; /* and k u S / R_x at the least for n_x */

static double exact_normal(int i)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    return exact_f(0, a) * exact_f(1, b) - exact_f(0, b) * exact_f(1, a);
}

/* Whether the signs of this script, in the order in which plane_of asks for them, are those of n. */
static bool is_own_script(unsigned script)
{
    double turn = 1;
    for (int a = 0; a < 3; a++) {
        const double sign = script >> a & 1 ? -1 : 1;
        if (sign * turn * exact_normal(a) < 0)
            return false;
        turn = a ? turn : sign;
    }
    return true;
}

/* n . (g_0 - X), n turned so that n_x is not negative; with the bound added or taken away. */
static double exact_left_side(unsigned script, bool is_upper, double bound)
{
    const double turn = script & 1 ? -1 : 1;
    double sum = bound;
    for (int a = 0; a < 3; a++) {
        const double n = turn * exact_normal(a);
        sum += n * (count_of(place[a].g[0])->x - count_of((n > 0) == is_upper ? cell[a] : above[a])->x);
    }
    return sum;
}

/* What the text adds to a limit for E, at these points: the plane's own part is the rest. */
static double exact_bound_of_E(void)
{
    double bound = 0;
    for (int a = 0; a < 3; a++)
        bound += fabs(exact_normal(a)) * (exact_E[a] + 4 * V_UNIT * exact_R(a));
    return bound;
}

/* The limits of one script: the greater of two that differ by twice the bound, and the other. */
static void look_at_both(unsigned script, vnum more, vnum less, bool is_upper, double S, double by_E)
{
    const counted *const high = count_of(count_sum(more, above[0], -1)), *const low = count_of(count_sum(less, above[0], -1));
    const double bound = (high->x - low->x) / 2;
    COUNT_MUST(!is_own_script(script) || is_near(high->x, exact_left_side(script, is_upper, bound)));
    if (is_own_script(script) && S > 0 && !(by_E > 0)) {
        taken = fmin(taken, (bound - exact_bound_of_E()) / (V_UNIT * S));
        replaced = most_of(replaced, count_of(count_least_divisor)->x / (V_UNIT * S));
    }
    look_at(&plane, high, S, by_E);
    look_at(&plane, low, S, by_E);
}

static void count_point(void)
{
    const count_mark axes = count_now();
    double S = 0, by_E = 0;
    for (int i = 0; i < 3; i++) {
        S += exact_F((i + 1) % 3) * exact_F((i + 2) % 3) * exact_R(i);
        by_E += exact_F((i + 1) % 3) * exact_F((i + 2) % 3) * exact_E[i];
    }
    for (unsigned script = 0; script < SIGNS; script++) {
        count_back_to(axes, script);
        const plane_limits limits = plane_of(place, v_splat(1), true);
        const lane_run run = run_by_plane(&limits, v_fma(limits.j_slope, cell[1], v_mul(limits.k_slope, cell[2])));
        look_at_both(script, run.end_maybe, run.end_certain, true, S, by_E);
        look_at_both(script, run.first_certain, run.first_maybe, false, S, by_E);
    }
}

static void count_all(void)
{
    memset(&plane, 0, sizeof plane);
    taken = INFINITY;
    cone_edges all;
    find_edges_of_cones(&all, 1, check_cone);
    edges = all;
    count_signs_tried = 3;
    count_start(0);
    const count_mark start = count_now();
    for (int x = 0; x < edges.count + OF_E; x++) {
        count_back_to(start, 0);
        set_axis(0, x);
        const count_mark has_x = count_now();
        for (int y = 0; y < edges.count + OF_E; y++) {
            count_back_to(has_x, 0);
            set_axis(1, y);
            const count_mark has_y = count_now();
            for (int z = 0; z < edges.count + OF_E; z++) {
                count_back_to(has_y, 0);
                set_axis(2, z);
                if ((x >= edges.count) + (y >= edges.count) + (z >= edges.count) <= 1)
                    count_point();
            }
        }
    }
}

/* With E at its largest, and what an n_x that takes the place of a smaller one moves. */
static void claim_covered(const char *name)
{
    plane.alone.of_bound = (plane.alone.first + plane.by_E.first * LARGEST_E + replaced) / taken;
    plane.alone.taken = taken;
    claim_tally(name, &plane.alone);
}

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    count_all();
    claim_covered("limit of the plane");
    claim_tally("limit of the plane, of E", &plane.by_E);
    return claims_end();
}
