/* scenes_range.c - the ends of the float range, one scale for the whole pair. */
#include <math.h>

#include "contact.h"
#include "scenes.h"

/* Everything times 2^exponent on each axis, plus an offset, rounded once. */
static void move_batch(scene_batch *batch, int exponent, const double offset[3])
{
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = nearest_float(ldexp(batch->box.lo[a], exponent) + offset[a]);
        batch->box.hi[a] = nearest_float(ldexp(batch->box.hi[a], exponent) + offset[a]);
        for (int k = 0; k < SCENE_TRIANGLES; k++)
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] = nearest_float(ldexp(batch->u[k][j][a], exponent) + offset[a]);
    }
}

static void draw_base(random_source *r, scene_batch *batch)
{
    static scene_draw *const base[] = {draw_paper, draw_touching, draw_near_contact};
    base[random_int(r, sizeof base / sizeof base[0])](r, batch);
}

/* Up to 1e30 from the origin, in a scene that is some ulps to a million ulps wide there. */
void draw_offset_huge(random_source *r, scene_batch *batch)
{
    draw_base(r, batch);
    double offset[3];
    const int exponent = random_int_between(r, 20, 100);
    for (int a = 0; a < 3; a++)
        offset[a] = ldexp(random_double(r, -1, 1), exponent);
    move_batch(batch, exponent - 24 + random_int_between(r, 0, 20), offset);
}

void draw_near_contact_scaled(random_source *r, scene_batch *batch)
{
    draw_near_contact(r, batch);
    const int exponent = random_int_between(r, -60, 60);
    double offset[3];
    for (int a = 0; a < 3; a++)
        offset[a] = ldexp(random_double(r, -16, 16), exponent);
    move_batch(batch, exponent, offset);
}

static const double no_offset[3];

void draw_scaled(random_source *r, scene_batch *batch)
{
    draw_base(r, batch);
    move_batch(batch, random_int_between(r, -140, 112), no_offset);
}

/* Nothing but subnormal numbers. */
void draw_subnormal(random_source *r, scene_batch *batch)
{
    draw_paper(r, batch);
    if (random_int(r, 2)) {
        const contact_style style = {.step = random_int(r, 2) ? 0.125 : 0, .size = 0.25};
        for (int k = 0; k < SCENE_TRIANGLES; k++)
            draw_contact(r, &batch->box, style, any_contact_part(r), batch->u[k]);
    }
    move_batch(batch, random_int_between(r, -146, -130), no_offset);
}

/* Up to the largest float, and cut off there. */
void draw_near_max(random_source *r, scene_batch *batch)
{
    draw_base(r, batch);
    move_batch(batch, random_int_between(r, 122, 127), no_offset);
}
