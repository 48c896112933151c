#include "kinds.h"

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

static double power(random_source *r, const double between[2]) { return exp2(random_double(r, between[0], between[1])); }

static double about_zero(random_source *r, double radius) { return random_double(r, -radius, radius); }

/* A plane of the window, or one so many beside it. */
static double draw_plane(random_source *r, const cells_case *c, int a, int beside)
{
    return (double)c->at.first[a] + random_int_between(r, -beside, (int)c->at.size[a] + beside);
}

/* On a plane, at a quarter of a cell, or anywhere in the window. */
static void draw_anchor(random_source *r, const cells_case *c, double at[3])
{
    for (int a = 0; a < 3; a++)
        switch (random_int(r, 4)) {
        case 0:
            at[a] = draw_plane(r, c, a, 1);
            break;
        case 1:
            at[a] = c->at.first[a] + random_int_between(r, -2, 4 * (int)c->at.size[a] + 2) / 4.0;
            break;
        default:
            at[a] = c->at.first[a] + random_double(r, -1, c->at.size[a] + 1.0);
        }
}

static void draw_radii(random_source *r, const triangle_kind *s, double radius[3])
{
    const int axis = random_int(r, 3);
    for (int a = 0; a < 3; a++)
        radius[a] = power(r, a == axis ? s->along : s->across);
}

static void draw_about(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    double at[3], radius[3];
    draw_anchor(r, c, at);
    draw_radii(r, s, radius);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = at[a] + about_zero(r, radius[a]);
}

/* Anywhere in the grid. */
static void draw_whole(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    (void)s;
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = random_double(r, -1, c->grid.size[a] + 1.0);
}

/* The point lies inside, on an edge or at a vertex. */
static void put_through(random_source *r, const double at[3], const double radius[3], double p[3][3])
{
    double w[3];
    for (int j = 0; j < 3; j++)
        w[j] = random_int(r, 4) ? random_double(r, 0.05, 1) : 0;
    w[2] += w[2] <= 0;
    for (int a = 0; a < 3; a++) {
        const double d0 = about_zero(r, radius[a]), d1 = about_zero(r, radius[a]);
        p[0][a] = at[a] + d0;
        p[1][a] = at[a] + d1;
        p[2][a] = at[a] - (w[0] * d0 + w[1] * d1) / w[2];
    }
}

static void draw_through(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    double at[3], radius[3];
    draw_anchor(r, c, at);
    draw_radii(r, s, radius);
    put_through(r, at, radius, p);
}

/* On each axis within a cell, over a few, over more than float takes at a time, or over all of the grid. */
static void draw_across(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    double at[3], radius[3];
    (void)s;
    draw_anchor(r, c, at);
    for (int a = 0; a < 3; a++)
        radius[a] = (const double[]){0.1, 3, 28, 0.5 * c->grid.size[a]}[random_int(r, 4)];
    put_through(r, at, radius, p);
}

/* Vertices in the first cell of a span, in the last and between, of one way of the library or the next; about the ends of words. */
static void draw_span(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    static const int lengths[] = {1, 2, 3, 4, 5, 8, 9, 31, 32, 33};
    (void)s;
    for (int a = 0; a < 3; a++) {
        const int length = lengths[random_int(r, random_int(r, 4) ? 7 : 10)], *const vertex = permutations[random_int(r, ORDERS)];
        int first = random_int_between(r, -length, (int)c->at.size[a]);
        if (a == 0 && random_int(r, 2))
            first = first / 32 * 32 + random_int_between(r, 0, 3) - (random_int(r, 2) ? length + 1 : 1);
        const int cell[3] = {first, first + length - 1, random_int_between(r, first, first + length - 1)};
        for (int j = 0; j < 3; j++)
            p[vertex[j]][a] =
                (double)c->at.first[a] + cell[j] + (random_int(r, 2) ? random_int(r, 3) / 2.0 : random_double(r, 0, 1));
        if (length == 1 && random_int(r, 4) == 0)
            p[0][a] = p[1][a] = p[2][a];
    }
}

/* Far smaller than a cell, about the corner of cells that is next to zero, where floats may be fine enough for that. */
static void draw_speck(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    (void)s;
    for (int a = 0; a < 3; a++) {
        const double zero = round(-c->grid.origin[a] / c->grid.cell[a]) - c->at.first[a];
        const double plane = cells_place(c, a, c->at.first[a] + fmin(fmax(zero, 0), c->at.size[a]));
        const double radius = ldexp(c->grid.cell[a], -random_int(r, 130));
        for (int j = 0; j < 3; j++)
            p[j][a] = plane + (random_int(r, 4) ? about_zero(r, radius) : random_int_between(r, -1, 1) * 0x1p-149);
    }
}

/* An edge of slope 2^-k, so that it crosses from row to row within the length of many cells, or never. */
static void draw_slope(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    const int along = random_int(r, 4) % 3;
    const double length = power(r, s->along);
    draw_anchor(r, c, p[0]);
    for (int a = 0; a < 3; a++) {
        const double slope = a == along ? 1 : random_int(r, 3) ? ldexp(random_int_between(r, -3, 3), -random_int(r, 24)) : 0;
        p[1][a] = p[0][a] + slope * (random_int(r, 2) ? length : floor(length));
        p[2][a] = p[0][a] + (random_int(r, 3) ? about_zero(r, 3) : random_int_between(r, -3, 3));
    }
}

/* A plane all but parallel to a plane of the grid. */
static void draw_tilted(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    const int normal = random_int(r, 3);
    const double across = power(r, s->along);
    double at[3], tilt[3];
    draw_anchor(r, c, at);
    for (int a = 0; a < 3; a++)
        tilt[a] = random_int(r, 3) ? ldexp(random_int_between(r, -3, 3), -random_int_between(r, 3, 26)) : 0;
    for (int j = 0; j < 3; j++) {
        for (int a = 0; a < 3; a++)
            p[j][a] = at[a] + about_zero(r, across);
        p[j][normal] = at[normal];
        for (int a = 0; a < 3; a++)
            p[j][normal] += a == normal ? 0 : tilt[a] * (p[j][a] - at[a]);
    }
}

/* A vertex all but at another one, or on the edge of the other two. */
static void draw_thin(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    const double length = power(r, s->along), width = length * power(r, s->across),
                 t = random_int(r, 2) ? 1 : random_double(r, 0, 1);
    draw_anchor(r, c, p[0]);
    for (int a = 0; a < 3; a++) {
        p[1][a] = p[0][a] + about_zero(r, length);
        p[2][a] = p[0][a] + t * (p[1][a] - p[0][a]) + about_zero(r, width);
    }
}

/* Along an axis, from lattice point to lattice point, or any; the third vertex is one of the others, or halfway. Or a point. */
static void draw_segment(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    const int kind = random_int(r, 4), along = random_int(r, 3), third = random_int(r, 3);
    const double length = power(r, s->along);
    draw_anchor(r, c, p[0]);
    for (int a = 0; a < 3; a++) {
        if (kind == 1)
            p[0][a] = floor(p[0][a]);
        const double step = about_zero(r, length);
        p[1][a] = p[0][a] + (kind == 1 ? random_int_between(r, -6, 6) : kind == 2 || (kind == 0 && a == along) ? step : 0);
        p[2][a] = third < 2 ? p[third][a] : (p[0][a] + p[1][a]) / 2;
    }
}

/* Three points of the lattice, or of one 2^k times as fine: it touches corners, edges and faces of cells exactly. */
static void draw_lattice_points(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    const int fine = random_int(r, 2) ? 1 : 1 << random_int(r, 4), reach = random_int(r, 2) ? 4 : 40;
    double at[3];
    (void)s;
    draw_anchor(r, c, at);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            p[j][a] = floor(at[a]) + random_int_between(r, -reach, reach) / (double)fine;
}

/* The same with vertices far beyond the grid: a plane through many of its corners. */
static void draw_lattice_plane(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    const double far = floor(power(r, s->along));
    double at[3];
    draw_anchor(r, c, at);
    for (int a = 0; a < 3; a++) {
        const int one = random_int_between(r, -4, 4), other = random_int_between(r, -4, 4);
        p[0][a] = floor(at[a]) + far * one;
        p[1][a] = floor(at[a]) + far * other;
        p[2][a] = floor(at[a]) - far * (one + other);
    }
}

/* All of it in one plane of the grid. */
static void draw_on_plane(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    const int flat = random_int(r, 3);
    const double plane = draw_plane(r, c, flat, 0), across = power(r, s->along);
    const bool is_whole = random_int(r, 2);
    double from[3];
    draw_anchor(r, c, from);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            const double at = from[a] + about_zero(r, across);
            p[j][a] = a == flat ? plane : is_whole ? floor(at) : at;
        }
}

/* An edge along a line of the grid, or through its corners across faces or cells. */
static void draw_on_line(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    const int along = random_int(r, 6);
    const double any = power(r, s->along), length = along < 3 ? any : floor(any);
    for (int a = 0; a < 3; a++) {
        p[0][a] = draw_plane(r, c, a, 2);
        p[1][a] = p[0][a] + length * (along < 3 ? a == along : random_int_between(r, -1, 1));
        p[2][a] = p[0][a] + (random_int(r, 2) ? about_zero(r, 9) : random_int_between(r, -9, 9));
    }
}

/* Touching one cell from outside, up to rounding, with a face, an edge, a corner or its own plane. */
static void draw_touching(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    uint32_t at[3];
    for (int a = 0; a < 3; a++)
        at[a] = (uint32_t)random_below(r, c->at.size[a]);
    const tribox_box cell = cells_box(c, at);
    const double *const length = c->grid.cell;
    const bool is_cubic = length[0] == length[1] && length[0] == length[2];
    const contact_style style = {.step = is_cubic && random_int(r, 2) ? length[0] / 4 : 0,
                                 .size = length[random_int(r, 3)] * power(r, s->along)};
    draw_contact_f64(r, &cell, style, any_contact_part(r), p);
}

/* Just outside of the window on one axis, or just on its outermost planes. */
static void draw_beside(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    const int axis = random_int(r, 3), side = random_int(r, 2), touching = random_int(r, 8), steps = random_int(r, 2);
    const double limit = cells_place(c, axis, (double)c->at.first[axis] + (side ? c->at.size[axis] : 0));
    draw_about(r, s, c, p);
    place(c, p);
    for (int j = 0; j < 3; j++) {
        const double at = touching >> j & 1 ? limit : side ? fmax(p[j][axis], limit) : fmin(p[j][axis], limit);
        p[j][axis] = moved(c, at, side ? steps : -steps);
    }
}

/* Each number a plane of the grid, zero, the least float or an end of the float range. */
static void draw_extremes(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    static const double choice[] = {FLT_MAX, -FLT_MAX, 0x1p-149, -0x1p-149, 0, FLT_MIN};
    (void)s;
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            const int n = random_int(r, 12);
            p[j][a] = n < 6 ? choice[n] : cells_place(c, a, draw_plane(r, c, a, 0));
        }
}

static void draw_random_bits(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    (void)s, (void)c;
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
static double draw_coordinate(random_source *r, const cells_case *c, int a, double least, double most)
{
    const double at = random_double(r, least, most);
    const int way = random_int(r, 8);
    const double plane = cells_place(c, a, way < 5 ? floor(at) : at);
    if (way == 4) {
        const double beside = plane + c->grid.cell[a] * ldexp(draw_number(r), random_int_between(r, -60, -15));
        return isfinite(beside) ? beside : plane;
    }
    return way == 3 ? moved(c, plane, random_int_between(r, -2, 2)) : plane;
}

/* The last vertex next to the edge of the others, by what float can tell or not. */
static void draw_sliver(random_source *r, const cells_case *c, double p[3][3])
{
    const double at = random_int(r, 2) ? random_double(r, 0, 1) : random_int(r, 9) / 8.0;
    const int exponent = random_int_between(r, -45, -4);
    for (int a = 0; a < 3; a++) {
        const double x = p[0][a] + at * (p[1][a] - p[0][a]) + c->grid.cell[a] * ldexp(draw_number(r), exponent);
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
static void draw_of_all(random_source *r, const triangle_kind *s, const cells_case *c, double p[3][3])
{
    (void)s;
    static const double lengths[] = {0.3, 1.5, 3, 8, 40, 100};
    const double length = lengths[random_int(r, 6)];
    for (int a = 0; a < 3; a++) {
        const double from = c->at.first[a] + random_double(r, -2, c->at.size[a] + 1.0),
                     to = from + (random_int(r, 4) ? length : 0.2);
        for (int j = 0; j < 3; j++)
            p[j][a] = j && !random_int(r, 4) ? p[j - 1][a] : draw_coordinate(r, c, a, from, to);
    }
    if (!random_int(r, 20))
        memcpy(p[2], p[random_int(r, 2)], sizeof p[2]);
    if (!random_int(r, 6))
        draw_sliver(r, c, p);
    if (!random_int(r, 10))
        draw_extreme(r, p);
}

static const triangle_kind kinds[] = {
    {"across", draw_across, true, true, {0}, {0}},
    {"tiny", draw_about, true, true, {-14, -1}, {-14, -1}},
    {"few", draw_about, true, true, {-1, 1}, {-1, 1}},
    {"tens", draw_about, true, true, {2, 5}, {2, 5}},
    {"row", draw_about, true, true, {0, 9}, {-10, 0.5}},
    {"layer", draw_about, true, true, {-8, 0}, {0, 6}},
    {"flat", draw_about, true, true, {-2000, -2000}, {0, 6}},
    {"own lengths", draw_about, true, true, {-20, 20}, {-20, 20}},
    {"whole", draw_whole, true, true, {0}, {0}},
    {"larger", draw_through, true, true, {5, 10}, {5, 10}},
    {"million", draw_through, true, true, {18, 23}, {18, 23}},
    {"span", draw_span, true, true, {0}, {0}},
    {"speck", draw_speck, false, false, {0}, {0}},
    {"slope", draw_slope, true, true, {2, 9}, {0}},
    {"tilted", draw_tilted, true, true, {1, 8}, {0}},
    {"thin", draw_thin, true, true, {-2, 8}, {-26, -8}},
    {"segment", draw_segment, true, true, {0, 7}, {0}},
    {"lattice points", draw_lattice_points, true, true, {0}, {0}},
    {"lattice plane", draw_lattice_plane, true, true, {3, 10}, {0}},
    {"on plane", draw_on_plane, true, true, {0, 6}, {0}},
    {"on line", draw_on_line, true, true, {0, 7}, {0}},
    {"touching", draw_touching, true, false, {-3, 5}, {0}},
    {"beside", draw_beside, true, false, {0, 6}, {0, 6}},
    {"extremes", draw_extremes, false, false, {0}, {0}},
    {"random bits", draw_random_bits, false, false, {0}, {0}},
    {"all", draw_of_all, false, false, {0}, {0}},
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
    s->draw(r, s, c, u);
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
        if (!random_int(r, 40))
            u[random_int(r, 3)][random_int(r, 3)] = random_int(r, 2) ? (double)NAN : random_int(r, 2) ? INFINITY : -INFINITY;
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
    const int cuboids = random_int(r, 3) ? 0 : 4;
    if (!cuboids)
        closed_any(&to, r);
    for (int k = 0; k < cuboids; k++)
        put_cuboid(r, &at);
}
