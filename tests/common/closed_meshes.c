#include "closed_meshes.h"

#include <math.h>
#include <stdbool.h>

/* On the unit sphere. Symmetric in its arguments to the last bit: both neighbours of an edge make the same vertex. */
static void middle(const double a[3], const double b[3], double m[3])
{
    for (int k = 0; k < 3; k++)
        m[k] = a[k] + b[k];
    const double length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    for (int k = 0; k < 3; k++)
        m[k] /= length;
}

static void put_patch(const closed_mesh_sink *to, int levels, const double a[3], const double b[3], const double c[3])
{
    if (!levels) {
        to->put(to->mesh, a, b, c);
        return;
    }
    double ab[3], bc[3], ca[3];
    middle(a, b, ab);
    middle(b, c, bc);
    middle(c, a, ca);
    put_patch(to, levels - 1, a, ab, ca);
    put_patch(to, levels - 1, b, bc, ab);
    put_patch(to, levels - 1, c, ca, bc);
    put_patch(to, levels - 1, ab, bc, ca);
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

void closed_icosphere(const closed_mesh_sink *to, int levels)
{
    enum { VERTICES = 12 };
    double v[VERTICES][3];
    for (int k = 0; k < VERTICES; k++)
        icosahedron_vertex(k, v[k]);
    for (int a = 0; a < VERTICES; a++)
        for (int b = a + 1; b < VERTICES; b++)
            for (int c = b + 1; c < VERTICES; c++)
                if (is_edge(v[a], v[b]) && is_edge(v[b], v[c]) && is_edge(v[c], v[a])) {
                    const bool is_outward = volume(v[a], v[b], v[c]) > 0;
                    put_patch(to, levels, v[a], is_outward ? v[b] : v[c], is_outward ? v[c] : v[b]);
                }
}

static void put_quad(const closed_mesh_sink *to, double v[4][3])
{
    to->put(to->mesh, v[0], v[1], v[2]);
    to->put(to->mesh, v[0], v[2], v[3]);
}

static void torus_vertex(int i, int around, int j, int across, double tube, double v[3])
{
    const double turn = 8 * atan(1), p = turn * (i % around) / around, q = turn * (j % across) / across;
    const double ring = 1 - tube + tube * cos(q);
    v[0] = ring * cos(p);
    v[1] = ring * sin(p);
    v[2] = tube * sin(q);
}

void closed_torus(const closed_mesh_sink *to, int around, int across, double tube)
{
    for (int i = 0; i < around; i++)
        for (int j = 0; j < across; j++) {
            double v[4][3];
            for (int k = 0; k < 4; k++)
                torus_vertex(i + (k == 1 || k == 2), around, j + k / 2, across, tube, v[k]);
            put_quad(to, v);
        }
}

static void globe_vertex(int i, int around, int j, int across, double v[3])
{
    const double turn = 8 * atan(1), p = turn * (i % around) / around, q = turn / 2 * j / across;
    const double ring = j % across ? sin(q) : 0;
    v[0] = ring * cos(p);
    v[1] = ring * sin(p);
    v[2] = cos(q);
}

void closed_globe(const closed_mesh_sink *to, int around, int across)
{
    for (int i = 0; i < around; i++)
        for (int j = 0; j < across; j++) {
            double v[4][3];
            for (int k = 0; k < 4; k++)
                globe_vertex(i + (k == 1 || k == 2), around, j + k / 2, across, v[k]);
            put_quad(to, v);
        }
}

static void cube_vertex(int face, int i, int j, int steps, double v[3])
{
    const int axis = face % 3;
    const bool is_upper = face >= 3;
    v[axis] = is_upper ? 1 : -1;
    v[(axis + 1) % 3] = 2.0 * (is_upper ? i : j) / steps - 1;
    v[(axis + 2) % 3] = 2.0 * (is_upper ? j : i) / steps - 1;
}

void closed_cube(const closed_mesh_sink *to, int steps)
{
    for (int face = 0; face < 6; face++)
        for (int i = 0; i < steps; i++)
            for (int j = 0; j < steps; j++) {
                double v[4][3];
                for (int k = 0; k < 4; k++)
                    cube_vertex(face, i + (k == 1 || k == 2), j + k / 2, steps, v[k]);
                put_quad(to, v);
            }
}

const char *closed_any(const closed_mesh_sink *to, random_source *r)
{
    switch (random_int(r, 4)) {
    case 0:
        closed_icosphere(to, random_int(r, 3));
        return "icosphere";
    case 1:
        closed_torus(to, random_int_between(r, 3, 12), random_int_between(r, 3, 8), random_double(r, 0.1, 0.4));
        return "torus";
    case 2:
        closed_cube(to, random_int_between(r, 1, 4));
        return "cube";
    default:
        closed_globe(to, random_int_between(r, 3, 9), random_int_between(r, 2, 7));
        return "globe";
    }
}
