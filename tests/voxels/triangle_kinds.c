#include "triangle_kinds.h"

#include <float.h>
#include <math.h>

#include "common/closed_meshes.h"
#include "common/contact.h"

/* Points are drawn in cells, p[vertex][axis]; whole numbers are planes, and become the very numbers of the planes. */
static void place(const cells_case *c, double p[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = cells_place(c, a, p[j][a]);
}

/* Some numbers further up or down, never to infinity. */
static double moved(const cells_case *c, double x, int steps)
{
    const double end = steps < 0 ? -DBL_MAX : DBL_MAX;
    for (int n = 0; n < (steps < 0 ? -steps : steps); n++)
        x = c->is_double ? nextafter(x, end) : (double)nextafterf((float)x, steps < 0 ? -FLT_MAX : FLT_MAX);
    return x;
}

static int size_of(const cells_case *l, int a) { return (int)l->grid.size[a]; }

static double power(random_source *r, double least, double most) { return exp2(random_double(r, least, most)); }

/* On a plane, at a quarter of a cell, or anywhere. */
static double draw_along(random_source *r, const cells_case *l, int a)
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

static void draw_anchor(random_source *r, const cells_case *l, double c[3])
{
    for (int a = 0; a < 3; a++)
        c[a] = draw_along(r, l, a);
}

static void draw_about(random_source *r, const cells_case *l, double radius, double p[3][3])
{
    double c[3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = c[a] + random_double(r, -radius, radius);
}

static void draw_tiny(random_source *r, const cells_case *l, double p[3][3]) { draw_about(r, l, power(r, -14, -1), p); }
static void draw_few(random_source *r, const cells_case *l, double p[3][3]) { draw_about(r, l, power(r, -1, 1), p); }
static void draw_tens(random_source *r, const cells_case *l, double p[3][3]) { draw_about(r, l, power(r, 2, 5), p); }

static void draw_whole(random_source *r, const cells_case *l, double p[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = random_double(r, -1, size_of(l, a) + 1);
}

/* The anchor lies inside, on an edge or at a vertex. */
static void draw_through(random_source *r, const cells_case *l, double radius, double p[3][3])
{
    double c[3], w[3];
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
}

static void draw_larger(random_source *r, const cells_case *l, double p[3][3]) { draw_through(r, l, power(r, 5, 10), p); }
static void draw_million(random_source *r, const cells_case *l, double p[3][3]) { draw_through(r, l, power(r, 18, 23), p); }

/* Long on one axis, within a row of cells on the others. */
static void draw_row(random_source *r, const cells_case *l, double p[3][3])
{
    const int along = random_int(r, 5) % 3;
    const double length = power(r, 0, 9), across = power(r, -10, 0.5);
    double c[3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = c[a] + (a == along ? random_double(r, -length, length) : random_double(r, -across, across));
}

/* Thin on one axis, often with no thickness at all. */
static void draw_layer(random_source *r, const cells_case *l, double p[3][3])
{
    const int flat = random_int(r, 3);
    const double across = power(r, 0, 6), thickness = random_int(r, 2) ? 0 : power(r, -8, 0);
    double c[3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = c[a] + (a == flat ? random_double(r, -thickness, thickness) : random_double(r, -across, across));
}

/* An edge of slope 2^-k, so that it crosses from row to row within the length of many cells, or never. */
static void draw_slope(random_source *r, const cells_case *l, double p[3][3])
{
    const int along = random_int(r, 4) % 3;
    const double length = power(r, 2, 9);
    draw_anchor(r, l, p[0]);
    for (int a = 0; a < 3; a++) {
        const double slope = a == along ? 1 : random_int(r, 3) ? ldexp(random_int_between(r, -3, 3), -random_int(r, 24)) : 0;
        p[1][a] = p[0][a] + slope * (random_int(r, 2) ? length : floor(length));
        p[2][a] = p[0][a] + (random_int(r, 3) ? random_double(r, -3, 3) : random_int_between(r, -3, 3));
    }
}

/* A plane all but parallel to a plane of the grid. */
static void draw_tilted(random_source *r, const cells_case *l, double p[3][3])
{
    const int normal = random_int(r, 3);
    const double across = power(r, 1, 8);
    double c[3], tilt[3];
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
}

/* One edge of nearly no length. */
static void draw_needle(random_source *r, const cells_case *l, double p[3][3])
{
    const double length = power(r, -2, 8), width = length * power(r, -26, -8);
    draw_anchor(r, l, p[0]);
    for (int a = 0; a < 3; a++) {
        p[1][a] = p[0][a] + random_double(r, -length, length);
        p[2][a] = p[1][a] + random_double(r, -width, width);
    }
}

/* A vertex all but on the edge of the other two. */
static void draw_cap(random_source *r, const cells_case *l, double p[3][3])
{
    const double length = power(r, -2, 8), height = length * power(r, -26, -8), t = random_double(r, 0, 1);
    draw_anchor(r, l, p[0]);
    for (int a = 0; a < 3; a++) {
        p[1][a] = p[0][a] + random_double(r, -length, length);
        p[2][a] = p[0][a] + t * (p[1][a] - p[0][a]) + random_double(r, -height, height);
    }
}

/* Along an axis, from lattice point to lattice point, or any; the third vertex is one of the others, or halfway. */
static void draw_segment(random_source *r, const cells_case *l, double p[3][3])
{
    const int kind = random_int(r, 3), along = random_int(r, 3);
    const double length = power(r, 0, 7);
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
}

static void draw_point(random_source *r, const cells_case *l, double p[3][3])
{
    draw_anchor(r, l, p[0]);
    memcpy(p[1], p[0], sizeof p[0]);
    memcpy(p[2], p[0], sizeof p[0]);
}

/* Three points of the lattice, or of one 2^k times as fine: it touches corners, edges and faces of cells exactly. */
static void draw_lattice_points(random_source *r, const cells_case *l, double p[3][3])
{
    const int fine = random_int(r, 2) ? 1 : 1 << random_int(r, 4), reach = random_int(r, 2) ? 4 : 40;
    double c[3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = floor(c[a]) + random_int_between(r, -reach, reach) / (double)fine;
}

/* The same with vertices far beyond the grid: a plane through many of its corners. */
static void draw_lattice_plane(random_source *r, const cells_case *l, double p[3][3])
{
    double c[3];
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
}

/* All of it in one plane of the grid. */
static void draw_on_plane(random_source *r, const cells_case *l, double p[3][3])
{
    const int flat = random_int(r, 3), plane = random_int_between(r, 0, size_of(l, flat));
    const bool is_whole = random_int(r, 2);
    const double across = power(r, 0, 6);
    double c[3];
    draw_anchor(r, l, c);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            const double at = c[a] + random_double(r, -across, across);
            p[j][a] = a == flat ? plane : is_whole ? floor(at) : at;
        }
}

/* An edge along a line of the grid. */
static void draw_on_line(random_source *r, const cells_case *l, double p[3][3])
{
    const int along = random_int(r, 3);
    const double length = power(r, 0, 7);
    for (int a = 0; a < 3; a++) {
        p[0][a] = random_int_between(r, 0, size_of(l, a));
        p[1][a] = p[0][a] + (a == along ? random_double(r, -length, length) : 0);
        p[2][a] = p[0][a] + (random_int(r, 2) ? random_double(r, -3, 3) : random_int_between(r, -3, 3));
    }
}

/* An edge through corners of the grid, across faces or across cells. */
static void draw_diagonal(random_source *r, const cells_case *l, double p[3][3])
{
    const int length = random_int_between(r, 1, 60);
    for (int a = 0; a < 3; a++) {
        p[0][a] = random_int_between(r, -2, size_of(l, a) + 2);
        p[1][a] = p[0][a] + length * random_int_between(r, -1, 1);
        p[2][a] = p[0][a] + (random_int(r, 2) ? random_double(r, -9, 9) : random_int_between(r, -9, 9));
    }
}

/* Touching one cell from outside, up to rounding, with a face, an edge, a corner or its own plane. */
static void draw_touching(random_source *r, const cells_case *l, double p[3][3])
{
    uint32_t at[3];
    float u[3][3];
    for (int a = 0; a < 3; a++)
        at[a] = (uint32_t)random_int(r, size_of(l, a));
    const tribox_box cell = cells_box(l, at);
    const double *const length = l->grid.cell;
    const bool is_cubic = length[0] == length[1] && length[0] == length[2];
    const contact_style style = {.step = is_cubic && random_int(r, 2) ? length[0] / 4 : 0,
                                 .size = length[random_int(r, 3)] * power(r, -3, 5)};
    draw_contact(r, &cell, style, any_contact_part(r), u);
    for (int n = 0; n < 9; n++)
        p[n / 3][n % 3] = u[n / 3][n % 3];
}

/* Just outside of the grid on one axis, or just on its outermost planes. */
static void draw_beside(random_source *r, const cells_case *l, double p[3][3])
{
    const int axis = random_int(r, 3), side = random_int(r, 2);
    const double limit = cells_place(l, axis, side ? size_of(l, axis) : 0);
    draw_about(r, l, power(r, 0, 6), p);
    place(l, p);
    const int touching = random_int(r, 8);
    for (int j = 0; j < 3; j++) {
        p[j][axis] = side ? fmax(p[j][axis], limit) : fmin(p[j][axis], limit);
        if (touching >> j & 1)
            p[j][axis] = limit;
    }
    if (random_int(r, 2))
        for (int j = 0; j < 3; j++)
            p[j][axis] = moved(l, p[j][axis], side ? 1 : -1);
}

/* From cell to hundreds of cells, another length on each axis. */
static void draw_own_lengths(random_source *r, const cells_case *l, double p[3][3])
{
    double c[3];
    draw_anchor(r, l, c);
    for (int a = 0; a < 3; a++) {
        const double length = power(r, -20, 20);
        for (int j = 0; j < 3; j++)
            p[j][a] = c[a] + random_double(r, -length, length);
    }
}

/* Each number a plane of the grid, zero, the least float or an end of the float range. */
static void draw_extremes(random_source *r, const cells_case *l, double p[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            const double choice[] = {FLT_MAX, -FLT_MAX, 0x1p-149, -0x1p-149, 0, FLT_MIN};
            const int n = random_int(r, 12);
            p[j][a] = n < 6 ? choice[n] : cells_place(l, a, random_int(r, size_of(l, a) + 1));
        }
}

static void draw_random_bits(random_source *r, const cells_case *l, double p[3][3])
{
    (void)l;
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            do {
                float number;
                const uint32_t bits = (uint32_t)random_bits(r);
                memcpy(&number, &bits, sizeof bits);
                p[j][a] = number;
            } while (!isfinite(p[j][a]));
}

static double draw_number(random_source *r) { return (random_int(r, 2) ? 1 : -1) * random_double(r, 1, 2); }

/* On a plane, a few numbers or what float can tell beside one, or anywhere. */
static double draw_coordinate(random_source *r, const cells_case *l, int a, double least, double most)
{
    const double at = random_double(r, least, most);
    const int way = random_int(r, 8);
    const double plane = cells_place(l, a, way < 5 ? floor(at) : at);
    if (way == 4) {
        const double beside = plane + l->grid.cell[a] * ldexp(draw_number(r), random_int_between(r, -60, -15));
        return isfinite(beside) ? beside : plane;
    }
    return way == 3 ? moved(l, plane, random_int_between(r, -2, 2)) : plane;
}

/* The last vertex next to the edge of the others, by what float can tell or not. */
static void draw_sliver(random_source *r, const cells_case *l, double p[3][3])
{
    const double at = random_int(r, 2) ? random_double(r, 0, 1) : random_int(r, 9) / 8.0;
    const int exponent = random_int_between(r, -45, -4);
    for (int a = 0; a < 3; a++) {
        const double x = p[0][a] + at * (p[1][a] - p[0][a]) + l->grid.cell[a] * ldexp(draw_number(r), exponent);
        p[2][a] = isfinite(x) ? x : p[0][a];
    }
}

/* Numbers near the ends of the range, or a whole axis of tiny ones. */
static void draw_extreme(random_source *r, double p[3][3])
{
    static const double far[] = {1e30, -1e30, 1e300, -1e300, DBL_MAX, -DBL_MAX, 0x1p-1074, -0x1p-1040, 1e-300};
    static const double tiny[] = {0, 0x1p-1074, -0x1p-1040, 1e-300, -1e-200, 1e-100};
    const int a = random_int(r, 3);
    if (random_int(r, 2)) {
        for (int j = 0; j < 3; j++)
            p[j][a] = tiny[random_int(r, 6)];
        return;
    }
    for (int n = random_int_between(r, 1, 3); n > 0; n--)
        p[random_int(r, 3)][random_int(r, 3)] = far[random_int(r, 9)];
}

/* On planes or next to them, within cells, far away; flat, thin, small and large ones. */
static void draw_of_all(random_source *r, const cells_case *l, double p[3][3])
{
    static const double lengths[] = {0.3, 1.5, 3, 8, 40, 100};
    const double length = lengths[random_int(r, 6)];
    for (int a = 0; a < 3; a++) {
        const double from = random_double(r, -2, l->grid.size[a] + 1.0), to = from + (random_int(r, 4) ? length : 0.2);
        for (int j = 0; j < 3; j++)
            p[j][a] = j && !random_int(r, 4) ? p[j - 1][a] : draw_coordinate(r, l, a, from, to);
    }
    if (!random_int(r, 20))
        memcpy(p[2], p[random_int(r, 2)], sizeof p[2]);
    if (!random_int(r, 6))
        draw_sliver(r, l, p);
    if (!random_int(r, 10))
        draw_extreme(r, p);
    if (l->is_double && !random_int(r, 100))
        p[random_int(r, 3)][random_int(r, 3)] = random_int(r, 2) ? NAN : INFINITY;
}

static const triangle_kind kinds[] = {
    {"tiny", draw_tiny, true, true},
    {"few", draw_few, true, true},
    {"tens", draw_tens, true, true},
    {"whole", draw_whole, true, true},
    {"larger", draw_larger, true, true},
    {"million", draw_million, true, true},
    {"row", draw_row, true, true},
    {"layer", draw_layer, true, true},
    {"slope", draw_slope, true, true},
    {"tilted", draw_tilted, true, true},
    {"needle", draw_needle, true, true},
    {"cap", draw_cap, true, true},
    {"segment", draw_segment, true, true},
    {"point", draw_point, true, true},
    {"lattice points", draw_lattice_points, true, true},
    {"lattice plane", draw_lattice_plane, true, true},
    {"on plane", draw_on_plane, true, true},
    {"on line", draw_on_line, true, true},
    {"diagonal", draw_diagonal, true, true},
    {"touching", draw_touching, true, false},
    {"beside", draw_beside, true, false},
    {"own lengths", draw_own_lengths, true, true},
    {"extremes", draw_extremes, false, false},
    {"random bits", draw_random_bits, false, false},
    {"all", draw_of_all, false, false},
};

size_t triangle_kind_count(void) { return sizeof kinds / sizeof kinds[0]; }

const triangle_kind *triangle_kind_at(size_t i) { return &kinds[i]; }

static const triangle_kind *any_triangle_kind(random_source *r, const cells_case *c)
{
    const size_t n = (size_t)random_int(r, (int)triangle_kind_count());
    return &kinds[c->is_double && random_int(r, 3) ? triangle_kind_count() - 1 : n];
}

void draw_triangle(random_source *r, const triangle_kind *s, const cells_case *c, double u[3][3])
{
    s->draw(r, c, u);
    if (s->is_in_cells)
        place(c, u);
    const int most = random_int(r, 4) ? 0 : random_int_between(r, 1, 3);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            u[j][a] = moved(c, c->is_double ? u[j][a] : (double)nearest_float(u[j][a]), random_int_between(r, -most, most));
            u[j][a] = u[j][a] != 0 ? u[j][a] : random_int(r, 2) ? -0.0 : 0.0;
        }
}

void put_triangles(random_source *r, const triangle_kind *s, size_t count, size_t cost, cells_case *c)
{
    for (size_t t = 0, asked = 0; t < count && asked < cost; t++) {
        double u[3][3];
        draw_triangle(r, s ? s : any_triangle_kind(r, c), c, u);
        cells_put(c, u);
        asked += cells_cost(c, c->count - 1, TRIBOX_AXES_ALL);
    }
}

/* A body's size and place in a grid, in cells, and where its triangles go. */
typedef struct body {
    cells_case *to;
    double centre[3], radius[3];
} body;

static void put(void *mesh, const double a[3], const double b[3], const double c[3])
{
    const body *const at = mesh;
    const double *const corner[3] = {a, b, c};
    double u[3][3];
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++)
            u[v][k] = at->centre[k] + at->radius[k] * corner[v][k];
    place(at->to, u);
    cells_put(at->to, u);
}

/* Twelve triangles between two corners, often planes of the grid. */
static void put_cuboid(random_source *r, body *at)
{
    const bool is_whole = random_int(r, 4);
    for (int a = 0; a < 3; a++) {
        double corner[2];
        for (int side = 0; side < 2; side++) {
            const double from = random_double(r, -1, (double)at->to->grid.size[a] + 1);
            corner[side] = is_whole ? floor(from) : from;
        }
        at->centre[a] = (corner[0] + corner[1]) / 2;
        at->radius[a] = (corner[1] - corner[0]) / 2;
    }
    closed_cube(&(closed_mesh_sink){put, at}, 1);
}

void put_mesh(random_source *r, cells_case *c)
{
    body at = {.to = c};
    for (int a = 0; a < 3; a++) {
        at.centre[a] = random_double(r, 0, c->grid.size[a]);
        at.radius[a] = c->grid.size[a] * random_double(r, 0.1, 0.8);
    }
    const closed_mesh_sink to = {put, &at};
    const int around = random_int_between(r, 3, 40), across = random_int_between(r, 3, 24), kind = random_int(r, 3);
    if (kind == 0)
        closed_globe(&to, around, across);
    else if (kind == 1)
        closed_torus(&to, around, across, 0.3);
    else
        for (int k = 0; k < 4; k++)
            put_cuboid(r, &at);
}
