/*
 * test_small.c - one projection in tiny floats (vec_small.h): axes.h and bounds.h as they stand, against integers.
 *
 * A miss or an overlap is certain as in doubles.h: a slack beyond its bound, with redundant axes left out and, where there is a
 * least number, extents of zero or not too small. Nothing certain may be wrong, and no slack be off by more than its bound
 * (PROOFS.md 2, 3.1, 3.4, 3.7 and 5.1).
 */
#include "vec_small.h"

#include "kernel/axes.h"
#include "kernel/settle/bounds.h"
#include "small_draws.h"

enum { PAIRS_EACH = SMALL_HAS_LEAST ? 50 : 200 }; /* 5 or 20 million by default */

/* What the text sees of the pair: axes 1 and 2, those of projection 0. */
typedef struct small_pair {
    lane_triangle t;
    lane_box box;
    lane_shape s;
} small_pair;

static void put_axis(small_pair *p, int a, const small_axis *x)
{
    for (int j = 0; j < 3; j++)
        p->t.u[j][a] = (double)x->u[j] * SMALL_ONE;
    set_bounds(&p->box, a, (double)x->lo * SMALL_ONE, (double)x->hi * SMALL_ONE);
    shape_axis(&p->s, &p->t, &p->box, a);
}

/* Are shadow and rectangle apart, which are so on no axis? By what both cover along the normals of the shadow's sides. */
static bool is_apart(const small_axis *a, const small_axis *b)
{
    for (int j = 0; j < 3; j++) {
        const int k = (j + 1) % 3, l = (j + 2) % 3;
        const whole x = b->u[j] - b->u[k], y = a->u[k] - a->u[j];
        const whole side = a->u[j] * x + b->u[j] * y, other = a->u[l] * x + b->u[l] * y;
        const whole least = (x > 0 ? a->lo : a->hi) * x + (y > 0 ? b->lo : b->hi) * y;
        const whole most = (x > 0 ? a->hi : a->lo) * x + (y > 0 ? b->hi : b->lo) * y;
        if (whole_least(side, other) > most || whole_most(side, other) < least)
            return true;
    }
    return false;
}

/* Axis j, its sign chosen: the reach of the rectangle less the distance of the side from its middle, doubled (PROOFS.md 0). */
static whole exact_slack(const small_axis *a, const small_axis *b, int j, whole sign)
{
    const whole x = a->u[(j + 1) % 3] - a->u[j], y = b->u[(j + 1) % 3] - b->u[j];
    const whole reach = (a->hi - a->lo) * whole_size(y) + (b->hi - b->lo) * whole_size(x);
    return reach + sign * ((2 * a->u[j] - a->lo - a->hi) * y - (2 * b->u[j] - b->lo - b->hi) * x);
}

typedef struct answer {
    bool is_miss, is_overlap;
    double off; /* by how much of the bound a slack is, at most */
} answer;

static bool is_certifiable(vnum extent) { return extent == 0 || extent >= V_EXTENT / 2; }

/* What is certain of a pair that no box normal separates. */
static answer ask(small_pair *p, const small_axis *a, const small_axis *b)
{
    put_axis(p, 1, a);
    put_axis(p, 2, b);
    shape_normal_along(&p->s, 0);
    const edge_slacks slack = edge_slacks_along(&p->s, 0, true);
    const lane_bounds bounds = bounds_of(&p->t, &p->box);
    const vnum bound = v_add(bounds.edges[0], V_ETA);
    answer is = {false, is_certifiable(bounds.F[1]) && is_certifiable(bounds.F[2]), 0};
    for (int j = 0; j < 3; j++) {
        const double exact = (double)exact_slack(a, b, j, m_signs(p->s.n[0]) ? -1 : 1) * SMALL_ONE * SMALL_ONE;
        if (fabs(slack.of[j] - exact) > is.off * bound)
            is.off = fabs(slack.of[j] - exact) / bound;
        if (v_is_zero(p->s.f[j][1]) || v_is_zero(p->s.f[j][2]))
            continue;
        is.is_miss |= v_gt(0, v_add(slack.of[j], bound));
        is.is_overlap &= v_gt(v_sub(slack.of[j], bound), 0);
    }
    return is;
}

/* Axes are drawn slower than pairs are tried: each new one takes the place of another and meets those after it. */
enum { AXES = 16, MEETS = 4 };

static void try_pair(small_pair *p, const small_axis *a, const small_axis *b, small_tally *tally)
{
    const answer is = ask(p, a, b);
    tally->pairs++;
    tally->off = fmax(tally->off, is.off);
    tally->misses += is.is_miss;
    tally->overlaps += is.is_overlap;
    if ((!is.is_miss && !is.is_overlap) || is_apart(a, b) == is.is_miss)
        return;
    is.is_miss ? tally->wrong_misses++ : tally->wrong_overlaps++;
    if (small_wrong(tally) == 1) {
        printf("a wrong %s, in units of %g:\n", is.is_miss ? "miss" : "overlap", SMALL_ONE);
        small_print_axis('a', a);
        small_print_axis('b', b);
    }
}

int main(int argc, char **argv)
{
    const arguments args = arguments_parse(argc, argv);
    random_source r = random_named(args.seed, "small");
    small_tally tally = {0};
    small_pair p;
    small_axis axes[AXES];
    memset(&p, 0, sizeof p); /* axis 0 is a point in a point */
    for (int k = 0; k < AXES; k++)
        axes[k] = small_any_axis(&r);
    const uint64_t pairs = (uint64_t)args.pairs * PAIRS_EACH;
    for (int k = 0; tally.pairs < pairs && !small_is_over(&tally); k = (k + 1) % AXES) {
        axes[k] = small_any_axis(&r);
        for (int l = 1; l <= MEETS; l++)
            try_pair(&p, &axes[k], &axes[(k + l) % AXES], &tally);
    }
    printf("slacks are off by up to %.3f of their bound\n", tally.off);
    return small_verdict(&tally);
}
