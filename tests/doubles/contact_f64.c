#include "contact_f64.h"

#include <math.h>
#include <string.h>

static double dot(const double p[3], const double q[3]) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

static void cross(const double p[3], const double q[3], double to[3])
{
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        to[i] = p[a] * q[b] - p[b] * q[a];
    }
}

static void any_vector(random_source *r, double size, double v[3])
{
    for (int a = 0; a < 3; a++)
        v[a] = random_double(r, -size, size);
}

/* Not inwards. */
static void outward_vector(random_source *r, const double m[3], double size, double v[3])
{
    any_vector(r, size, v);
    const double sign = dot(m, v) < 0 ? -1 : 1;
    for (int a = 0; a < 3; a++)
        v[a] *= sign;
}

/* A point of the box that is farthest along m: on a face, an edge, or a corner. */
static void farthest(random_source *r, const tribox_box *box, const double m[3], double X[3])
{
    for (int a = 0; a < 3; a++)
        X[a] = m[a] > 0 ? box->hi[a] : m[a] < 0 ? box->lo[a] : random_double(r, box->lo[a], box->hi[a]);
}

/* A direction with that many components other than zero. */
static void direction(random_source *r, int components, double m[3])
{
    const int first = random_int(r, 3);
    for (int k = 0; k < 3; k++) {
        const double length = random_double(r, 0.05, 1);
        m[(first + k) % 3] = k >= components ? 0 : random_int(r, 2) ? length : -length;
    }
}

static void vertex_contact(random_source *r, const tribox_box *box, double size, double u[3][3])
{
    double m[3], X[3], v[2][3];
    direction(r, random_int_between(r, 1, 3), m);
    farthest(r, box, m, X);
    outward_vector(r, m, size, v[0]);
    outward_vector(r, m, size, v[1]);
    for (int a = 0; a < 3; a++) {
        u[0][a] = X[a];
        u[1][a] = X[a] + v[0][a];
        u[2][a] = X[a] + v[1][a];
    }
}

static void edge_contact(random_source *r, const tribox_box *box, double size, double u[3][3])
{
    double m[3], X[3], d[3], v[3];
    direction(r, 2, m);
    farthest(r, box, m, X);
    const int i = m[0] == 0 ? 0 : m[1] == 0 ? 1 : 2, a = (i + 1) % 3, b = (i + 2) % 3;
    d[i] = random_double(r, -size, size);
    d[a] = -m[b] * size;
    d[b] = m[a] * size;
    outward_vector(r, m, size, v);
    const double s = random_double(r, 0, 1), t = random_double(r, 0, 1);
    for (int k = 0; k < 3; k++) {
        u[0][k] = X[k] + s * d[k];
        u[1][k] = X[k] - t * d[k];
        u[2][k] = X[k] + v[k];
    }
}

static void plane_contact(random_source *r, const tribox_box *box, double size, double u[3][3])
{
    double m[3], X[3], v[3], p[3], q[3];
    direction(r, 3, m);
    farthest(r, box, m, X);
    any_vector(r, size, v);
    cross(m, v, p);
    cross(m, p, q);
    double s[5];
    for (int k = 0; k < 5; k++)
        s[k] = random_double(r, 0, 1);
    for (int a = 0; a < 3; a++) {
        u[0][a] = X[a] + s[0] * p[a];
        u[1][a] = X[a] - s[1] * p[a] + s[2] * q[a];
        u[2][a] = X[a] - s[3] * p[a] - s[4] * q[a];
    }
}

static void turn_vertices(random_source *r, double u[3][3])
{
    double copy[3][3];
    const int first = random_int(r, 3), way = random_int_between(r, 1, 2);
    memcpy(copy, u, sizeof copy);
    for (int j = 0; j < 3; j++)
        memcpy(u[j], copy[(first + way * j) % 3], sizeof copy[0]);
}

void contact_f64(random_source *r, const tribox_box *box, double size, double u[3][3])
{
    static void (*const kinds[])(random_source *, const tribox_box *, double, double[3][3]) = {vertex_contact, edge_contact,
                                                                                               edge_contact, plane_contact};
    kinds[random_int(r, 4)](r, box, size, u);
    turn_vertices(r, u);
}

void through_corner_f64(random_source *r, const tribox_box *box, double size, double u[3][3])
{
    const int kind = random_int(r, 3), i = random_int(r, 3);
    const double s = random_double(r, -2, 2), t = random_double(r, -2, 2);
    for (int a = 0; a < 3; a++) {
        const double X = random_int(r, 2) ? box->lo[a] : box->hi[a];
        for (int j = 0; j < 3; j++)
            u[j][a] = random_double(r, -size, size);
        if (kind == 0)
            u[0][a] = X;
        else if (kind == 1 && a != i)
            u[1][a] = X + s * (u[0][a] - X);
        else if (kind == 2)
            u[2][a] = X + s * (u[0][a] - X) + t * (u[1][a] - X);
    }
}

double stepped_f64(double x, int n)
{
    for (; n > 0; n--)
        x = nextafter(x, INFINITY);
    for (; n < 0; n++)
        x = nextafter(x, -INFINITY);
    return x;
}

static double *any_number(random_source *r, double u[3][3])
{
    const int k = random_int(r, 9);
    return &u[k / 3][k % 3];
}

void nudge_f64(random_source *r, double u[3][3], int most)
{
    for (int times = random_int(r, 4); times > 0; times--) {
        double *const x = any_number(r, u);
        *x = stepped_f64(*x, random_int_between(r, -most, most));
    }
}

void shift_f64(random_source *r, double u[3][3], int most, double by)
{
    for (int times = random_int(r, 4); times > 0; times--) {
        double *const x = any_number(r, u);
        *x += by * random_int_between(r, -most, most);
    }
}

tribox_box box_f64_about_zero(random_source *r, double least, double most)
{
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = -random_double(r, least, most);
        box.hi[a] = random_double(r, least, most);
    }
    return box;
}

void place_f64(batch_f64 *batch, const int exponent[3], const double offset[3])
{
    for (int a = 0; a < 3; a++) {
        const double to = ldexp(offset[a], exponent[a]);
        batch->box.lo[a] = ldexp(batch->box.lo[a], exponent[a]) + to;
        batch->box.hi[a] = ldexp(batch->box.hi[a], exponent[a]) + to;
        for (int k = 0; k < BATCH_F64; k++)
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] = ldexp(batch->u[k][j][a], exponent[a]) + to;
    }
}
