/*
 * places.h - triangles in places of a grid, as limits.h sees them, and what limits make of them. After: limits.h, cone.h.
 *
 * Two kinds of error are told apart: of places, planes and what stands for them, E of PROOFS.md 7.2, which a count is given; and of
 * what limits.h makes of them. `by_E` counts what that makes of E, in units of E.
 */
#define LARGEST_E 0.67 /* R: PROOFS.md 7.6 */

typedef struct limit_tally {
    tally alone, by_E;
} limit_tally;

static cone_edges edges;
static lane_places place[3];
static vnum cell[3], above[3]; /* the cell, and it plus one */
static double exact_E[3];

/* 1 / cell is rounded, whatever the cell. */
static inline vnum per_cell(void)
{
    const vnum one = v_div(v_splat(1), v_splat(1));
    count_of(one)->over = COUNT_NONE;
    return one;
}

/*
 * Edge k of the cones; or, past the last, an axis where nothing is but E, as an error or from a base far away. Vertices are where
 * they are, whatever places round.
 */
enum { OF_E = 2 };
static inline void set_axis(int a, int k)
{
    static const cone_edge nothing;
    const cone_edge *const from = k < edges.count ? &edges.of[k] : &nothing;
    vnum u[3];
    count_unit[a] = count_input(a, from->one, false);
    for (int j = 0; j < 3; j++)
        u[j] = count_input(a, from->g[j], true);
    cell[a] = count_input(a, from->cell, false);
    above[a] = count_input(a, from->cell + from->one, false);
    exact_E[a] = k >= edges.count;
    const double error = k == edges.count, far_away = k > edges.count ? 1 / (4 * V_UNIT) : 0;
    const vnum base = count_input(a, far_away, false), cells = count_input(a, from->cells, false);
    place[a] = places_of(u, base, cells, count_input(a, 0, true), per_cell(), count_input(a, error, false));
    for (int j = 0; j < 3; j++)
        place[a].g[j] = count_input(a, from->g[j], false);
}

static inline double exact_f(int j, int a) { return count_of(place[a].f[j])->x; }
static inline double exact_F(int a) { return most_of(fabs(exact_f(0, a)), most_of(fabs(exact_f(1, a)), fabs(exact_f(2, a)))); }
static inline double exact_R(int a) { return count_of(place[a].R)->x; }
/* m (g - X) of one axis. */
static inline double exact_part(double m, int j, int a)
{
    return m * (count_of(place[a].g[j])->x - count_of(m > 0 ? cell[a] : above[a])->x);
}

static inline bool is_near(double a, double b) { return fabs(a - b) <= 1e-9 * (fabs(a) + fabs(b)) + 1e-12; }

/* What is rounded, beside sizes: of E where one axis has nothing else. */
static inline void look_at(limit_tally *to, const counted *error, double size, double size_of_E)
{
    if (size_of_E > 0)
        tally_first(&to->by_E, error, size_of_E);
    else if (size > 0)
        tally_first(&to->alone, error, size);
    else
        COUNT_MUST(!(count_error(error) > 0));
}

/* Whether each comparison of one axis has one sign at all edges of a cone, and so within it. Other axes are alike. */
static inline void check_cone(const cone_edges *cone)
{
    double sign[COUNT_COMPARISONS] = {0};
    edges = *cone;
    count_signs_tried = COUNT_NUMBERS; /* no sign of them is a comparison on one axis */
    for (int k = 0; k < cone->count; k++) {
        count_start(0);
        for (int a = 0; a < 3; a++)
            set_axis(a, k);
        const vnum n = shadow_normal(&place[0], &place[1]);
        for (int j = 0; j < 3; j++) {
            limits_of_edge(&place[0], &place[1], j, n, shadow_error(&place[0], &place[1]));
            side_of_shadow(&place[0], &place[1], j, true);
        }
        plane_of(place, v_splat(1), true);
        COUNT_MUST(count_comparisons < COUNT_COMPARISONS);
        for (int c = 0; c < count_comparisons; c++) {
            const double compared = fabs(count_compared[c]) > 1e-9 ? count_compared[c] : 0;
            COUNT_MUST(sign[c] * compared >= 0);
            sign[c] = fabs(compared) > 0 ? compared : sign[c];
        }
    }
}
