/* scenes_f64_guards.c - boxes that are flat, thin, tiny or huge; numbers on faces, and nearer to them than floats can tell. */
#include <math.h>
#include <string.h>

#include "contact_f64.h"

/* One to three sides of no length, now and then less than none. */
void draw_f64_flat(random_source *r, batch_f64 *batch)
{
    batch->box = box_f64_about_zero(r, 0.01, 1);
    const int first = random_int(r, 3), sides = random_int_between(r, 1, 3);
    for (int k = 0; k < sides; k++) {
        const int a = (first + k) % 3;
        batch->box.lo[a] = random_int(r, 3) ? batch->box.hi[a] : 0;
        batch->box.hi[a] = batch->box.lo[a];
    }
    for (int k = 0; k < BATCH_F64; k++) {
        contact_f64(r, &batch->box, 2, batch->u[k]);
        if (k % 2)
            nudge_f64(r, batch->u[k], 3);
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
    batch->box = box_f64_about_zero(r, 0.3, 1);
    exponents[thin] = exponent;
    if (!random_int(r, 4))
        exponents[(thin + 1) % 3] = exponent + random_int_between(r, -2, 2);
    place_f64(batch, exponents, (const double[]){0, 0, 0});
}

/* Somewhere, in some unit. */
static void move_away(random_source *r, batch_f64 *batch)
{
    const int exponent = random_int_between(r, -12, 12);
    const double offset = random_int(r, 2) ? random_double(r, -1e4, 1e4) : 0;
    place_f64(batch, (const int[]){exponent, exponent, exponent}, (const double[]){offset, -offset, offset});
}

void draw_f64_thin(random_source *r, batch_f64 *batch)
{
    make_thin(r, batch);
    const double size = ldexp(1, random_int_between(r, -4, 3)), by = ldexp(1, random_int_between(r, -50, -20));
    for (int k = 0; k < BATCH_F64; k++) {
        contact_f64(r, &batch->box, size, batch->u[k]);
        if (k % 2)
            shift_f64(r, batch->u[k], 9, by);
    }
    move_away(r, batch);
}

/* The same with vertices on the faces of the thin side and just next to them. */
void draw_f64_thin_faces(random_source *r, batch_f64 *batch)
{
    make_thin(r, batch);
    const double by = ldexp(1, random_int_between(r, -50, -20));
    for (int k = 0; k < BATCH_F64; k++) {
        double(*const u)[3] = batch->u[k];
        through_corner_f64(r, &batch->box, 1, u);
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
void draw_f64_sides(random_source *r, batch_f64 *batch)
{
    static const int ends[] = {-36, -36, 36, 36, 0};
    const int usual = ends[random_int(r, 5)];
    int exponent[3];
    batch->box = box_f64_about_zero(r, 0.4, 0.6);
    for (int a = 0; a < 3; a++) {
        exponent[a] = random_int(r, 3) ? usual : ends[random_int(r, 5)];
        exponent[a] += random_int_between(r, -1, 1);
        if (random_int(r, 2)) {
            batch->box.lo[a] = -random_int(r, 2);
            batch->box.hi[a] = stepped_f64(batch->box.lo[a] + 1, random_int_between(r, -2, 2));
        }
    }
    for (int k = 0; k < BATCH_F64; k++) {
        contact_f64(r, &batch->box, 2, batch->u[k]);
        if (k % 2)
            shift_f64(r, batch->u[k], 9, k % 4 == 1 ? 0x1p-24 : 0x1p-52);
    }
    place_f64(batch, exponent, (const double[]){0, 0, 0});
}

static double any_sign(random_source *r, double x) { return random_int(r, 2) ? x : -x; }

static double beside(random_source *r, double face)
{
    switch (random_int(r, 4)) {
    case 0:
        return face;
    case 1:
        return stepped_f64(face, random_int_between(r, -3, 3));
    case 2:
        return face + any_sign(r, ldexp(1, -random_int_between(r, 18, 54)));
    default:
        return face * (1 + random_int_between(r, -3, 3) * 0x1p-25);
    }
}

/* Sides that float has not, and every number on a face, near it, or well inside or outside. */
void draw_f64_faces(random_source *r, batch_f64 *batch)
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
void draw_f64_zero_faces(random_source *r, batch_f64 *batch)
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
void draw_f64_beside_faces(random_source *r, batch_f64 *batch)
{
    batch->box = (tribox_box){{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
    for (int k = 0; k < BATCH_F64; k++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++) {
                const double size = ldexp(1, -40 - random_int(r, 30)), face = any_sign(r, 0.5);
                batch->u[k][j][a] = face + size * random_double(r, -1, 1);
            }
}

/* Steep triangles that stand on a face with one vertex, or hang just off it: no axis but the normal of the face can tell. */
void draw_f64_standing(random_source *r, batch_f64 *batch)
{
    batch->box = box_f64_about_zero(r, 0.5, 1);
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
void draw_f64_wild(random_source *r, batch_f64 *batch)
{
    batch->box = box_f64_about_zero(r, 0.1, 1);
    const int exponent = random_int_between(r, 30, 140);
    for (int k = 0; k < BATCH_F64; k++) {
        double(*const u)[3] = batch->u[k];
        contact_f64(r, &batch->box, 2, u);
        const int j = random_int(r, 3);
        for (int a = 0; a < 3; a++) {
            const double from = u[j][a];
            for (int v = 0; v < 3; v++)
                if (k % 3 == 0 || v == (j + 1) % 3)
                    u[v][a] = from + ldexp(u[v][a] - from, exponent);
        }
        nudge_f64(r, u, 2);
    }
}
