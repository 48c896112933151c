/* scenes_f64_contact.c - touching from outside and from inside, exactly or within rounding of double and of float. */
#include <math.h>

#include "contact_f64.h"

static void draw_contacts(random_source *r, batch_f64 *batch, double size)
{
    for (int k = 0; k < BATCH_F64; k++)
        contact_f64(r, &batch->box, size, batch->u[k]);
}

static void nudge_all(random_source *r, batch_f64 *batch, int most)
{
    for (int k = 0; k < BATCH_F64; k++)
        nudge_f64(r, batch->u[k], most);
}

/* Contact that is exact where a vertex touches; elsewhere as near as doubles come. */
void draw_f64_touching(random_source *r, batch_f64 *batch)
{
    batch->box = box_f64_about_zero(r, 0.1, 1);
    draw_contacts(r, batch, ldexp(1, random_int_between(r, -3, 3)));
}

void draw_f64_touching_ulp(random_source *r, batch_f64 *batch)
{
    draw_f64_touching(r, batch);
    nudge_all(r, batch, 3);
}

/* Off contact by some of what a float rounds: where the first stage must not say more than it knows. */
void draw_f64_float_ulp(random_source *r, batch_f64 *batch)
{
    const double by = ldexp(1, random_int_between(r, -30, -21));
    draw_f64_touching(r, batch);
    for (int k = 0; k < BATCH_F64; k++)
        shift_f64(r, batch->u[k], 20, by);
}

/* An edge of a few units of the last place. */
void draw_f64_needles(random_source *r, batch_f64 *batch)
{
    batch->box = box_f64_about_zero(r, 0.01, 1);
    for (int k = 0; k < BATCH_F64; k++) {
        double(*const u)[3] = batch->u[k];
        contact_f64(r, &batch->box, 2, u);
        const int j = random_int(r, 3);
        for (int a = 0; a < 3; a++)
            u[(j + 1) % 3][a] = stepped_f64(u[j][a], random_int_between(r, -4, 4));
        nudge_f64(r, u, 3);
    }
}

/* A scale and an offset for each axis; the offset rounds what is asked. */
void draw_f64_scaled(random_source *r, batch_f64 *batch)
{
    static const double offsets[] = {0, 0, 1, 1e3, 5e5, 4e6, 1e9};
    int exponent[3];
    double offset[3];
    draw_f64_touching_ulp(r, batch);
    for (int a = 0; a < 3; a++) {
        exponent[a] = random_int_between(r, -30, 30);
        offset[a] = offsets[random_int(r, 7)];
    }
    place_f64(batch, exponent, offset);
}

/* Triangles of any size that touch with numbers of full length. */
void draw_f64_rotated(random_source *r, batch_f64 *batch)
{
    batch->box = box_f64_about_zero(r, 0.01, 1);
    draw_contacts(r, batch, ldexp(1, -random_int(r, 24)) / 3);
    nudge_all(r, batch, 3);
}

/* Through a corner, so that most enter the box. */
void draw_f64_corners(random_source *r, batch_f64 *batch)
{
    batch->box = box_f64_about_zero(r, 0.01, 1);
    for (int k = 0; k < BATCH_F64; k++) {
        through_corner_f64(r, &batch->box, 2, batch->u[k]);
        nudge_f64(r, batch->u[k], 3);
    }
}

/* Triangles so large that the box is as a point, as far as there still are floats. */
void draw_f64_big_triangles(random_source *r, batch_f64 *batch)
{
    batch->box = box_f64_about_zero(r, 0.1, 1);
    draw_contacts(r, batch, ldexp(1, random_int_between(r, 10, 60)));
    nudge_all(r, batch, 3);
}

/* Small ones at corners, edges and faces of a large box. */
void draw_f64_big_boxes(random_source *r, batch_f64 *batch)
{
    const int exponent = random_int_between(r, 5, 40);
    batch->box = box_f64_about_zero(r, 0.5, 1);
    place_f64(batch, (const int[]){exponent, exponent - random_int(r, 5), exponent}, (const double[]){0, 0, 0});
    draw_contacts(r, batch, ldexp(1, -random_int(r, 20)));
    nudge_all(r, batch, 3);
}
