/*
 * fill_crossings.c - triangles and the rays along x through the middles of rows of cells: in double, and by exact signs where
 * rounding could turn one (PROOFS.md 15.4).
 */
#include "fill_crossings.h"

#include <math.h>

#include "ahead.h"

/* Rows that the box of each triangle may hold a middle of, on y and on z: none where last < first. */
typedef struct row_ranges {
    double first[2][TRIBOX_SEEN_ALONG], last[2][TRIBOX_SEEN_ALONG];
} row_ranges;

/* The nearest whole number, for sizes below 2^51. */
static inline double nearest(double x) { return (x + 0x1.8p52) - 0x1.8p52; }

static inline double least_of(double a, double b) { return a < b ? a : b; }

static inline double most_of(double a, double b) { return a > b ? a : b; }

/* On axis a, y or z. The middle of cell j has the place j + 1/2. */
static void find_rows(const tribox_middles *m, int a, const tribox_seen_along *seen, size_t count, double *first, double *last)
{
    const double(*const u)[TRIBOX_SEEN_ALONG] = &seen->number[3 * a];
    const double origin = m->origin[a], per_cell = m->per_cell[a], error = m->error[a], size = m->size[a];
    for (size_t i = 0; i < count; i++) {
        const double least = least_of(least_of(u[0][i], u[1][i]), u[2][i]), most = most_of(most_of(u[0][i], u[1][i]), u[2][i]);
        const double from = most_of(least_of((least - origin) * per_cell - error, size), 0);
        const double to = least_of(most_of((most - origin) * per_cell - 1 + error, -1), size - 1);
        first[i] = nearest(from);
        last[i] = nearest(to);
    }
}

/* A triangle as it is seen along x, and what rounding can do to it. */
typedef struct view {
    double u[3][3];         /* u[j][a] */
    double lo[3], hi[3];    /* its box, and what middles can be off by */
    double dy[3], dz[3];    /* edge j, from vertex j on */
    double error;           /* of a side */
    double sign;            /* that of n_x: 1 or -1 */
    double dx[3], per_area; /* of vertices from vertex 0, and 1 / n_x */
    double place_error;     /* of a crossing, in cells */
} view;

/* What can be told of n_x: OPEN where its sign is not certain, EMPTY where it is surely zero. */
typedef enum certainty { EMPTY, OPEN, CERTAIN } certainty;

static bool is_same(const double a[3], const double b[3]) { return (a[1] == b[1]) & (a[2] == b[2]); }

static certainty look(view *v, const tribox_middles *m)
{
    double(*const u)[3] = v->u, F[3];
    for (int a = 0; a < 3; a++) {
        v->lo[a] = least_of(least_of(u[0][a], u[1][a]), u[2][a]);
        v->hi[a] = most_of(most_of(u[0][a], u[1][a]), u[2][a]);
        F[a] = v->hi[a] - v->lo[a];
    }
    bool is_empty = !(F[1] > 0 && F[2] > 0);
    for (int j = 0; j < 3; j++)
        is_empty |= is_same(u[j], u[(j + 1) % 3]);
    if (is_empty)
        return EMPTY;
    for (int a = 1; a < 3; a++) {
        v->lo[a] -= m->off[a];
        v->hi[a] += m->off[a];
        F[a] = v->hi[a] - v->lo[a];
    }
    for (int j = 0; j < 3; j++) {
        v->dy[j] = u[(j + 1) % 3][1] - u[j][1];
        v->dz[j] = u[(j + 1) % 3][2] - u[j][2];
        v->dx[j] = u[j][0] - u[0][0];
    }
    const double area = v->dy[0] * v->dz[1] - v->dz[0] * v->dy[1];
    v->error = 0x1p-49 * (F[1] * F[2]) + (F[1] * m->off[2] + F[2] * m->off[1]) + 0x1p-1000;
    if (!(fabs(area) > 16 * v->error) || F[0] > 0x1p300 || F[1] > 0x1p300 || F[2] > 0x1p300)
        return OPEN;
    v->sign = area > 0 ? 1 : -1;
    v->per_area = 1 / area;
    v->place_error = (F[0] * (8 * v->error * fabs(v->per_area) + 0x1p-49)) * m->per_cell[0] + m->error[0];
    return v->place_error < 0.25 ? CERTAIN : OPEN;
}

void tribox_crossings_finish(tribox_crossings *c)
{
    tribox_turns *const turns = &c->turns;
    for (unsigned n = 0; n < TRIBOX_TURNS_AHEAD; n++)
        turns->word[turns->count + n] = c->beyond;
    for (unsigned n = 0; n < turns->count; n++) {
        tribox_will_write(turns->word[n + TRIBOX_TURNS_AHEAD]);
        *turns->word[n] ^= turns->bit[n];
    }
    turns->count = 0;
}

/* Where the ray of row (j, k), along (y, z), crosses, if it does. */
static void cross(tribox_crossings *c, view *v, int64_t j, int64_t k, double y, double z)
{
    const tribox_middles *const m = &c->middles;
    double side[3];
    for (int e = 0; e < 3; e++)
        side[e] = v->dy[e] * (z - v->u[e][2]) - v->dz[e] * (y - v->u[e][1]);
    const double least = least_of(least_of(side[0] * v->sign, side[1] * v->sign), side[2] * v->sign);
    const double x = v->u[0][0] + (side[2] * v->dx[1] + side[0] * v->dx[2]) * v->per_area;
    const double place = (x - m->origin[0]) * m->per_cell[0] + 0.5, inside = least_of(most_of(place, 0.5), m->size[0] + 0.5);
    const int64_t cell = (int64_t)inside;
    const double past = fabs(inside - (double)cell - 0.5);
    if (fabs(least) > v->error && (past < 0.5 - v->place_error || least < 0))
        tribox_crossings_turn(c, j, k, cell, least > 0);
    else
        tribox_crossings_row(c, v->u, j, k);
}

/* Rows first to last on both axes that lie in the triangle's box: others no ray through the triangle has. */
static void cross_rows(tribox_crossings *c, view *v, const int64_t first[2], const int64_t last[2])
{
    const tribox_middles *const m = &c->middles;
    for (int64_t k = first[1]; k <= last[1]; k++) {
        const double z = tribox_middle_near(m, 2, k);
        if (z < v->lo[2] || z > v->hi[2])
            continue;
        for (int64_t j = first[0]; j <= last[0]; j++) {
            const double y = tribox_middle_near(m, 1, j);
            if (y >= v->lo[1] && y <= v->hi[1])
                cross(c, v, j, k, y, z);
        }
    }
}

static void add_one(tribox_crossings *c, const tribox_seen_along *seen, size_t i, const int64_t first[2], const int64_t last[2])
{
    view v;
    for (int n = 0; n < 9; n++)
        v.u[n % 3][n / 3] = seen->number[n][i];
    if (!tribox_are_finite_f64(&v.u[0][0], 9))
        return;
    const certainty of = look(&v, &c->middles);
    if (of == CERTAIN)
        cross_rows(c, &v, first, last);
    else if (of == OPEN)
        tribox_crossings_exactly(c, v.u);
}

static void add_exactly(tribox_crossings *c, const tribox_seen_along *seen, size_t i)
{
    double u[3][3];
    for (int n = 0; n < 9; n++)
        u[n % 3][n / 3] = seen->number[n][i];
    if (tribox_are_finite_f64(&u[0][0], 9))
        tribox_crossings_exactly(c, u);
}

void tribox_crossings_add(tribox_crossings *c, const tribox_seen_along *seen, size_t count)
{
    row_ranges rows;
    if (!c->middles.has_places) {
        for (size_t i = 0; i < count; i++)
            add_exactly(c, seen, i);
        return;
    }
    for (int a = 1; a < 3; a++)
        find_rows(&c->middles, a, seen, count, rows.first[a - 1], rows.last[a - 1]);
    size_t found[TRIBOX_SEEN_ALONG], founds = 0;
    for (size_t i = 0; i < count; i++) {
        found[founds] = i;
        founds += (size_t)((rows.first[0][i] <= rows.last[0][i]) & (rows.first[1][i] <= rows.last[1][i]));
    }
    for (size_t n = 0; n < founds; n++) {
        const size_t i = found[n];
        const int64_t first[2] = {(int64_t)rows.first[0][i], (int64_t)rows.first[1][i]},
                      last[2] = {(int64_t)rows.last[0][i], (int64_t)rows.last[1][i]};
        add_one(c, seen, i, first, last);
    }
}
