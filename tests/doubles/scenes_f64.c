#include "scenes_f64.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "common/contact.h"

/* A triangle about as large as `size` that touches the box from outside, but for rounding. */
static void draw_contact_of(random_source *r, const tribox_box *box, double size, double u[3][3])
{
    draw_contact_f64(r, box, (contact_style){.size = size}, any_contact_part(r), u);
}

/* A triangle whose edge or plane goes through a corner of the box, or a vertex of which is one. Mostly it enters the box. */
static void draw_through_corner(random_source *r, const tribox_box *box, double size, double u[3][3])
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

/* The double that is n steps away. */
static double stepped(double x, int n)
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

/* Moves some coordinates by up to `most` doubles, or by up to `most` times `by`. */
static void nudge(random_source *r, double u[3][3], int most)
{
    for (int times = random_int(r, 4); times > 0; times--) {
        double *const x = any_number(r, u);
        *x = stepped(*x, random_int_between(r, -most, most));
    }
}

static void shift(random_source *r, double u[3][3], int most, double by)
{
    for (int times = random_int(r, 4); times > 0; times--) {
        double *const x = any_number(r, u);
        *x += by * random_int_between(r, -most, most);
    }
}

/* A box from -lo to hi, each a length between least and most. */
static tribox_box box_about_zero(random_source *r, double least, double most)
{
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = -random_double(r, least, most);
        box.hi[a] = random_double(r, least, most);
    }
    return box;
}

/* Everything times 2^exponent[a], and moved by offset[a] of that unit. */
static void place(batch_f64 *batch, const int exponent[3], const double offset[3])
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

/* Touching from outside and from inside, exactly or within rounding of double and of float. */

static void draw_contacts(random_source *r, batch_f64 *batch, double size)
{
    for (int k = 0; k < BATCH_F64; k++)
        draw_contact_of(r, &batch->box, size, batch->u[k]);
}

static void nudge_all(random_source *r, batch_f64 *batch, int most)
{
    for (int k = 0; k < BATCH_F64; k++)
        nudge(r, batch->u[k], most);
}

/* Contact that is exact where a vertex touches; elsewhere as near as doubles come. */
static void draw_touching(random_source *r, batch_f64 *batch)
{
    batch->box = box_about_zero(r, 0.1, 1);
    draw_contacts(r, batch, ldexp(1, random_int_between(r, -3, 3)));
}

static void draw_touching_ulp(random_source *r, batch_f64 *batch)
{
    draw_touching(r, batch);
    nudge_all(r, batch, 3);
}

/* Off contact by some of what a float rounds: where the first stage must not say more than it knows. */
static void draw_float_ulp(random_source *r, batch_f64 *batch)
{
    const double by = ldexp(1, random_int_between(r, -30, -21));
    draw_touching(r, batch);
    for (int k = 0; k < BATCH_F64; k++)
        shift(r, batch->u[k], 20, by);
}

/* An edge of a few units of the last place. */
static void draw_needles(random_source *r, batch_f64 *batch)
{
    batch->box = box_about_zero(r, 0.01, 1);
    for (int k = 0; k < BATCH_F64; k++) {
        double(*const u)[3] = batch->u[k];
        draw_contact_of(r, &batch->box, 2, u);
        const int j = random_int(r, 3);
        for (int a = 0; a < 3; a++)
            u[(j + 1) % 3][a] = stepped(u[j][a], random_int_between(r, -4, 4));
        nudge(r, u, 3);
    }
}

/* A scale and an offset for each axis; the offset rounds what is asked. */
static void draw_scaled(random_source *r, batch_f64 *batch)
{
    static const double offsets[] = {0, 0, 1, 1e3, 5e5, 4e6, 1e9};
    int exponent[3];
    double offset[3];
    draw_touching_ulp(r, batch);
    for (int a = 0; a < 3; a++) {
        exponent[a] = random_int_between(r, -30, 30);
        offset[a] = offsets[random_int(r, 7)];
    }
    place(batch, exponent, offset);
}

/* Triangles of any size that touch with numbers of full length. */
static void draw_rotated(random_source *r, batch_f64 *batch)
{
    batch->box = box_about_zero(r, 0.01, 1);
    draw_contacts(r, batch, ldexp(1, -random_int(r, 24)) / 3);
    nudge_all(r, batch, 3);
}

/* Through a corner, so that most enter the box. */
static void draw_corners(random_source *r, batch_f64 *batch)
{
    batch->box = box_about_zero(r, 0.01, 1);
    for (int k = 0; k < BATCH_F64; k++) {
        draw_through_corner(r, &batch->box, 2, batch->u[k]);
        nudge(r, batch->u[k], 3);
    }
}

/* Triangles so large that the box is as a point, as far as there still are floats. */
static void draw_big_triangles(random_source *r, batch_f64 *batch)
{
    batch->box = box_about_zero(r, 0.1, 1);
    draw_contacts(r, batch, ldexp(1, random_int_between(r, 10, 60)));
    nudge_all(r, batch, 3);
}

/* Small ones at corners, edges and faces of a large box. */
static void draw_big_boxes(random_source *r, batch_f64 *batch)
{
    const int exponent = random_int_between(r, 5, 40);
    batch->box = box_about_zero(r, 0.5, 1);
    place(batch, (const int[]){exponent, exponent - random_int(r, 5), exponent}, (const double[]){0, 0, 0});
    draw_contacts(r, batch, ldexp(1, -random_int(r, 20)));
    nudge_all(r, batch, 3);
}

/* Geometry as it comes, near the origin and far from it. */

static tribox_box cube(double lo, double hi) { return (tribox_box){{lo, lo, lo}, {hi, hi, hi}}; }

static void draw_all(random_source *r, batch_f64 *batch, double least, double most)
{
    for (int n = 0; n < 9 * BATCH_F64; n++)
        batch->u[n / 9][n / 3 % 3][n % 3] = random_double(r, least, most);
}

static void draw_on_lattice(random_source *r, batch_f64 *batch, double origin, double step, int least, int most)
{
    for (int n = 0; n < 9 * BATCH_F64; n++)
        batch->u[n / 9][n / 3 % 3][n % 3] = origin + step * random_int_between(r, least, most);
}

static void draw_paper(random_source *r, batch_f64 *batch)
{
    batch->box = cube(-0.5, 0.5);
    draw_all(r, batch, -2, 2);
}

/* The same ten million units away. */
static void draw_offset(random_source *r, batch_f64 *batch)
{
    batch->box = cube(1e7 - 0.5, 1e7 + 0.5);
    draw_all(r, batch, 1e7 - 2, 1e7 + 2);
}

/* Nanometres from the centre of the earth: what is asked is some units of the last place. */
static void draw_nanometres(random_source *r, batch_f64 *batch)
{
    batch->box = cube(4e6 - 2e-9, 4e6 + 2e-9);
    draw_on_lattice(r, batch, 4e6, 2e-9, -4, 3);
}

/* Small triangles that are mostly far off. */
static void draw_sparse(random_source *r, batch_f64 *batch)
{
    batch->box = cube(-0.5, 0.5);
    for (int k = 0; k < BATCH_F64; k++)
        for (int a = 0; a < 3; a++) {
            const double about = random_double(r, -1.5, 1.5);
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] = about + random_double(r, -0.2, 0.2);
        }
}

/* Quarters: contact is common. */
static void draw_lattice(random_source *r, batch_f64 *batch)
{
    batch->box = cube(-0.5, 0.5);
    draw_on_lattice(r, batch, 0, 0.25, -8, 8);
}

/* Whole units of the last place, as far away as those exist, in a unit of each axis. */
static void draw_far_lattice(random_source *r, batch_f64 *batch)
{
    int exponent[3];
    double offset[3];
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = random_int_between(r, -4, 0);
        batch->box.hi[a] = random_int_between(r, 1, 4);
        exponent[a] = random_int_between(r, -40, 40);
        offset[a] = random_int(r, 4) ? ldexp(1.5, random_int_between(r, 3, 52)) : 0;
        offset[a] = random_int(r, 2) ? offset[a] : -offset[a];
    }
    draw_on_lattice(r, batch, 0, 1, -9, 9);
    place(batch, exponent, offset);
}

static void draw_tenths(random_source *r, batch_f64 *batch)
{
    batch->box = cube(0.8, 1.7);
    for (int n = 0; n < 9 * BATCH_F64; n++)
        batch->u[n / 9][n / 3 % 3][n % 3] = random_int(r, 26) / 10.0;
}

/* Numbers that float has. */
static void draw_widened(random_source *r, batch_f64 *batch)
{
    draw_touching(r, batch);
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = (float)batch->box.lo[a];
        batch->box.hi[a] = (float)batch->box.hi[a];
        for (int k = 0; k < BATCH_F64; k++)
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] = (float)batch->u[k][j][a];
    }
}

/* A map in metres with three decimals, and cells of half a metre. */
static void draw_northings(random_source *r, batch_f64 *batch)
{
    static const double origin[3] = {500000, 4600000, 30};
    for (int a = 0; a < 3; a++) {
        const int cell = random_int(r, 1000);
        batch->box.lo[a] = origin[a] + 0.5 * cell;
        batch->box.hi[a] = origin[a] + 0.5 * (cell + 1);
        for (int k = 0; k < BATCH_F64; k++)
            for (int j = 0; j < 3; j++) {
                const int millimetres = 50 * random_int_between(r, -6, 16);
                batch->u[k][j][a] = (origin[a] * 1000 + 500 * cell + millimetres + random_int(r, 2)) / 1000;
            }
    }
}

/* Points, segments, and triangles whose vertices are in one line, with zeros of either sign. */
static void draw_degenerate(random_source *r, batch_f64 *batch)
{
    draw_touching(r, batch);
    for (int k = 0; k < BATCH_F64; k++) {
        double(*const u)[3] = batch->u[k];
        const double share = 0.25 * random_int(r, 5);
        for (int a = 0; a < 3; a++) {
            u[2][a] = k % 3 ? u[0][a] + share * (u[1][a] - u[0][a]) : u[0][a];
            if (k % 7 == 0)
                u[1][a] = u[2][a];
            if (u[2][a] == 0)
                u[2][a] = random_int(r, 2) ? 0.0 : -0.0;
        }
    }
}

/* Boxes that are flat, thin, tiny or huge; numbers on faces, and nearer to them than floats can tell. */

/* One to three sides of no length, now and then less than none. */
static void draw_flat(random_source *r, batch_f64 *batch)
{
    batch->box = box_about_zero(r, 0.01, 1);
    const int first = random_int(r, 3), sides = random_int_between(r, 1, 3);
    for (int k = 0; k < sides; k++) {
        const int a = (first + k) % 3;
        batch->box.lo[a] = random_int(r, 3) ? batch->box.hi[a] : 0;
        batch->box.hi[a] = batch->box.lo[a];
    }
    for (int k = 0; k < BATCH_F64; k++) {
        draw_contact_of(r, &batch->box, 2, batch->u[k]);
        if (k % 2)
            nudge(r, batch->u[k], 3);
    }
    if (!random_int(r, 10))
        batch->box.hi[first] = nextafter(batch->box.lo[first], -1);
}

/* A side that is thinner than the triangle by about as much as the first stage can bear, or much more. */
static void make_thin(random_source *r, batch_f64 *batch)
{
    const int thin = random_int(r, 3),
              exponent = random_int(r, 5) ? random_int_between(r, -25, -16) : random_int_between(r, -70, -26);
    int exponents[3] = {0, 0, 0};
    batch->box = box_about_zero(r, 0.3, 1);
    exponents[thin] = exponent;
    if (!random_int(r, 4))
        exponents[(thin + 1) % 3] = exponent + random_int_between(r, -2, 2);
    place(batch, exponents, (const double[]){0, 0, 0});
}

/* Somewhere, in some unit. */
static void move_away(random_source *r, batch_f64 *batch)
{
    const int exponent = random_int_between(r, -12, 12);
    const double offset = random_int(r, 2) ? random_double(r, -1e4, 1e4) : 0;
    place(batch, (const int[]){exponent, exponent, exponent}, (const double[]){offset, -offset, offset});
}

static void draw_thin(random_source *r, batch_f64 *batch)
{
    make_thin(r, batch);
    const double size = ldexp(1, random_int_between(r, -4, 3)), by = ldexp(1, random_int_between(r, -50, -20));
    for (int k = 0; k < BATCH_F64; k++) {
        draw_contact_of(r, &batch->box, size, batch->u[k]);
        if (k % 2)
            shift(r, batch->u[k], 9, by);
    }
    move_away(r, batch);
}

/* The same with vertices on the faces of the thin side and just next to them. */
static void draw_thin_faces(random_source *r, batch_f64 *batch)
{
    make_thin(r, batch);
    const double by = ldexp(1, random_int_between(r, -50, -20));
    for (int k = 0; k < BATCH_F64; k++) {
        double(*const u)[3] = batch->u[k];
        draw_through_corner(r, &batch->box, 1, u);
        for (int a = 0; a < 3; a++)
            if (batch->box.hi[a] - batch->box.lo[a] < 1e-3)
                for (int j = 0; j < 3; j++) {
                    const double face = random_int(r, 2) ? batch->box.lo[a] : batch->box.hi[a];
                    u[j][a] = face + by * random_int_between(r, -3, 3);
                }
    }
    move_away(r, batch);
}

/* Sides about the least and the greatest that the first stage takes, of one size or of both. */
static void draw_sides(random_source *r, batch_f64 *batch)
{
    static const int ends[] = {-36, -36, 36, 36, 0};
    const int usual = ends[random_int(r, 5)];
    int exponent[3];
    batch->box = box_about_zero(r, 0.4, 0.6);
    for (int a = 0; a < 3; a++) {
        exponent[a] = random_int(r, 3) ? usual : ends[random_int(r, 5)];
        exponent[a] += random_int_between(r, -1, 1);
        if (random_int(r, 2)) {
            batch->box.lo[a] = -random_int(r, 2);
            batch->box.hi[a] = stepped(batch->box.lo[a] + 1, random_int_between(r, -2, 2));
        }
    }
    for (int k = 0; k < BATCH_F64; k++) {
        draw_contact_of(r, &batch->box, 2, batch->u[k]);
        if (k % 2)
            shift(r, batch->u[k], 9, k % 4 == 1 ? 0x1p-24 : 0x1p-52);
    }
    place(batch, exponent, (const double[]){0, 0, 0});
}

static double any_sign(random_source *r, double x) { return random_int(r, 2) ? x : -x; }

static double beside(random_source *r, double face)
{
    switch (random_int(r, 4)) {
    case 0:
        return face;
    case 1:
        return stepped(face, random_int_between(r, -3, 3));
    case 2:
        return face + any_sign(r, ldexp(1, -random_int_between(r, 18, 54)));
    default:
        return face * (1 + random_int_between(r, -3, 3) * 0x1p-25);
    }
}

/* Sides that float has not, and every number on a face, near it, or well inside or outside. */
static void draw_faces(random_source *r, batch_f64 *batch)
{
    static const double more[] = {0, 0x1p-30, -0x1p-30, 0x1p-52, 0x1p-24, -0x1p-25, 0x1.8p-24};
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = random_int(r, 3) ? random_int_between(r, -2, 2) : random_double(r, -2, 2);
        batch->box.hi[a] = batch->box.lo[a] + random_int_between(r, 1, 3);
        batch->box.hi[a] += more[random_int(r, 7)];
    }
    for (int k = 0; k < BATCH_F64; k++)
        for (int a = 0; a < 3; a++) {
            const double lo = batch->box.lo[a], hi = batch->box.hi[a];
            const int side = random_int(r, 4);
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] = random_int(r, 3) ? beside(r, (side ? side == 1 : random_int(r, 2)) ? lo : hi)
                                                     : random_double(r, lo - 1, hi + 1);
        }
    move_away(r, batch);
}

/* A face in zero, beside which numbers can be as small as there are. */
static void draw_zero_faces(random_source *r, batch_f64 *batch)
{
    static const int exponents[] = {40, 50, 60, 70, 126, 127, 148, 149, 150, 151, 200, 500, 1000, 1022, 1060, 1074};
    bool is_lo[3];
    for (int a = 0; a < 3; a++) {
        is_lo[a] = random_int(r, 2);
        batch->box.lo[a] = is_lo[a] ? 0 : -random_double(r, 0.5, 1);
        batch->box.hi[a] = is_lo[a] ? random_double(r, 0.5, 1) : 0;
    }
    for (int k = 0; k < BATCH_F64; k++)
        for (int a = 0; a < 3; a++)
            for (int j = 0; j < 3; j++) {
                const double tiny = ldexp(1, -exponents[random_int(r, 16)]), in = is_lo[a] ? 1 : -1;
                const int way = random_int(r, 8);
                batch->u[k][j][a] = way < 2 ? 0.5 * in * way : way == 2 ? -0.0 : way == 3 ? tiny * in : -tiny * in;
            }
}

/* Vertices next to the faces of the paper's box. */
static void draw_beside_faces(random_source *r, batch_f64 *batch)
{
    batch->box = cube(-0.5, 0.5);
    for (int n = 0; n < 9 * BATCH_F64; n++) {
        const double size = ldexp(1, -40 - random_int(r, 30)), face = any_sign(r, 0.5);
        batch->u[n / 9][n / 3 % 3][n % 3] = face + size * random_double(r, -1, 1);
    }
}

/* Steep triangles that stand on a face with one vertex, or hang just off it: no axis but the normal of the face can tell. */
static void draw_standing(random_source *r, batch_f64 *batch)
{
    batch->box = box_about_zero(r, 0.5, 1);
    for (int k = 0; k < BATCH_F64; k++) {
        const int a = random_int(r, 3), is_hi = random_int(r, 4), steps = random_int_between(r, -1, 2);
        const double face = is_hi ? batch->box.hi[a] : batch->box.lo[a], off = ldexp(steps, -random_int_between(r, 22, 53));
        for (int j = 0; j < 3; j++) {
            const double height = j ? j + random_double(r, 0, 0.5) : off;
            batch->u[k][j][a] = is_hi ? face + height : face - height;
            batch->u[k][j][(a + 1) % 3] = random_double(r, -0.2, 0.2);
            batch->u[k][j][(a + 2) % 3] = random_double(r, -0.2, 0.2);
        }
    }
    move_away(r, batch);
}

/* Vertices so far out that their cubes, or they themselves, are no floats. */
static void draw_wild(random_source *r, batch_f64 *batch)
{
    batch->box = box_about_zero(r, 0.1, 1);
    const int exponent = random_int_between(r, 30, 140);
    for (int k = 0; k < BATCH_F64; k++) {
        double(*const u)[3] = batch->u[k];
        draw_contact_of(r, &batch->box, 2, u);
        const int j = random_int(r, 3);
        for (int a = 0; a < 3; a++) {
            const double from = u[j][a];
            for (int v = 0; v < 3; v++)
                if (k % 3 == 0 || v == (j + 1) % 3)
                    u[v][a] = from + ldexp(u[v][a] - from, exponent);
        }
        nudge(r, u, 2);
    }
}

/* The ends of the range of doubles, and exponents from one end to the other in one pair. */

typedef double number_draw(random_source *r);

static void draw_numbers(random_source *r, batch_f64 *batch, number_draw *draw)
{
    for (int n = 0; n < 9 * BATCH_F64; n++)
        batch->u[n / 9][n / 3 % 3][n % 3] = draw(r);
}

static void draw_bounds(random_source *r, batch_f64 *batch, number_draw *draw)
{
    for (int a = 0; a < 3; a++) {
        const double x = draw(r), y = draw(r);
        batch->box.lo[a] = x < y ? x : y;
        batch->box.hi[a] = x < y ? y : x;
    }
}

static double any_exponent(random_source *r)
{
    const double x = random_double(r, -2, 2);
    return ldexp(x, random_int_between(r, -1000, 1000));
}

static void draw_range(random_source *r, batch_f64 *batch)
{
    draw_bounds(r, batch, any_exponent);
    draw_numbers(r, batch, any_exponent);
}

static double few_of_the_least(random_source *r) { return ldexp(random_int_between(r, -2048, 2048), -1074); }

static void draw_subnormal(random_source *r, batch_f64 *batch)
{
    draw_bounds(r, batch, few_of_the_least);
    draw_numbers(r, batch, few_of_the_least);
}

static double up_to_max(random_source *r) { return random_double(r, -1, 1) * DBL_MAX; }

static void draw_near_max(random_source *r, batch_f64 *batch)
{
    batch->box = cube(-0.4 * DBL_MAX, 0.5 * DBL_MAX);
    draw_numbers(r, batch, up_to_max);
}

/* Differences beyond the greatest double, of the box or of the vertices alone. */
static double greatest_or_few(random_source *r)
{
    static const double numbers[] = {DBL_MAX, -DBL_MAX, DBL_MAX / 2, -DBL_MAX / 2, 0x1p1023, -0x1p1023, 1, -1, 0, 0.5};
    return numbers[random_int(r, 10)];
}

static void draw_overflow(random_source *r, batch_f64 *batch)
{
    if (random_int(r, 2))
        batch->box = box_about_zero(r, 0.5, 2);
    else
        draw_bounds(r, batch, greatest_or_few);
    draw_numbers(r, batch, greatest_or_few);
}

/* Contact in units of their own. */
static void draw_in_units(random_source *r, batch_f64 *batch, int least, int most)
{
    int exponent[3];
    for (int a = 0; a < 3; a++)
        exponent[a] = random_int_between(r, least, most);
    draw_touching_ulp(r, batch);
    place(batch, exponent, (const double[]){0, 0, 0});
}

static void draw_units(random_source *r, batch_f64 *batch)
{
    const int most = random_int(r, 2) ? 300 : 1000;
    draw_in_units(r, batch, -most, most);
}

/* About 2^-200 and 2^200, between which the second stage takes numbers. */
static void draw_stage_ends(random_source *r, batch_f64 *batch)
{
    const int end = random_int(r, 2) ? 200 : -200;
    draw_in_units(r, batch, end - 3, end + 3);
}

static double nasty_number(random_source *r)
{
    static const double numbers[] = {0,        1,        0x1p-1074, DBL_MIN,  DBL_MAX,  0x1p-36,  0x1p36,   0x1p-200,
                                     0x1p200,  0x1p127,  0x1p128,   0x1p-126, 0x1p-149, 0x1p-150, 0x1p-151, 0x1p1022,
                                     0x1p-540, 0x1p-380, 0x1p24,    0x1p53,   3,        1.5};
    const double number = numbers[random_int(r, sizeof numbers / sizeof numbers[0])];
    const int steps = number < DBL_MAX ? random_int_between(r, -1, 1) : 0;
    return stepped(random_int(r, 2) ? number : -number, steps);
}

static void draw_nasty(random_source *r, batch_f64 *batch)
{
    draw_bounds(r, batch, nasty_number);
    draw_numbers(r, batch, nasty_number);
}

/* Any bits that are a number. */
static double any_bits(random_source *r)
{
    double number;
    do {
        const uint64_t bits = random_bits(r);
        memcpy(&number, &bits, sizeof number);
    } while (!isfinite(number));
    return number;
}

static void draw_bits(random_source *r, batch_f64 *batch)
{
    draw_bounds(r, batch, any_bits);
    draw_numbers(r, batch, any_bits);
}

/* Triangles of floats that touch boxes of doubles, or nearly: boxes of any size next to the spacing of floats there. */

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
    const double near = stepped(P, random_int(r, 2) ? 0 : random_int_between(r, -3, 3));
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
static void draw_float_planes(random_source *r, batch_f64 *batch)
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
static void draw_float_edges(random_source *r, batch_f64 *batch)
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
static void draw_float_faces(random_source *r, batch_f64 *batch)
{
    double u[3][3], P[3];
    draw_floats(r, u);
    point_between(r, u, random_int(r, 3), random_double(r, 0, 1), P);
    for (int a = 0; a < 3; a++) {
        const double next = stepped_float(P[a], 1), on = u[random_int(r, 3)][a];
        const double bound[] = {
            P[a], on, stepped(on, random_int_between(r, -2, 2)), P[a] / 2 + next / 2, stepped(P[a], 1), random_double(r, -1, 1)};
        const double p = bound[random_int(r, 6)], q = bound[random_int(r, 6)];
        batch->box.lo[a] = fmin(p, q);
        batch->box.hi[a] = fmax(p, q);
    }
    repeat(r, u, batch);
}

static const scene_f64 scenes[] = {
    {"paper", draw_paper, 1},
    {"offset", draw_offset, 1},
    {"nanometres", draw_nanometres, 1},
    {"sparse", draw_sparse, 1},
    {"lattice", draw_lattice, 1},
    {"far-lattice", draw_far_lattice, 1},
    {"tenths", draw_tenths, 1},
    {"widened", draw_widened, 1},
    {"northings", draw_northings, 1},
    {"degenerate", draw_degenerate, 1},
    {"touching", draw_touching, 1},
    {"touching-ulp", draw_touching_ulp, 1},
    {"float-ulp", draw_float_ulp, 1},
    {"needles", draw_needles, 1},
    {"scaled", draw_scaled, 1},
    {"rotated", draw_rotated, 1},
    {"corners", draw_corners, 1},
    {"big-triangles", draw_big_triangles, 2},
    {"big-boxes", draw_big_boxes, 1},
    {"flat", draw_flat, 1},
    {"thin", draw_thin, 1},
    {"thin-faces", draw_thin_faces, 1},
    {"sides", draw_sides, 1},
    {"faces", draw_faces, 1},
    {"zero-faces", draw_zero_faces, 10},
    {"beside-faces", draw_beside_faces, 1},
    {"standing", draw_standing, 1},
    {"wild", draw_wild, 2},
    {"range", draw_range, 10},
    {"subnormal", draw_subnormal, 1},
    {"near-max", draw_near_max, 1},
    {"overflow", draw_overflow, 10},
    {"units", draw_units, 10},
    {"stage-ends", draw_stage_ends, 5},
    {"nasty", draw_nasty, 10},
    {"bits", draw_bits, 10},
    {"float-planes", draw_float_planes, 1},
    {"float-edges", draw_float_edges, 1},
    {"float-faces", draw_float_faces, 1},
};

enum { SCENES = sizeof scenes / sizeof scenes[0] };

size_t scene_f64_count(void) { return SCENES; }

const scene_f64 *scene_f64_at(size_t i) { return &scenes[i]; }

bool scene_f64_is_called(const scene_f64 *s, const char *name)
{
    return !name || !strcmp(s->name, name) || !strcmp("doubles", name);
}

pair_f64 batch_f64_pair(const batch_f64 *batch, int k)
{
    pair_f64 pair = {.box = batch->box};
    memcpy(pair.u, batch->u[k], sizeof pair.u);
    return pair;
}
