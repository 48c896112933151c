/*
 * scenes_f64_floats.c - triangles of floats that touch boxes of doubles, or nearly: boxes of any size next to the spacing of floats
 * there, with bounds between two floats.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "contact_f64.h"

/* A triangle of floats: somewhere, often so far from zero that floats are coarse. */
static void draw_floats(random_source *r, double u[3][3])
{
    const double far_away = random_int(r, 3) ? 0 : ldexp(random_double(r, -1, 1), random_int_between(r, 0, 20));
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            u[j][a] = (float)(random_double(r, -1, 1) + far_away * (a + 1));
}

/* The float that is n steps away. */
static double stepped_float(double x, int n)
{
    float number = (float)x;
    for (; n > 0; n--)
        number = nextafterf(number, FLT_MAX);
    for (; n < 0; n++)
        number = nextafterf(number, -FLT_MAX);
    return number;
}

/* The same triangle in every place, some of them with a number that is a float further up or down; all times a power of two. */
static void repeat(random_source *r, double u[3][3], batch_f64 *batch)
{
    const int exponent = random_int(r, 3) ? 0 : random_int_between(r, -90, 90);
    for (int k = 0; k < BATCH_F64; k++) {
        const int turn = random_int(r, 3);
        for (int j = 0; j < 3; j++)
            memcpy(batch->u[k][j], u[(j + turn) % 3], sizeof batch->u[k][j]);
        double *const x = &batch->u[k][random_int(r, 3)][random_int(r, 3)];
        *x = stepped_float(*x, random_int(r, 2) ? 0 : random_int_between(r, -1, 1));
        for (int n = 0; n < 9; n++)
            batch->u[k][n / 3][n % 3] = ldexp(batch->u[k][n / 3][n % 3], exponent);
    }
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = ldexp(batch->box.lo[a], exponent);
        batch->box.hi[a] = ldexp(batch->box.hi[a], exponent);
    }
}

/* On axis a, from P to one side: to greater numbers where m is positive. Either end some doubles off. */
static void extend(random_source *r, tribox_box *box, int a, double P, double m)
{
    const double length = ldexp(random_double(r, 0, 1), -random_int(r, 40)), end = m > 0 ? P + length : P - length;
    const double near = stepped_f64(P, random_int(r, 2) ? 0 : random_int_between(r, -3, 3));
    box->lo[a] = fmin(near, end);
    box->hi[a] = fmax(near, end);
}

static void point_between(random_source *r, double u[3][3], int j, double third, double P[3])
{
    const double t = random_double(r, 0, 1 - third);
    for (int a = 0; a < 3; a++)
        P[a] = u[j][a] + t * (u[(j + 1) % 3][a] - u[j][a]) + third * (u[(j + 2) % 3][a] - u[j][a]);
}

/* A corner of the box lies on the triangle, and the rest of the box on one side of its plane. */
void draw_f64_float_planes(random_source *r, batch_f64 *batch)
{
    double u[3][3], P[3];
    draw_floats(r, u);
    point_between(r, u, random_int(r, 3), random_double(r, 0, 1), P);
    const double sign = random_int(r, 2) ? 1 : -1;
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const double n = (u[1][b] - u[0][b]) * (u[2][c] - u[0][c]) - (u[1][c] - u[0][c]) * (u[2][b] - u[0][b]);
        extend(r, &batch->box, a, P[a], sign * n);
    }
    repeat(r, u, batch);
}

/* An edge of the box crosses an edge of the triangle, which lies on the other side of it. */
void draw_f64_float_edges(random_source *r, batch_f64 *batch)
{
    double u[3][3], P[3];
    draw_floats(r, u);
    const int i = random_int(r, 3), a = (i + 1) % 3, b = (i + 2) % 3, j = random_int(r, 3);
    const double *const from = u[j], *const to = u[(j + 1) % 3], *const third = u[(j + 2) % 3];
    point_between(r, u, j, 0, P);
    const double m_a = to[b] - from[b], m_b = from[a] - to[a];
    const double sign = m_a * (third[a] - from[a]) + m_b * (third[b] - from[b]) > 0 ? -1 : 1;
    extend(r, &batch->box, a, P[a], sign * m_a);
    extend(r, &batch->box, b, P[b], sign * m_b);
    batch->box.lo[i] = P[i] - ldexp(random_double(r, 0, 1), -random_int(r, 40));
    batch->box.hi[i] = P[i] + ldexp(random_double(r, 0, 1), -random_int(r, 40));
    repeat(r, u, batch);
}

/* Bounds that are numbers of the triangle, or lie next to one or between two floats; flat boxes, and boxes no float is in. */
void draw_f64_float_faces(random_source *r, batch_f64 *batch)
{
    double u[3][3], P[3];
    draw_floats(r, u);
    point_between(r, u, random_int(r, 3), random_double(r, 0, 1), P);
    for (int a = 0; a < 3; a++) {
        const double next = stepped_float(P[a], 1), on = u[random_int(r, 3)][a];
        const double bound[] = {P[a],
                                on,
                                stepped_f64(on, random_int_between(r, -2, 2)),
                                P[a] / 2 + next / 2,
                                stepped_f64(P[a], 1),
                                random_double(r, -1, 1)};
        const double p = bound[random_int(r, 6)], q = bound[random_int(r, 6)];
        batch->box.lo[a] = fmin(p, q);
        batch->box.hi[a] = fmax(p, q);
    }
    repeat(r, u, batch);
}
