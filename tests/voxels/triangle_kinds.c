#include "triangle_kinds.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "common/contact.h"

/* Points are drawn in cells, p[vertex][axis]; whole numbers are planes, and become the very floats of the planes. */
static void map(const grid_planes *l, double p[3][3], float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            u[j][a] = grid_planes_place(&l->grid, a, p[j][a]);
}

static int size_of(const grid_planes *l, int a) { return (int)l->grid.size[a]; }

static double power(random_source *r, double least, double most) { return exp2(random_double(r, least, most)); }

/* On a plane, at a quarter of a cell, or anywhere. */
static double draw_along(random_source *r, const grid_planes *l, int a)
{
    switch (random_int(r, 4)) {
    case 0:
        return random_int_between(r, -1, size_of(l, a) + 1);
    case 1:
        return random_int_between(r, -2, 4 * size_of(l, a) + 2) / 4.0;
    default:
        return random_double(r, -1, size_of(l, a) + 1);
    }
}

static void draw_anchor(random_source *r, const grid_planes *l, double c[3])
{
    for (int a = 0; a < 3; a++)
        c[a] = draw_along(r, l, a);
}

static void draw_about(random_source *r, const grid_planes *l, double radius, float u[3][3])
{
    double c[3], p[3][3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = c[a] + random_double(r, -radius, radius);
    map(l, p, u);
}

static void draw_tiny(random_source *r, const grid_planes *l, float u[3][3]) { draw_about(r, l, power(r, -14, -1), u); }
static void draw_few(random_source *r, const grid_planes *l, float u[3][3]) { draw_about(r, l, power(r, -1, 1), u); }
static void draw_tens(random_source *r, const grid_planes *l, float u[3][3]) { draw_about(r, l, power(r, 2, 5), u); }

static void draw_whole(random_source *r, const grid_planes *l, float u[3][3])
{
    double p[3][3];
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = random_double(r, -1, size_of(l, a) + 1);
    map(l, p, u);
}

/* The anchor lies inside, on an edge or at a vertex. */
static void draw_through(random_source *r, const grid_planes *l, double radius, float u[3][3])
{
    double c[3], p[3][3], w[3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        w[j] = random_int(r, 4) ? random_double(r, 0.05, 1) : 0;
    w[2] += w[2] <= 0;
    for (int a = 0; a < 3; a++) {
        const double d0 = random_double(r, -radius, radius), d1 = random_double(r, -radius, radius);
        p[0][a] = c[a] + d0;
        p[1][a] = c[a] + d1;
        p[2][a] = c[a] - (w[0] * d0 + w[1] * d1) / w[2];
    }
    map(l, p, u);
}

static void draw_larger(random_source *r, const grid_planes *l, float u[3][3]) { draw_through(r, l, power(r, 5, 10), u); }
static void draw_million(random_source *r, const grid_planes *l, float u[3][3]) { draw_through(r, l, power(r, 18, 23), u); }

/* Long on one axis, within a row of cells on the others. */
static void draw_row(random_source *r, const grid_planes *l, float u[3][3])
{
    const int along = random_int(r, 5) % 3;
    const double length = power(r, 0, 9), across = power(r, -10, 0.5);
    double c[3], p[3][3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = c[a] + (a == along ? random_double(r, -length, length) : random_double(r, -across, across));
    map(l, p, u);
}

/* Thin on one axis, often with no thickness at all. */
static void draw_layer(random_source *r, const grid_planes *l, float u[3][3])
{
    const int flat = random_int(r, 3);
    const double across = power(r, 0, 6), thickness = random_int(r, 2) ? 0 : power(r, -8, 0);
    double c[3], p[3][3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = c[a] + (a == flat ? random_double(r, -thickness, thickness) : random_double(r, -across, across));
    map(l, p, u);
}

/* An edge of slope 2^-k, so that it crosses from row to row within the length of many cells, or never. */
static void draw_slope(random_source *r, const grid_planes *l, float u[3][3])
{
    const int along = random_int(r, 4) % 3;
    const double length = power(r, 2, 9);
    double p[3][3];
    draw_anchor(r, l, p[0]);
    for (int a = 0; a < 3; a++) {
        const double slope = a == along ? 1 : random_int(r, 3) ? ldexp(random_int_between(r, -3, 3), -random_int(r, 24)) : 0;
        p[1][a] = p[0][a] + slope * (random_int(r, 2) ? length : floor(length));
        p[2][a] = p[0][a] + (random_int(r, 3) ? random_double(r, -3, 3) : random_int_between(r, -3, 3));
    }
    map(l, p, u);
}

/* A plane all but parallel to a plane of the grid. */
static void draw_tilted(random_source *r, const grid_planes *l, float u[3][3])
{
    const int normal = random_int(r, 3);
    const double across = power(r, 1, 8);
    double c[3], tilt[3], p[3][3];
    draw_anchor(r, l, c);
    for (int a = 0; a < 3; a++)
        tilt[a] = random_int(r, 3) ? ldexp(random_int_between(r, -3, 3), -random_int_between(r, 3, 26)) : 0;
    for (int j = 0; j < 3; j++) {
        for (int a = 0; a < 3; a++)
            p[j][a] = c[a] + random_double(r, -across, across);
        p[j][normal] = c[normal];
        for (int a = 0; a < 3; a++)
            p[j][normal] += a == normal ? 0 : tilt[a] * (p[j][a] - c[a]);
    }
    map(l, p, u);
}

/* One edge of nearly no length. */
static void draw_needle(random_source *r, const grid_planes *l, float u[3][3])
{
    const double length = power(r, -2, 8), width = length * power(r, -26, -8);
    double p[3][3];
    draw_anchor(r, l, p[0]);
    for (int a = 0; a < 3; a++) {
        p[1][a] = p[0][a] + random_double(r, -length, length);
        p[2][a] = p[1][a] + random_double(r, -width, width);
    }
    map(l, p, u);
}

/* A vertex all but on the edge of the other two. */
static void draw_cap(random_source *r, const grid_planes *l, float u[3][3])
{
    const double length = power(r, -2, 8), height = length * power(r, -26, -8), t = random_double(r, 0, 1);
    double p[3][3];
    draw_anchor(r, l, p[0]);
    for (int a = 0; a < 3; a++) {
        p[1][a] = p[0][a] + random_double(r, -length, length);
        p[2][a] = p[0][a] + t * (p[1][a] - p[0][a]) + random_double(r, -height, height);
    }
    map(l, p, u);
}

/* Along an axis, from lattice point to lattice point, or any; the third vertex is one of the others, or halfway. */
static void draw_segment(random_source *r, const grid_planes *l, float u[3][3])
{
    const int kind = random_int(r, 3), along = random_int(r, 3);
    const double length = power(r, 0, 7);
    double p[3][3];
    draw_anchor(r, l, p[0]);
    for (int a = 0; a < 3; a++) {
        if (kind == 1)
            p[0][a] = floor(p[0][a]);
        const double step = random_double(r, -length, length);
        p[1][a] = p[0][a] + (kind == 1 ? random_int_between(r, -6, 6) : kind == 2 || a == along ? step : 0);
    }
    const int third = random_int(r, 3);
    for (int a = 0; a < 3; a++)
        p[2][a] = third < 2 ? p[third][a] : (p[0][a] + p[1][a]) / 2;
    map(l, p, u);
}

static void draw_point(random_source *r, const grid_planes *l, float u[3][3])
{
    double p[3][3];
    draw_anchor(r, l, p[0]);
    memcpy(p[1], p[0], sizeof p[0]);
    memcpy(p[2], p[0], sizeof p[0]);
    map(l, p, u);
}

/* Three points of the lattice, or of one 2^k times as fine: it touches corners, edges and faces of cells exactly. */
static void draw_lattice_points(random_source *r, const grid_planes *l, float u[3][3])
{
    const int fine = random_int(r, 2) ? 1 : 1 << random_int(r, 4), reach = random_int(r, 2) ? 4 : 40;
    double c[3], p[3][3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = floor(c[a]) + random_int_between(r, -reach, reach) / (double)fine;
    map(l, p, u);
}

/* The same with vertices far beyond the grid: a plane through many of its corners. */
static void draw_lattice_plane(random_source *r, const grid_planes *l, float u[3][3])
{
    double c[3], p[3][3];
    int e[2][3];
    draw_anchor(r, l, c);
    for (int a = 0; a < 3; a++) {
        e[0][a] = random_int_between(r, -4, 4);
        e[1][a] = random_int_between(r, -4, 4);
    }
    const int far = 1 << random_int_between(r, 3, 10);
    for (int a = 0; a < 3; a++) {
        p[0][a] = floor(c[a]) + far * e[0][a];
        p[1][a] = floor(c[a]) + far * e[1][a];
        p[2][a] = floor(c[a]) - far * (e[0][a] + e[1][a]);
    }
    map(l, p, u);
}

/* All of it in one plane of the grid. */
static void draw_on_plane(random_source *r, const grid_planes *l, float u[3][3])
{
    const int flat = random_int(r, 3), plane = random_int_between(r, 0, size_of(l, flat));
    const bool is_whole = random_int(r, 2);
    const double across = power(r, 0, 6);
    double c[3], p[3][3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            const double at = c[a] + random_double(r, -across, across);
            p[j][a] = a == flat ? plane : is_whole ? floor(at) : at;
        }
    map(l, p, u);
}

/* An edge along a line of the grid. */
static void draw_on_line(random_source *r, const grid_planes *l, float u[3][3])
{
    const int along = random_int(r, 3);
    const double length = power(r, 0, 7);
    double p[3][3];
    for (int a = 0; a < 3; a++) {
        p[0][a] = random_int_between(r, 0, size_of(l, a));
        p[1][a] = p[0][a] + (a == along ? random_double(r, -length, length) : 0);
        p[2][a] = p[0][a] + (random_int(r, 2) ? random_double(r, -3, 3) : random_int_between(r, -3, 3));
    }
    map(l, p, u);
}

/* An edge through corners of the grid, across faces or across cells. */
static void draw_diagonal(random_source *r, const grid_planes *l, float u[3][3])
{
    const int length = random_int_between(r, 1, 60);
    double p[3][3];
    for (int a = 0; a < 3; a++) {
        p[0][a] = random_int_between(r, -2, size_of(l, a) + 2);
        p[1][a] = p[0][a] + length * random_int_between(r, -1, 1);
        p[2][a] = p[0][a] + (random_int(r, 2) ? random_double(r, -9, 9) : random_int_between(r, -9, 9));
    }
    map(l, p, u);
}

/* Touching one cell from outside, up to rounding, with a face, an edge, a corner or its own plane. */
static void draw_touching(random_source *r, const grid_planes *l, float u[3][3])
{
    int at[3];
    for (int a = 0; a < 3; a++)
        at[a] = random_int(r, size_of(l, a));
    const tribox_box cell = grid_planes_cell(l, at[0], at[1], at[2]);
    const double *const length = l->grid.cell;
    const bool is_cubic = length[0] == length[1] && length[0] == length[2];
    const contact_style style = {.step = is_cubic && random_int(r, 2) ? length[0] / 4 : 0,
                                 .size = length[random_int(r, 3)] * power(r, -3, 5)};
    draw_contact(r, &cell, style, any_contact_part(r), u);
}

/* Just outside of the grid on one axis, or just on its outermost planes. */
static void draw_beside(random_source *r, const grid_planes *l, float u[3][3])
{
    const int axis = random_int(r, 3), side = random_int(r, 2);
    const float limit = grid_planes_place(&l->grid, axis, side ? size_of(l, axis) : 0);
    draw_about(r, l, power(r, 0, 6), u);
    const int touching = random_int(r, 8);
    for (int j = 0; j < 3; j++) {
        u[j][axis] = side ? fmaxf(u[j][axis], limit) : fminf(u[j][axis], limit);
        if (touching >> j & 1)
            u[j][axis] = limit;
    }
    if (random_int(r, 2))
        for (int j = 0; j < 3; j++)
            u[j][axis] = nextafterf(u[j][axis], side ? FLT_MAX : -FLT_MAX);
}

/* From cell to hundreds of cells, another length on each axis. */
static void draw_own_lengths(random_source *r, const grid_planes *l, float u[3][3])
{
    double c[3], p[3][3];
    draw_anchor(r, l, c);
    for (int a = 0; a < 3; a++) {
        const double length = power(r, -20, 20);
        for (int j = 0; j < 3; j++)
            p[j][a] = c[a] + random_double(r, -length, length);
    }
    map(l, p, u);
}

/* Each number a plane of the grid, zero, the least float or an end of the float range. */
static void draw_extremes(random_source *r, const grid_planes *l, float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            const float choice[] = {FLT_MAX, -FLT_MAX, 0x1p-149f, -0x1p-149f, 0, FLT_MIN};
            const int n = random_int(r, 12);
            u[j][a] = n < 6 ? choice[n] : grid_planes_place(&l->grid, a, random_int(r, size_of(l, a) + 1));
        }
}

static void draw_random_bits(random_source *r, const grid_planes *l, float u[3][3])
{
    (void)l;
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            do {
                const uint32_t bits = (uint32_t)random_bits(r);
                memcpy(&u[j][a], &bits, sizeof bits);
            } while (!isfinite(u[j][a]));
}

static const triangle_kind kinds[] = {
    {"tiny", draw_tiny, true},
    {"few", draw_few, true},
    {"tens", draw_tens, true},
    {"whole", draw_whole, true},
    {"larger", draw_larger, true},
    {"million", draw_million, true},
    {"row", draw_row, true},
    {"layer", draw_layer, true},
    {"slope", draw_slope, true},
    {"tilted", draw_tilted, true},
    {"needle", draw_needle, true},
    {"cap", draw_cap, true},
    {"segment", draw_segment, true},
    {"point", draw_point, true},
    {"lattice points", draw_lattice_points, true},
    {"lattice plane", draw_lattice_plane, true},
    {"on plane", draw_on_plane, true},
    {"on line", draw_on_line, true},
    {"diagonal", draw_diagonal, true},
    {"touching", draw_touching, true},
    {"beside", draw_beside, true},
    {"own lengths", draw_own_lengths, true},
    {"extremes", draw_extremes, false},
    {"random bits", draw_random_bits, false},
};

size_t triangle_kind_count(void) { return sizeof kinds / sizeof kinds[0]; }

const triangle_kind *triangle_kind_at(size_t i) { return &kinds[i]; }

void draw_triangle(random_source *r, const triangle_kind *s, const grid_planes *l, float u[3][3])
{
    s->draw(r, l, u);
    const int ulps = random_int(r, 4) ? 0 : random_int_between(r, 1, 3);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            if (ulps)
                u[j][a] = nudged(r, u[j][a], ulps);
            u[j][a] = random_sign_of_zero(r, u[j][a]);
        }
}
