/*
 * count_limits.c - counts the roundings of the limits that triangles put on cells, and of their bounds: PROOFS.md 7.2, 7.6, 7.7.
 *
 * A limit T on cell q is compared as m (T - q - 1), with the m that was computed: the left side of limits.h, and its error bound.
 */
#include "vec_count.h"
#include "kernel/axes.h"
#include "kernel/limits.h"
#include "claims.h"
#include "tally.h"
#include "cone.h"
#include "places.h"

static limit_tally edge, row;
static double taken; /* for all of these: K u Z */

/* The limits of edge j on cell (q, p), with their bound. */
static void look_at_limits(limit_tally *to, int q, int p, int j, vnum n)
{
    const vnum error = shadow_error(&place[q], &place[p]);
    const edge_limits limits = limits_of_edge(&place[q], &place[p], j, n, error);
    const double sign = count_sign(n), m_q = sign * exact_f(j, p), m_p = -sign * exact_f(j, q);
    const bool is_upper = count_sign(v_div(v_splat(1), limits.m_q)) > 0;
    const shadow_limit *const limit = is_upper ? &limits.upper : &limits.lower;
    const double L = exact_part(m_q, j, q) + exact_part(m_p, j, p), W = count_of(error)->x;
    const double Z = exact_F(p) * exact_R(q) + exact_F(q) * exact_R(p), by_E = exact_F(p) * exact_E[q] + exact_F(q) * exact_E[p];
    for (int k = 0; k < 2; k++) {
        const counted *const left =
            count_of(count_sum(v_fma(limit->slope, cell[p], k ? limit->certain : limit->maybe), above[q], -1));
        COUNT_MUST(is_near(left->x, L + (k ? -W : W)));
        look_at(to, left, Z, by_E);
    }
    if (Z > 0 && !(by_E > 0)) /* without the part of places */
        taken = fmin(taken, W / (V_UNIT * Z) - 4);
}

/* The same of whole rows. */
static void look_at_row(limit_tally *to, int q, int p, int j)
{
    const shadow_side of_shadow = side_of_shadow(&place[q], &place[p], j, true);
    const counted *const left = count_of(side_in_cell(&of_shadow, cell[q], side_in_row(&of_shadow, cell[p])));
    const double Z = exact_F(p) * exact_R(q) + exact_F(q) * exact_R(p);
    look_at(to, left, Z, 0);
}

static tally at_place;
static double turned;

static void look_at_normal(vnum n)
{
    const double D = fabs(exact_f(0, 0) * exact_f(1, 1)) + fabs(exact_f(0, 1) * exact_f(1, 0));
    if (D > 0) /* all but its last difference and 1 / cell of both axes, which are factors of it */
        turned = most_of(turned, (count_first(count_of(n)) - 3 * fabs(count_of(n)->x)) / D);
}

static void count_edges(int q_edge, int p_edge)
{
    count_start(0);
    set_axis(0, q_edge);
    set_axis(1, p_edge);
    const count_mark axes = count_now();
    for (unsigned script = 0; script < 4; script++)
        for (int j = 0; j < 3; j++) {
            count_back_to(axes, script);
            const vnum n = shadow_normal(&place[0], &place[1]);
            look_at_normal(n);
            look_at_limits(&edge, 0, 1, j, n);
            count_back_to(axes, script);
            look_at_row(&row, 0, 1, j);
        }
}

/* Vertices in places, and the first cell of their range: as E has it. */
static void count_places(int k)
{
    const cone_edge *const at = k < edges.count ? &edges.of[k] : NULL;
    const double base = !at;
    vnum u[3];
    count_start(0);
    count_unit[0] = count_input(0, at ? at->one : 0, false);
    for (int j = 0; j < 3; j++)
        u[j] = count_input(0, (at ? at->g[j] : 0) + base, true);
    const lane_places p = places_of(u, count_input(0, base, false), count_input(0, at ? at->cells : 0, false),
                                    count_input(0, 0, true), per_cell(), count_input(0, 0, false));
    for (int j = 0; j < 3; j++) {
        tally_first(&at_place, count_of(p.g[j]), base + count_of(p.R)->x);
        COUNT_MUST(V_UNIT * count_first(count_of(p.g[j])) <= count_of(p.E)->x * COUNT_ROOM);
        at_place.taken = count_of(p.E)->x / (V_UNIT * (base + count_of(p.R)->x));
    }
}

static void count_all_edges(void)
{
    memset(&edge, 0, sizeof edge);
    memset(&row, 0, sizeof row);
    taken = INFINITY;
    memset(&at_place, 0, sizeof at_place);
    cone_edges all;
    find_edges_of_cones(&all, 1, check_cone);
    edges = all;
    count_signs_tried = 2;
    for (int k = 0; k <= edges.count; k++)
        count_places(k);
    for (int k = 0; k < edges.count + OF_E; k++)
        for (int l = 0; l < edges.count + OF_E; l++)
            if (k < edges.count || l < edges.count)
                count_edges(k, l);
}

/*
 * With E at its largest. A sign of n may be turned where |n| is at most what can turn
 * it: then an edge is off by that, twice over and as far as a vertex is (PROOFS.md 7.6).
 */
static void claim_covered(const char *name)
{
    const double farthest = at_place.first / 4, needed = edge.alone.first + edge.by_E.first * LARGEST_E + 2.02 * turned * farthest;
    edge.alone.of_bound = needed / taken;
    edge.alone.taken = taken;
    claim_tally(name, &edge.alone);
}

int main(int argc, char **argv)
{
    claims_start(argc, argv);
    count_all_edges();
    at_place.of_bound = 0; /* all of it, which is compared where it is counted */
    claim_tally("place in a grid", &at_place);
    claim_covered("limit of an edge");
    claim_tally("limit of an edge, of E", &edge.by_E);
    row.alone.taken = taken;
    row.alone.of_bound = row.alone.first / taken;
    claim_tally("row beside an edge", &row.alone);
    claim_number("normal in places, its sign", turned);
    return claims_end();
}
