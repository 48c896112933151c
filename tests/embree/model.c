#include "model.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "zeroed.h"

static model empty(size_t capacity) { return (model){.triangles = memory_of(capacity, sizeof(triangle))}; }

static void put(model *s, const double a[3], const double b[3], const double c[3])
{
    const double *const corner[3] = {a, b, c};
    for (int j = 0; j < 3; j++)
        for (int k = 0; k < 3; k++)
            s->triangles[s->count].u[j][k] = (float)corner[j][k];
    s->count++;
}

static void put_quad(model *s, const double a[3], const double b[3], const double c[3], const double d[3])
{
    put(s, a, b, c);
    put(s, a, c, d);
}

model model_soup(random_source *r, size_t count, double size)
{
    model s = empty(count);
    while (s.count < count) {
        double v[3][3];
        for (int a = 0; a < 3; a++) {
            const double least = random_double(r, -1, 1 - size);
            for (int j = 0; j < 3; j++)
                v[j][a] = least + random_double(r, 0, size);
        }
        put(&s, v[0], v[1], v[2]);
    }
    return s;
}

/* On the unit sphere. Symmetric in its arguments to the last bit: both neighbours of an edge make the same vertex. */
static void middle(const double a[3], const double b[3], double m[3])
{
    for (int k = 0; k < 3; k++)
        m[k] = a[k] + b[k];
    const double length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    for (int k = 0; k < 3; k++)
        m[k] /= length;
}

static void put_patch(model *s, int levels, const double a[3], const double b[3], const double c[3])
{
    if (!levels) {
        put(s, a, b, c);
        return;
    }
    double ab[3], bc[3], ca[3];
    middle(a, b, ab);
    middle(b, c, bc);
    middle(c, a, ca);
    put_patch(s, levels - 1, a, ab, ca);
    put_patch(s, levels - 1, b, bc, ab);
    put_patch(s, levels - 1, c, ca, bc);
    put_patch(s, levels - 1, ab, bc, ca);
}

/* Vertices 4 * k .. 4 * k + 3 are the corners (+-p, +-q) of a rectangle; the golden ratio makes all edges equal. */
static void icosahedron_vertex(int number, double v[3])
{
    const double golden = (1 + sqrt(5)) / 2, length = sqrt(1 + golden * golden);
    const int k = number / 4;
    v[k] = 0;
    v[(k + 1) % 3] = (number & 1 ? -1 : 1) / length;
    v[(k + 2) % 3] = (number & 2 ? -golden : golden) / length;
}

static double volume(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static bool is_edge(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 0.4; }

model model_icosphere(int levels)
{
    enum { VERTICES = 12 };
    model s = empty((size_t)20 << 2 * levels);
    double v[VERTICES][3];
    for (int k = 0; k < VERTICES; k++)
        icosahedron_vertex(k, v[k]);
    for (int a = 0; a < VERTICES; a++)
        for (int b = a + 1; b < VERTICES; b++)
            for (int c = b + 1; c < VERTICES; c++)
                if (is_edge(v[a], v[b]) && is_edge(v[b], v[c]) && is_edge(v[c], v[a])) {
                    const bool is_outward = volume(v[a], v[b], v[c]) > 0;
                    put_patch(&s, levels, v[a], is_outward ? v[b] : v[c], is_outward ? v[c] : v[b]);
                }
    return s;
}

static void torus_vertex(int i, int around, int j, int across, double tube, double v[3])
{
    const double turn = 8 * atan(1), p = turn * (i % around) / around, q = turn * (j % across) / across;
    const double ring = 1 - tube + tube * cos(q);
    v[0] = ring * cos(p);
    v[1] = ring * sin(p);
    v[2] = tube * sin(q);
}

model model_torus(int around, int across, double tube)
{
    model s = empty(2 * (size_t)around * (size_t)across);
    for (int i = 0; i < around; i++)
        for (int j = 0; j < across; j++) {
            double v[4][3];
            for (int k = 0; k < 4; k++)
                torus_vertex(i + (k == 1 || k == 2), around, j + k / 2, across, tube, v[k]);
            put_quad(&s, v[0], v[1], v[2], v[3]);
        }
    return s;
}

static void cube_vertex(int face, int i, int j, int steps, double v[3])
{
    const int axis = face % 3;
    const bool is_upper = face >= 3;
    v[axis] = is_upper ? 1 : -1;
    v[(axis + 1) % 3] = 2.0 * (is_upper ? i : j) / steps - 1;
    v[(axis + 2) % 3] = 2.0 * (is_upper ? j : i) / steps - 1;
}

model model_cube(int steps)
{
    model s = empty(12 * (size_t)steps * (size_t)steps);
    for (int face = 0; face < 6; face++)
        for (int i = 0; i < steps; i++)
            for (int j = 0; j < steps; j++) {
                double v[4][3];
                for (int k = 0; k < 4; k++)
                    cube_vertex(face, i + (k == 1 || k == 2), j + k / 2, steps, v[k]);
                put_quad(&s, v[0], v[1], v[2], v[3]);
            }
    return s;
}

void model_place(model *s, const double scale[3], const double shift[3])
{
    for (size_t t = 0; t < s->count; t++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                s->triangles[t].u[j][a] = (float)(scale[a] * (double)s->triangles[t].u[j][a] + shift[a]);
}

void model_snap(model *s)
{
    for (size_t t = 0; t < s->count; t++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                s->triangles[t].u[j][a] = rintf(s->triangles[t].u[j][a]);
}

void model_shake(model *s, random_source *r)
{
    for (size_t t = 0; t < s->count; t++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++) {
                float *const x = &s->triangles[t].u[j][a];
                *x = nextafterf(*x, *x + (float)random_int_between(r, -1, 1));
            }
}

void model_free(model *s)
{
    free(s->triangles);
    *s = (model){0};
}

streams streams_make(const model *s)
{
    streams made = {.soup.count = s->count, .memory = memory_of(9 * s->count, sizeof(float))};
    for (int j = 0; j < 3; j++) {
        float *const stream[3] = {made.memory + (size_t)(3 * j) * s->count, made.memory + (size_t)(3 * j + 1) * s->count,
                                  made.memory + (size_t)(3 * j + 2) * s->count};
        for (size_t t = 0; t < s->count; t++)
            for (int a = 0; a < 3; a++)
                stream[a][t] = s->triangles[t].u[j][a];
        made.soup.x[j] = stream[0];
        made.soup.y[j] = stream[1];
        made.soup.z[j] = stream[2];
    }
    return made;
}

void streams_free(streams *s) { free(s->memory); }
