/*
 * oriented_scenes.c - the scenes of upright boxes, seen from another frame.
 *
 * A frame of whole numbers A has a whole adjugate adj(A) with A adj(A) = det(A): a scene of few-digit numbers q is placed at
 * center + adj(A) q, exactly, and has |det(A)| q for its coordinates in the frame. What touches there
 * touches here, to the last bit.
 */
#include "oriented_scenes.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "common/contact.h"
#include "common/scenes.h"

/* A scene of an upright box in double: what is placed. */
typedef struct upright {
    double center[3], half[3];
    double u[ORIENTED_TRIANGLES][3][3];
} upright;

/* Two batches of a scene about the box of the first: the triangles of the second move along with the lower corner of theirs. */
static void draw_upright(random_source *r, scene_draw *draw, upright *up)
{
    scene_batch first, second;
    draw(r, &first);
    draw(r, &second);
    for (int a = 0; a < 3; a++) {
        const double lo = (double)first.box.lo[a], hi = (double)first.box.hi[a], moved = lo - (double)second.box.lo[a];
        up->center[a] = (lo + hi) / 2;
        up->half[a] = (hi - lo) / 2;
        for (int t = 0; t < SCENE_TRIANGLES; t++)
            for (int j = 0; j < 3; j++) {
                up->u[t][j][a] = (double)first.u[t][j][a];
                up->u[SCENE_TRIANGLES + t][j][a] = (double)second.u[t][j][a] + moved;
            }
    }
}

static double nearest_finite(double number) { return isinf(number) ? copysign(DBL_MAX, number) : number; }

/* A number of the box, or of its triangles, as the form of the batch has them. */
static double of_box(const oriented_batch *batch, double number)
{
    return batch->form == ORIENTED_FLOATS ? (double)nearest_float(number) : nearest_finite(number);
}

static double of_triangle(const oriented_batch *batch, double number)
{
    return batch->form == ORIENTED_DOUBLES ? nearest_finite(number) : (double)nearest_float(number);
}

static double *number_of(oriented_batch *batch, int n) { return &batch->u[n / 9][n / 3 % 3][n % 3]; }

/* The next number, or the one before it, as floats or as doubles; never infinite. */
static double next_to(random_source *r, double number, bool is_float)
{
    const double to = random_int(r, 2) ? DBL_MAX : -DBL_MAX;
    return is_float ? (double)nudged(r, (float)number, 1) : random_int(r, 3) ? nextafter(number, to) : number;
}

/* By how many times floats' powers of two those of axes and of positions may be: as far as doubles reach. */
static int range_of_axes(const oriented_batch *batch) { return batch->form == ORIENTED_FLOATS ? 1 : 7; }
static int range_of_positions(const oriented_batch *batch) { return batch->form == ORIENTED_DOUBLES ? 7 : 1; }

/* frame: what takes the place of the three unit vectors; inverse: of frame, but for the factor `size`. */
static void place(const upright *up, double frame[3][3], double inverse[3][3], double size, const double center[3],
                  oriented_batch *batch)
{
    for (int k = 0; k < 3; k++) {
        batch->box.center[k] = of_box(batch, center[k]);
        batch->box.half[k] = of_box(batch, size * up->half[k]);
        for (int a = 0; a < 3; a++)
            batch->box.axis[k][a] = of_box(batch, frame[k][a]);
    }
    for (int t = 0; t < ORIENTED_TRIANGLES; t++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++) {
                double p = center[a];
                for (int k = 0; k < 3; k++)
                    p += inverse[a][k] * (up->u[t][j][k] - up->center[k]);
                batch->u[t][j][a] = of_triangle(batch, p);
            }
}

static const double origin[3];

/* Proper rotations by any angles: the columns of the inverse are the axes. */
static void draw_rotation(random_source *r, double frame[3][3], double inverse[3][3])
{
    double x, y, z, w, n;
    do {
        x = random_double(r, -1, 1), y = random_double(r, -1, 1), z = random_double(r, -1, 1), w = random_double(r, -1, 1);
        n = x * x + y * y + z * z + w * w;
    } while (n > 1 || n < 0.1);
    const double rotation[3][3] = {{n - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                                   {2 * (x * y + z * w), n - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                                   {2 * (x * z - y * w), 2 * (y * z + x * w), n - 2 * (x * x + y * y)}};
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            frame[k][a] = inverse[a][k] = rotation[k][a] / n;
}

static double adjugate(double m[3][3], double adj[3][3])
{
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3, l = (k + 1) % 3, n = (k + 2) % 3;
            adj[a][k] = m[l][b] * m[n][c] - m[l][c] * m[n][b];
        }
    return m[0][0] * adj[0][0] + m[0][1] * adj[1][0] + m[0][2] * adj[2][0];
}

/* Of whole numbers, with a determinant greater than zero; *size is that. */
static void draw_whole_frame(random_source *r, int most, double frame[3][3], double inverse[3][3], double *size)
{
    do {
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                frame[k][a] = random_int_between(r, -most, most);
        *size = adjugate(frame, inverse);
    } while (*size <= 0);
}

/* The six orders of the axes, each with any signs. */
static void draw_right_angles(random_source *r, double frame[3][3], double inverse[3][3])
{
    const int first = random_int(r, 3), turn = random_int_between(r, 1, 2);
    memset(frame, 0, 3 * sizeof frame[0]);
    for (int k = 0; k < 3; k++)
        frame[k][(first + turn * k) % 3] = random_int(r, 2) ? 1 : -1;
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            inverse[a][k] = frame[k][a];
}

static void draw_lattice_scene(random_source *r, upright *up)
{
    static scene_draw *const lattices[] = {draw_touching, draw_touching, draw_eighths, draw_points};
    draw_upright(r, lattices[random_int(r, 4)], up);
    if (!random_int(r, 3)) /* flat on some axes: the center stays in the triangles' reach */
        up->half[random_int(r, 3)] = 0;
    if (!random_int(r, 6))
        up->half[random_int(r, 3)] = up->half[random_int(r, 3)] = 0;
}

static void draw_identity(random_source *r, oriented_batch *batch)
{
    static double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    upright up;
    draw_lattice_scene(r, &up);
    place(&up, unit, unit, 1, random_int(r, 2) ? origin : up.center, batch);
}

/* A bound that touched a triangle no longer does, and may need more digits than a double has. */
static void nudge_half(random_source *r, oriented_batch *batch, int k)
{
    batch->box.half[k] = fabs(next_to(r, batch->box.half[k], batch->form == ORIENTED_FLOATS));
}

static void draw_turned_by_right_angles(random_source *r, oriented_batch *batch)
{
    double frame[3][3], inverse[3][3];
    upright up;
    draw_lattice_scene(r, &up);
    draw_right_angles(r, frame, inverse);
    place(&up, frame, inverse, 1, up.center, batch);
    if (random_int(r, 2))
        nudge_half(r, batch, random_int(r, 3));
}

/* Sheared, mirrored and stretched: all is exact. */
static void draw_whole(random_source *r, oriented_batch *batch)
{
    double frame[3][3], inverse[3][3], size;
    upright up;
    draw_lattice_scene(r, &up);
    draw_whole_frame(r, random_int_between(r, 1, 4), frame, inverse, &size);
    place(&up, frame, inverse, size, up.center, batch);
}

static void nudge_number(random_source *r, double *number, bool is_float)
{
    if (random_int(r, 2))
        *number = next_to(r, *number, is_float);
}

/* Moves some numbers of the box and of the triangles to the next. */
static void nudge(random_source *r, oriented_batch *batch)
{
    const bool is_box_float = batch->form == ORIENTED_FLOATS, are_floats = batch->form != ORIENTED_DOUBLES;
    nudge_number(r, &batch->box.center[random_int(r, 3)], is_box_float);
    nudge_number(r, &batch->box.axis[random_int(r, 3)][random_int(r, 3)], is_box_float);
    if (random_int(r, 2))
        nudge_half(r, batch, random_int(r, 3));
    for (int n = 0; n < 2 * ORIENTED_TRIANGLES; n++)
        nudge_number(r, &batch->u[n / 2][random_int(r, 3)][random_int(r, 3)], are_floats);
}

static void draw_whole_ulp(random_source *r, oriented_batch *batch)
{
    draw_whole(r, batch);
    nudge(r, batch);
}

/* About one axis of space, which is an axis of the box: where it has length 1, all that touches there does so to the last bit. */
static void draw_turned_about_an_axis(random_source *r, oriented_batch *batch)
{
    double frame[3][3], inverse[3][3], center[3];
    upright up;
    draw_lattice_scene(r, &up);
    draw_right_angles(r, frame, inverse);
    const int k = random_int(r, 3), l = (k + 1) % 3, m = (k + 2) % 3;
    const double angle = random_double(r, -4, 4), c = cos(angle), s = sin(angle);
    const double length = random_int(r, 2) ? 1 : random_double(r, 0.5, 2);
    for (int a = 0; a < 3; a++) {
        center[a] = up.center[a] + random_int_between(r, -64, 64);
        const double of_l = frame[l][a], of_m = frame[m][a];
        inverse[a][l] = frame[l][a] = c * of_l + s * of_m;
        inverse[a][m] = frame[m][a] = c * of_m - s * of_l;
        frame[k][a] *= length;
        inverse[a][k] /= length;
    }
    place(&up, frame, inverse, 1, center, batch);
    if (random_int(r, 2))
        nudge_half(r, batch, k);
}

/* A scene turned by any angles, about a center of its own or another. */
static void place_turned(random_source *r, scene_draw *draw, const double *center, oriented_batch *batch)
{
    double frame[3][3], inverse[3][3];
    upright up;
    draw_upright(r, draw, &up);
    draw_rotation(r, frame, inverse);
    place(&up, frame, inverse, 1, center ? center : up.center, batch);
}

static void place_away(random_source *r, scene_draw *draw, double distance, oriented_batch *batch)
{
    double center[3];
    for (int a = 0; a < 3; a++)
        center[a] = of_box(batch, distance * random_double(r, -1, 1));
    place_turned(r, draw, center, batch);
}

/* A scene of any kind about a box turned by any angles: within some ulps of contact where the scene is one of contact. */
static void draw_turned(random_source *r, oriented_batch *batch)
{
    static scene_draw *const kinds[] = {draw_paper,   draw_touching, draw_near_contact,    draw_needles,    draw_caps,
                                        draw_edge_on, draw_sphere,   draw_small_triangles, draw_flat_boxes, draw_big_triangles};
    place_turned(r, kinds[random_int(r, sizeof kinds / sizeof kinds[0])], random_int(r, 2) ? origin : NULL, batch);
}

/* The paper's scene, turned; often a little away from the origin. */
static void draw_ordinary(random_source *r, oriented_batch *batch) { place_away(r, draw_paper, random_int(r, 100), batch); }

/*
 * Points of one face of a turned box that is thin there, all but for the rounding: what the move may be off by decides about each.
 * They are near a corner, so that none of them allows another more than itself.
 */
static void draw_face(random_source *r, oriented_batch *batch)
{
    double frame[3][3], inverse[3][3];
    upright up;
    draw_rotation(r, frame, inverse);
    const int face = random_int(r, 3);
    for (int k = 0; k < 3; k++) {
        up.center[k] = random_int(r, 2) ? random_double(r, -1, 1) : 0;
        up.half[k] = of_box(batch, k == face ? ldexp(random_double(r, 0, 1), -random_int(r, 12)) : random_double(r, 0, 1));
    }
    for (int t = 0; t < ORIENTED_TRIANGLES; t++) {
        for (int k = 0; k < 3; k++)
            up.u[t][0][k] = up.center[k] + up.half[k] * (k == face ? 1 : random_double(r, 0.98, 1));
        memcpy(up.u[t][1], up.u[t][0], sizeof up.u[t][0]);
        memcpy(up.u[t][2], up.u[t][0], sizeof up.u[t][0]);
    }
    place(&up, frame, inverse, 1, up.center, batch);
}

/* Axes in any directions, of any lengths: hardly ever an inverse that is exact. */
static void draw_sheared(random_source *r, oriented_batch *batch)
{
    double frame[3][3], inverse[3][3], size;
    upright up;
    draw_upright(r, random_int(r, 2) ? draw_near_contact : draw_paper, &up);
    do {
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                frame[k][a] = of_box(batch, random_double(r, -1, 1));
        size = adjugate(frame, inverse);
    } while (size < 1e-3);
    place(&up, frame, inverse, size, up.center, batch);
}

static void draw_turned_or_whole(random_source *r, oriented_batch *batch)
{
    if (random_int(r, 2))
        draw_turned(r, batch);
    else
        draw_whole(r, batch);
}

/* Two equal axes, opposite ones, an axis of length zero, all axes in a plane, or nothing but zeros: slabs, beams, all of space. */
static void draw_singular(random_source *r, oriented_batch *batch)
{
    draw_turned_or_whole(r, batch);
    const int k = random_int(r, 3), l = (k + 1) % 3, m = (k + 2) % 3, kind = random_int(r, 5);
    double(*const axis)[3] = batch->box.axis;
    for (int a = 0; a < 3; a++) {
        if (kind == 4)
            axis[l][a] = axis[m][a] = 0;
        axis[k][a] = kind == 0 ? axis[l][a] : kind == 1 ? -axis[l][a] : kind == 2 ? of_box(batch, axis[l][a] + axis[m][a]) : 0;
    }
}

/* So far away that a unit is a few ulps. */
static void draw_far(random_source *r, oriented_batch *batch)
{
    place_away(r, random_int(r, 2) ? draw_near_contact : draw_touching, ldexp(1, random_int_between(r, 10, 22)), batch);
}

/* Far along a direction that an axis does not see: its coordinate comes of large products that cancel. */
static void draw_cancelling(random_source *r, oriented_batch *batch)
{
    draw_whole(r, batch);
    const int k = random_int(r, 3), exponent = random_int_between(r, 8, 30);
    for (int t = 0; t < ORIENTED_TRIANGLES; t++) {
        const double *const axis = batch->box.axis[k];
        const int b = random_int(r, 3), c = (b + 1) % 3;
        const double far = ldexp(random_int_between(r, -4, 4), exponent);
        for (int j = 0; j < 3; j++) {
            batch->u[t][j][b] = of_triangle(batch, batch->u[t][j][b] + far * axis[c]);
            batch->u[t][j][c] = of_triangle(batch, batch->u[t][j][c] - far * axis[b]);
        }
    }
}

static void scale(oriented_batch *batch, int of_positions, int of_axes)
{
    for (int k = 0; k < 3; k++) {
        batch->box.center[k] = of_box(batch, ldexp(batch->box.center[k], of_positions));
        batch->box.half[k] = of_box(batch, ldexp(batch->box.half[k], of_positions + of_axes));
        for (int a = 0; a < 3; a++)
            batch->box.axis[k][a] = of_box(batch, ldexp(batch->box.axis[k][a], of_axes));
    }
    for (int n = 0; n < 9 * ORIENTED_TRIANGLES; n++)
        *number_of(batch, n) = of_triangle(batch, ldexp(*number_of(batch, n), of_positions));
}

/* From where nearly all is subnormal to where nearly all overflows; the axes by themselves too. */
static void draw_scaled_frame(random_source *r, oriented_batch *batch)
{
    static void (*const bases[])(random_source *, oriented_batch *) = {draw_turned, draw_whole, draw_whole_ulp, draw_sheared};
    bases[random_int(r, 4)](r, batch);
    const int positions = range_of_positions(batch) * random_int_between(r, -146, 124), most = range_of_axes(batch) * 126;
    scale(batch, positions, random_int(r, 2) ? 0 : random_int_between(r, -most - positions / 2, most - positions / 2) / 2);
}

/*
 * Axes or positions, of which only doubles are, among subnormal floats, and the others large: rounding moves them, and products
 * show it.
 */
static void scale_apart(random_source *r, oriented_batch *batch)
{
    const int small = random_int_between(r, -148, -130), large = random_int_between(r, 30, 110);
    const bool are_axes_small = batch->form != ORIENTED_DOUBLES || random_int(r, 2);
    scale(batch, are_axes_small ? large : small, are_axes_small ? small : large);
}

/* About the least float, or the least double: products lose bits that no share of them makes up for. */
static void draw_least(random_source *r, oriented_batch *batch)
{
    static void (*const bases[])(random_source *, oriented_batch *) = {draw_turned, draw_whole, draw_face, draw_sheared};
    const int of_doubles[] = {0, 925, 896}; /* among subnormal doubles, and where they begin */
    const int below = batch->form == ORIENTED_DOUBLES ? of_doubles[random_int(r, 3)] : 0;
    const bool is_where_they_begin = below == of_doubles[2];
    (is_where_they_begin ? draw_whole : bases[random_int(r, 4)])(r, batch); /* there whole numbers show it */
    if (batch->form != ORIENTED_FLOATS && !is_where_they_begin && !random_int(r, 3)) {
        scale_apart(r, batch);
        return;
    }
    const int exponent = random_int_between(r, -148, -132) - below, of_axes = random_int(r, 2) ? 0 : random_int_between(r, -140, 0);
    scale(batch, exponent - of_axes, of_axes);
}

/* Two axes, with their half lengths: products of both vanish, or all but overflow, and no unit for all axes keeps them. */
static void draw_two_scaled(random_source *r, oriented_batch *batch)
{
    const int most = range_of_axes(batch) * 73, powers = random_int(r, 2) ? random_int_between(r, -2 * most, -most) : most;
    const int kept = random_int(r, 3);
    draw_whole_ulp(r, batch);
    for (int k = 0; k < 3; k++) {
        const int power = k == kept ? 0 : powers;
        batch->box.half[k] = of_box(batch, ldexp(batch->box.half[k], power));
        for (int a = 0; a < 3; a++)
            batch->box.axis[k][a] = of_box(batch, ldexp(batch->box.axis[k][a], power));
    }
}

/* In one batch triangles of all sizes, from points to larger than the box, far beyond it. */
static void draw_tiny_and_huge_ones(random_source *r, oriented_batch *batch)
{
    draw_turned(r, batch);
    for (int t = 0; t < ORIENTED_TRIANGLES; t++) {
        const int exponent =
            random_int(r, 3) ? random_int_between(r, -20, 20) : range_of_positions(batch) * random_int_between(r, -140, 126);
        const int kept = random_int_between(r, -1, 2);
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                if (j != kept)
                    batch->u[t][j][a] = of_triangle(batch, batch->box.center[a] + ldexp(batch->u[t][j][a], exponent));
    }
}

/*
 * Whole numbers as long as 64 and 128 bits can take, and a little longer: axes of space, of lengths that are powers of two. A
 * face is
 * touched, which integers have to tell, and every other projection is as large as it can be.
 */
static void draw_wide(random_source *r, oriented_batch *batch)
{
    const int is_long = random_int(r, 2), bits = is_long ? random_int_between(r, 34, 39) : random_int_between(r, 13, 18);
    const int of_positions = is_long ? 23 : random_int_between(r, 8, 12), face = random_int(r, 3);
    const double most = ldexp(1, of_positions) - 1;
    memset(&batch->box, 0, sizeof batch->box);
    for (int k = 0; k < 3; k++) {
        const double length = k == face ? 1 : ldexp(1, bits - of_positions);
        const double half = floor(most * random_double(r, 0.5, 1));
        batch->box.axis[k][k] = length;
        batch->box.half[k] = of_box(batch, length * half);
        for (int t = 0; t < ORIENTED_TRIANGLES; t++) {
            const int side = t % 2 ? 1 : -1, touching = random_int(r, 3);
            for (int j = 0; j < 3; j++)
                batch->u[t][j][k] = k != face         ? floor(random_double(r, -most, most))
                                    : (j == touching) ? side * half
                                                      : side * floor(random_double(r, half, most));
        }
    }
}

/* At both ends of the range, so that differences overflow, or nearly and cancel. */
static void draw_ends_of_range(random_source *r, oriented_batch *batch)
{
    static const double of_floats[] = {FLT_MAX, -FLT_MAX, 0x1p127, -0x1p126, 0x1p100, -0x1p99, 0x1p-149, 0};
    static const double of_doubles[] = {DBL_MAX, -DBL_MAX, 0x1p1023, -0x1p1000, 0x1p129, -0x1p200, 0x1p-1074, 0};
    if (!random_int(r, 3)) {
        draw_cancelling(r, batch);
        scale(batch, range_of_positions(batch) * random_int_between(r, 80, 98), 0);
        return;
    }
    draw_turned(r, batch);
    if (random_int(r, 2))
        scale(batch, random_int_between(r, 110, 126), random_int(r, 2) ? 0 : -random_int_between(r, 0, 126));
    const double *const ends = batch->form == ORIENTED_FLOATS || random_int(r, 2) ? of_floats : of_doubles;
    for (int a = 0; a < 3; a++)
        if (!random_int(r, 3))
            batch->box.center[a] = ends[random_int(r, 8)];
    if (!random_int(r, 4))
        batch->box.half[random_int(r, 3)] = fabs(ends[random_int(r, 8)]);
    if (batch->form != ORIENTED_FLOATS)
        batch->box.axis[random_int(r, 3)][random_int(r, 3)] = ends[random_int(r, 8)];
    for (int t = 0; t < ORIENTED_TRIANGLES; t++)
        for (int times = random_int(r, 5); times > 0; times--)
            batch->u[t][random_int(r, 3)][random_int(r, 3)] = of_triangle(batch, ends[random_int(r, 8)]);
}

/* An axis so long, and a center so far from any float, that in its frame the middle of the box lies at the end of floats too. */
static void move_middle(random_source *r, oriented_batch *batch)
{
    const int k = random_int(r, 3), a = random_int(r, 3), b = (a + 1) % 3;
    memset(batch->box.axis, 0, sizeof batch->box.axis);
    batch->box.center[a] = 0x1.8p127 + (random_int(r, 2) ? 1 : -1) * random_double(r, 1 - 0x1p-12, 1) * 0x1p103;
    for (int i = 0; i < 3; i++) {
        batch->box.axis[i][i] = 1;
        batch->box.half[i] = ldexp(1, i == k ? random_int_between(r, 129, 131) : random_int_between(r, 120, 125));
    }
    batch->box.axis[k][a] = 0x1p25;
    batch->box.axis[k][b] = random_double(r, 0, 1);
    for (int t = 0; t < ORIENTED_TRIANGLES; t++)
        for (int j = 0; j < 3; j++) {
            batch->u[t][j][a] = 0x1.8p127;
            batch->u[t][j][b] = of_triangle(batch, ldexp(random_double(r, -1, 1), 120));
        }
}

/* Slabs and beams that end where floats do, or doubles. */
static void draw_endless(random_source *r, oriented_batch *batch)
{
    draw_turned_or_whole(r, batch);
    for (int times = random_int_between(r, 1, 2); times > 0; times--)
        batch->box.half[random_int(r, 3)] = of_box(batch, random_int(r, 2) ? DBL_MAX : ldexp(1, random_int_between(r, 60, 200)));
    if (batch->form == ORIENTED_TRIANGLES_OF_FLOATS)
        move_middle(r, batch);
}

static double any_finite(random_source *r, bool is_float)
{
    for (;;) {
        const uint64_t bits = random_bits(r);
        double number;
        float narrow;
        memcpy(&number, &bits, sizeof number);
        memcpy(&narrow, &bits, sizeof narrow);
        number = is_float ? (double)narrow : number;
        if (isfinite(number))
            return number;
    }
}

static double any_number(random_source *r, bool is_float, bool is_narrow)
{
    if (!is_narrow)
        return any_finite(r, is_float);
    const double number = ldexp(random_double(r, -1, 1), random_int_between(r, -9, 9));
    return is_float ? (double)(float)number : number;
}

/* Any bits; and any exponents about the middle, where products do not leave the range. */
static void draw_any_bits(random_source *r, oriented_batch *batch)
{
    const bool is_narrow = random_int(r, 2), is_box_float = batch->form == ORIENTED_FLOATS;
    for (int k = 0; k < 3; k++) {
        batch->box.center[k] = any_number(r, is_box_float, is_narrow);
        batch->box.half[k] = fabs(any_number(r, is_box_float, is_narrow)) * (is_narrow ? 512 : 1);
        batch->box.half[k] = of_box(batch, batch->box.half[k]);
        for (int a = 0; a < 3; a++)
            batch->box.axis[k][a] = any_number(r, is_box_float, is_narrow);
    }
    for (int n = 0; n < 9 * ORIENTED_TRIANGLES; n++)
        *number_of(batch, n) = any_number(r, batch->form != ORIENTED_DOUBLES, is_narrow);
}

/* A map's coordinates: millions of metres, millimetres, and a box turned and sized in tenths. */
static void draw_map(random_source *r, oriented_batch *batch)
{
    double frame[3][3], inverse[3][3];
    const double center[3] = {431234.1 + random_double(r, 0, 10), 5312345.6 + random_double(r, 0, 10), random_double(r, 0, 3000)};
    upright up;
    draw_upright(r, random_int(r, 2) ? draw_near_contact : draw_touching, &up);
    draw_rotation(r, frame, inverse);
    for (int k = 0; k < 3; k++) {
        const double of_tenths = floor(10 * up.half[k] + 1) / 10 / (up.half[k] > 0 ? up.half[k] : 1);
        up.half[k] *= of_tenths;
        for (int t = 0; t < ORIENTED_TRIANGLES; t++)
            for (int j = 0; j < 3; j++)
                up.u[t][j][k] = up.center[k] + (up.u[t][j][k] - up.center[k]) * of_tenths;
    }
    place(&up, frame, inverse, 1, center, batch);
    for (int n = 0; n < 9 * ORIENTED_TRIANGLES; n++)
        if (n / 9 % 2)
            *number_of(batch, n) = of_triangle(batch, floor(*number_of(batch, n) * 1000 + 0.5) / 1000);
}

/* A quarter turn by sine and cosine, which leaves 6e-17 where a zero is meant; faces that touch but for that. */
static void draw_quarter_turn(random_source *r, oriented_batch *batch)
{
    const int a = random_int(r, 3), b = (a + 1) % 3;
    const double angle = acos(-1) / 2 * random_int_between(r, -3, 3);
    upright up;
    draw_lattice_scene(r, &up);
    double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, inverse[3][3];
    frame[a][a] = frame[b][b] = cos(angle);
    frame[a][b] = -sin(angle);
    frame[b][a] = sin(angle);
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            inverse[c][k] = fabs(frame[k][c]) < 0.5 ? 0 : frame[k][c];
    place(&up, frame, inverse, 1, up.center, batch);
}

/* The scenes of upright boxes, all of them, with the axes of space. */
static void draw_any_upright(random_source *r, oriented_batch *batch)
{
    static double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    upright up;
    draw_upright(r, scene_at((size_t)random_int(r, (int)scene_count()))->draw, &up);
    place(&up, unit, unit, 1, up.center, batch);
}

const oriented_scene oriented_scenes[ORIENTED_SCENES] = {
    {"identity", draw_identity, false, 1},
    {"right-angles", draw_turned_by_right_angles, false, 1},
    {"about-an-axis", draw_turned_about_an_axis, false, 2},
    {"whole", draw_whole, false, 1},
    {"whole-ulp", draw_whole_ulp, false, 1},
    {"ordinary", draw_ordinary, true, 1},
    {"face", draw_face, false, 4},
    {"turned", draw_turned, false, 1},
    {"sheared", draw_sheared, false, 1},
    {"singular", draw_singular, false, 1},
    {"far", draw_far, false, 1},
    {"cancelling", draw_cancelling, false, 1},
    {"scaled", draw_scaled_frame, false, 1},
    {"least", draw_least, false, 4},
    {"two-scaled", draw_two_scaled, false, 2},
    {"tiny-and-huge", draw_tiny_and_huge_ones, false, 1},
    {"ends-of-range", draw_ends_of_range, false, 1},
    {"endless", draw_endless, false, 1},
    {"wide", draw_wide, false, 1},
    {"any-bits", draw_any_bits, false, 1},
    {"any-upright", draw_any_upright, false, 1},
    {"map", draw_map, false, 1},
    {"quarter-turn", draw_quarter_turn, false, 1},
};

static void sign_zeros(random_source *r, double *number, int count)
{
    for (int k = 0; k < count; k++)
        number[k] = number[k] == 0 ? (double)random_sign_of_zero(r, 0) : number[k];
}

void oriented_draw(const oriented_scene *s, oriented_form form, random_source *r, oriented_batch *batch)
{
    static const double not_finite[] = {(double)NAN, -(double)NAN, (double)INFINITY, -(double)INFINITY};
    batch->form = form;
    s->draw(r, batch);
    batch->count = random_int(r, 4) ? ORIENTED_TRIANGLES : random_int_between(r, 0, ORIENTED_TRIANGLES);
    for (int t = 0; t < ORIENTED_TRIANGLES; t++) {
        sign_zeros(r, &batch->u[t][0][0], 9);
        if (!random_int(r, 50))
            batch->u[t][random_int(r, 3)][random_int(r, 3)] = not_finite[random_int(r, 4)];
    }
    sign_zeros(r, batch->box.center, 3);
    sign_zeros(r, batch->box.half, 3);
    sign_zeros(r, &batch->box.axis[0][0], 9);
}
