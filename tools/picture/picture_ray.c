/* picture_ray.c - walks from cell to cell, and over empty space in one leap. */
#include "picture_ray.h"

/* A ray in units of cells, and where on it the walk is. */
typedef struct walk {
    double from[3], along[3], inverse[3];
    double t;
    int cell[3];
    int axis; /* of the plane crossed last */
} walk;

/* Rounds down, as lo is not negative. */
static int clamp(double x, int lo, int hi) { return x < lo ? lo : x > hi ? hi : (int)x; }

/* Leaves the box lo <= cell < hi. Returns false where that leaves the grid. */
static bool leave(const picture_grid *g, walk *w, const int lo[3], const int hi[3])
{
    double nearest = INFINITY;
    for (int a = 0; a < 3; a++) {
        const double t = ((w->along[a] > 0 ? hi[a] : lo[a]) - w->from[a]) * w->inverse[a];
        if (t < nearest) {
            nearest = t;
            w->axis = a;
        }
    }
    w->t = nearest > w->t ? nearest : w->t;
    for (int a = 0; a < 3; a++)
        if (a == w->axis)
            w->cell[a] = w->along[a] > 0 ? hi[a] : lo[a] - 1;
        else
            w->cell[a] = clamp(w->from[a] + w->t * w->along[a], lo[a], hi[a] - 1);
    return w->cell[w->axis] >= 0 && w->cell[w->axis] < g->size[w->axis];
}

/* Leaves a cell: leave() for a box of one cell, where no other coordinate can change. */
static bool step(const picture_grid *g, walk *w)
{
    double t[3];
    for (int a = 0; a < 3; a++)
        t[a] = (w->cell[a] + (w->along[a] > 0) - w->from[a]) * w->inverse[a];
    const int axis = t[0] < t[1] ? (t[0] < t[2] ? 0 : 2) : t[1] < t[2] ? 1 : 2;
    w->axis = axis;
    w->t = t[axis];
    w->cell[axis] += w->along[axis] > 0 ? 1 : -1;
    return w->cell[axis] >= 0 && w->cell[axis] < g->size[axis];
}

/* Goes to where the ray enters the grid, or stays at an origin within it. */
static bool enter(const picture_grid *g, walk *w)
{
    double last = INFINITY;
    w->t = 0;
    w->axis = 0;
    for (int a = 0; a < 3; a++) {
        const double t0 = -w->from[a] * w->inverse[a], t1 = (g->size[a] - w->from[a]) * w->inverse[a];
        const double in = t0 < t1 ? t0 : t1, out = t0 < t1 ? t1 : t0;
        if (in > w->t) {
            w->t = in;
            w->axis = a;
        }
        last = out < last ? out : last;
    }
    for (int a = 0; a < 3; a++)
        w->cell[a] = clamp(w->from[a] + w->t * w->along[a], 0, g->size[a] - 1);
    return w->t < last;
}

/* The empty bricks around the cell's, as cells of the grid. */
static bool is_leap(const picture_grid *g, const walk *w, int lo[3], int hi[3])
{
    const int x = w->cell[0] / BRICK, y = w->cell[1] / BRICK, z = w->cell[2] / BRICK;
    const int away = g->away[((size_t)z * (size_t)g->bricks[1] + (size_t)y) * (size_t)g->bricks[0] + (size_t)x];
    const int brick[3] = {x, y, z};
    for (int a = 0; away && a < 3; a++) {
        lo[a] = away <= brick[a] ? (brick[a] - away + 1) * BRICK : 0;
        hi[a] = (brick[a] + away) * BRICK < g->size[a] ? (brick[a] + away) * BRICK : g->size[a];
    }
    return away;
}

bool picture_trace(const picture_grid *g, vec origin, vec direction, double most, picture_hit *hit)
{
    walk w;
    for (int a = 0; a < 3; a++) {
        w.from[a] = origin.at[a] / g->cell[a];
        w.along[a] = direction.at[a] / g->cell[a];
        w.along[a] = fabs(w.along[a]) > 1e-12 ? w.along[a] : 1e-12; /* never parallel: 0 has no inverse */
        w.inverse[a] = 1 / w.along[a];
    }
    for (bool is_inside = enter(g, &w); is_inside && w.t < most;) {
        int lo[3], hi[3];
        if (is_leap(g, &w, lo, hi)) {
            is_inside = leave(g, &w, lo, hi);
        } else if (w.t > 0 && picture_grid_is_set(g, w.cell)) {
            *hit = (picture_hit){w.t, {w.cell[0], w.cell[1], w.cell[2]}, w.axis};
            return true;
        } else {
            is_inside = step(g, &w);
        }
    }
    return false;
}
