/* scenes_scales.c - numbers of very different size in one pair: products vanish on one axis and overflow on another. */
#include <math.h>
#include <string.h>

#include "contact.h"
#include "scenes.h"

/* The smallest and the largest power of two by which a scene of numbers about 1 may be scaled. */
enum { LEAST_EXPONENT = -149, MOST_EXPONENT = 126 };

static float any_finite_float(random_source *r)
{
    float number;
    do {
        const uint32_t bits = (uint32_t)random_bits(r);
        memcpy(&number, &bits, sizeof number);
    } while (!isfinite(number));
    return number;
}

void draw_random_bits(random_source *r, scene_batch *batch)
{
    for (int a = 0; a < 3; a++) {
        const float p = any_finite_float(r), q = any_finite_float(r);
        batch->box.lo[a] = p < q ? p : q;
        batch->box.hi[a] = p < q ? q : p;
    }
    for (int k = 0; k < SCENE_TRIANGLES; k++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = any_finite_float(r);
}

static void scale_axis(scene_batch *batch, int a, int exponent)
{
    batch->box.lo[a] = nearest_float(ldexp(batch->box.lo[a], exponent));
    batch->box.hi[a] = nearest_float(ldexp(batch->box.hi[a], exponent));
    for (int k = 0; k < SCENE_TRIANGLES; k++)
        for (int j = 0; j < 3; j++)
            batch->u[k][j][a] = nearest_float(ldexp(batch->u[k][j][a], exponent));
}

/* Half of the time anywhere, else at an end of the range. */
static int any_exponent(random_source *r)
{
    switch (random_int(r, 4)) {
    case 0:
        return random_int_between(r, LEAST_EXPONENT, LEAST_EXPONENT + 30);
    case 1:
        return random_int_between(r, MOST_EXPONENT - 30, MOST_EXPONENT);
    default:
        return random_int_between(r, LEAST_EXPONENT, MOST_EXPONENT);
    }
}

static void scale_each_axis(random_source *r, scene_batch *batch)
{
    for (int a = 0; a < 3; a++)
        scale_axis(batch, a, any_exponent(r));
}

void draw_own_scale(random_source *r, scene_batch *batch)
{
    if (random_int(r, 2))
        draw_paper(r, batch);
    else
        draw_near_contact(r, batch);
    scale_each_axis(r, batch);
}

void draw_own_scale_touching(random_source *r, scene_batch *batch)
{
    draw_touching(r, batch);
    scale_each_axis(r, batch);
}

/*
 * Triangles of 2^-20 down to nothing, outside of a corner or an edge of a box. It lies at the origin, so that they are not rounded,
 * but the differences to the other bounds lose them altogether. A third of them touch, the others lie off by about their size.
 */
void draw_tiny_at_corner(random_source *r, scene_batch *batch)
{
    static const tribox_box origin;
    double outward[3];
    const int longest = random_int(r, 2) ? 0 : 37;
    const int around = random_int(r, 4); /* the axis on which the origin is within the box, if any */
    for (int a = 0; a < 3; a++) {
        const float extent = ldexpf(1, random_int_between(r, 0, longest));
        outward[a] = a == around ? 0 : random_int(r, 2) ? 1 : -1;
        batch->box.lo[a] = outward[a] < 0 ? 0 : -extent;
        batch->box.hi[a] = outward[a] > 0 ? 0 : extent;
    }
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        const contact_style style = {.step = k % 2, .size = 1};
        double m[3], at[3][3];
        draw_outward(r, style, m);
        for (int a = 0; a < 3; a++)
            m[a] = outward[a] * fabs(m[a]);
        draw_contact_along(r, &origin, style, any_contact_part(r), m, at);
        const double away = random_int(r, 3) * random_double(r, 0, 0.5);
        const int exponent = random_int_between(r, -145, -20);
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = (float)ldexp(nearest_float(at[j][a]) + away * m[a], exponent);
    }
}

/* Triangles of which the normal all but vanishes, at the origin: what is left of it meets a huge box, around them or far away. */
void draw_lost_normal(random_source *r, scene_batch *batch)
{
    const int exponent = random_int_between(r, 20, 36);
    for (int a = 0; a < 3; a++) {
        const float p = ldexpf((float)random_double(r, -1, 1), exponent), q = ldexpf((float)random_double(r, -1, 1), exponent);
        batch->box.lo[a] = p < q ? p : q;
        batch->box.hi[a] = p < q ? q : p;
    }
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        const int size = random_int_between(r, -77, -70);
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = ldexpf((float)random_double(r, -1, 1), size);
    }
}

/* Tiny on two axes, huge on the third: the normal vanishes, and then meets a large distance. */
void draw_tiny_and_huge(random_source *r, scene_batch *batch)
{
    if (random_int(r, 2))
        draw_touching(r, batch);
    else
        draw_near_contact(r, batch);
    const int huge = random_int(r, 3);
    for (int a = 0; a < 3; a++)
        scale_axis(batch, a, a == huge ? random_int_between(r, 40, 116) : random_int_between(r, -145, -40));
}
