#include "contact_margin.h"

#include <math.h>

#include "common/oracle.h"

/* Triangle and box about the box's centre, all of it doubled: differences of floats alone. */
typedef struct doubled {
    double v[3][3], h[3];
} doubled;

static doubled doubled_of(const pair_f32 *pair)
{
    doubled d;
    for (int a = 0; a < 3; a++) {
        const double lo = pair->box.lo[a], hi = pair->box.hi[a];
        d.h[a] = hi - lo;
        for (int j = 0; j < 3; j++)
            d.v[j][a] = ((double)pair->u[j][a] - lo) + ((double)pair->u[j][a] - hi);
    }
    return d;
}

static void edge_of(const pair_f32 *pair, int j, double f[3])
{
    for (int a = 0; a < 3; a++)
        f[a] = (double)pair->u[(j + 1) % 3][a] - (double)pair->u[j][a];
}

static void cross(const double p[3], const double q[3], double r[3])
{
    for (int i = 0; i < 3; i++)
        r[i] = p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
}

/* By how much the doubled projections on an axis are apart, not normalised. */
static double apart_by(const doubled *d, const double axis[3])
{
    double least = INFINITY, most = -INFINITY, r = 0;
    for (int j = 0; j < 3; j++) {
        const double place = axis[0] * d->v[j][0] + axis[1] * d->v[j][1] + axis[2] * d->v[j][2];
        least = fmin(least, place);
        most = fmax(most, place);
    }
    for (int a = 0; a < 3; a++)
        r += d->h[a] * fabs(axis[a]);
    return fmax(least, -most) - r;
}

static double length_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static void axis_of(const pair_f32 *pair, int number, double axis[3])
{
    double f[2][3], unit[3] = {0};
    if (number < ORACLE_PLANE) {
        axis[0] = axis[1] = axis[2] = 0;
        axis[number] = 1;
    } else if (number == ORACLE_PLANE) {
        edge_of(pair, 0, f[0]);
        edge_of(pair, 1, f[1]);
        cross(f[0], f[1], axis);
    } else {
        edge_of(pair, (number - ORACLE_EDGES) % 3, f[0]);
        unit[(number - ORACLE_EDGES) / 3] = 1;
        cross(unit, f[0], axis);
    }
}

double margin_gap(const pair_f32 *pair)
{
    const doubled d = doubled_of(pair);
    double gap = -INFINITY;
    for (int k = 0; k < ORACLE_AXES; k++) {
        double axis[3];
        axis_of(pair, k, axis);
        const double length = length_of(axis);
        if (length > 0)
            gap = fmax(gap, apart_by(&d, axis) / (2 * length));
    }
    return gap;
}

double margin_largest(const pair_f32 *pair)
{
    double most = 0;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            most = fmax(most, fabs((double)pair->u[j][a]));
        most = fmax(most, fmax(fabs((double)pair->box.lo[a]), fabs((double)pair->box.hi[a])));
    }
    return most;
}

/* The extents F of the triangle and m, which bounds its distance from the far faces of the box. */
static void extents_of(const pair_f32 *pair, double extent[3], double m[3])
{
    for (int a = 0; a < 3; a++) {
        const double least = fmin(fmin((double)pair->u[0][a], (double)pair->u[1][a]), (double)pair->u[2][a]);
        const double most = fmax(fmax((double)pair->u[0][a], (double)pair->u[1][a]), (double)pair->u[2][a]);
        extent[a] = most - least;
        m[a] = fmax(most - (double)pair->box.lo[a], (double)pair->box.hi[a] - least);
    }
}

/* The float bound of an axis, with the axis as long as axis_of makes it and projections doubled. */
static double float_bound(int number, const double extent[3], const double m[3])
{
    const double u = 0x1p-24;
    if (number >= ORACLE_EDGES) {
        const int i = (number - ORACLE_EDGES) / 3, a = (i + 1) % 3, b = (i + 2) % 3;
        return 2 * 16 * u * (extent[a] * m[b] + extent[b] * m[a]);
    }
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += extent[(i + 1) % 3] * extent[(i + 2) % 3] * m[i];
    return 2 * 24 * u * sum;
}

bool margin_is_conservative(const pair_f32 *pair)
{
    const doubled d = doubled_of(pair);
    double extent[3], m[3];
    extents_of(pair, extent, m);
    for (int k = 0; k < ORACLE_AXES; k++) {
        double axis[3];
        axis_of(pair, k, axis);
        const double allowed = k < ORACLE_PLANE ? 0 : 3 * float_bound(k, extent, m);
        if (apart_by(&d, axis) > allowed)
            return false;
    }
    return true;
}
