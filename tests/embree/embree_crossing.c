#include "embree_crossing.h"

#include <math.h>

static void subtract(const float p[3], const float q[3], double difference[3])
{
    for (int a = 0; a < 3; a++)
        difference[a] = (double)p[a] - (double)q[a];
}

static double cross_part(const double p[3], const double q[3], int axis)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    return p[a] * q[b] - p[b] * q[a];
}

static double largest(const double v[3]) { return fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2])); }

/* The forward bound of the float quotient n . (v0 - from) / n[axis], of which n is a product of edges. */
static double float_error_of(double t, double edge, double reach, double distance, double n)
{
    const double u = 0x1p-24;
    return u * (distance + t) * (6 * edge * edge + 8 * reach * edge) / fabs(n) + 4 * u * t;
}

bool crossing_make(const triangle *t, int axis, const float from[3], crossing *c)
{
    double edge[2][3], v[3][3], n[3];
    for (int j = 0; j < 3; j++)
        subtract(t->u[j], from, v[j]);
    for (int j = 0; j < 2; j++)
        subtract(t->u[j + 1], t->u[j], edge[j]);
    for (int a = 0; a < 3; a++)
        n[a] = cross_part(edge[0], edge[1], a);
    if (n[axis] == 0)
        return false;
    c->t = (n[0] * v[0][0] + n[1] * v[0][1] + n[2] * v[0][2]) / n[axis];
    c->place = (double)from[axis] + c->t;
    c->cosine = n[axis] / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    c->barycentric = INFINITY;
    for (int j = 0; j < 3; j++)
        c->barycentric = fmin(c->barycentric, cross_part(v[(j + 1) % 3], v[(j + 2) % 3], axis) / n[axis]);
    double third[3];
    subtract(t->u[0], t->u[2], third);
    const double e = fmax(fmax(largest(edge[0]), largest(edge[1])), largest(third));
    const double reach = fmax(fmax(largest(v[0]), largest(v[1])), largest(v[2]));
    c->float_error = float_error_of(c->t, e, reach, fabs(v[0][0]) + fabs(v[0][1]) + fabs(v[0][2]), n[axis]);
    return true;
}
