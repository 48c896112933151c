/* scenes_contact.c - exact touching, and all that sits within a few ulp of it. */
#include <math.h>

#include "contact.h"
#include "scenes.h"

static void draw_lattice_box(random_source *r, float step, tribox_box *box)
{
    for (int a = 0; a < 3; a++) {
        const int first = random_int_between(r, -4, 3);
        box->lo[a] = step * (float)first;
        box->hi[a] = step * (float)(first + random_int_between(r, 1, 4));
    }
}

static void draw_any_box(random_source *r, tribox_box *box)
{
    for (int a = 0; a < 3; a++) {
        const double lo = random_double(r, -1, 1);
        box->lo[a] = (float)lo;
        box->hi[a] = (float)(lo + random_double(r, 0.1, 2));
    }
}

/* Contact that is exact, and one step next to it. */
void draw_touching(random_source *r, scene_batch *batch)
{
    const float step = ldexpf(1, random_int_between(r, -6, 6));
    draw_lattice_box(r, step, &batch->box);
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        float(*const u)[3] = batch->u[k];
        draw_contact(r, &batch->box, (contact_style){.step = step}, any_contact_part(r), u);
        const int a = random_int(r, 3);
        const float shift = k % 2 ? 0 : step * (float)random_int_between(r, -1, 1);
        for (int j = 0; j < 3; j++)
            u[j][a] += shift;
    }
}

void draw_touching_ulp(random_source *r, scene_batch *batch)
{
    draw_touching(r, batch);
    for (int k = 0; k < SCENE_TRIANGLES; k++)
        for (int times = random_int_between(r, 1, 3); times > 0; times--) {
            float *const number = &batch->u[k][random_int(r, 3)][random_int(r, 3)];
            *number = nudged(r, *number, 1);
        }
}

void draw_near_contact(random_source *r, scene_batch *batch)
{
    draw_any_box(r, &batch->box);
    const contact_style style = {.size = pow(2, random_double(r, -4, 6))};
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        draw_contact(r, &batch->box, style, any_contact_part(r), batch->u[k]);
        const int ulps = random_int(r, 4);
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = nudged(r, batch->u[k][j][a], ulps);
    }
}

/* One edge of 1 to 4 ulp. */
void draw_needles(random_source *r, scene_batch *batch)
{
    draw_any_box(r, &batch->box);
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        float(*const u)[3] = batch->u[k];
        draw_contact(r, &batch->box, (contact_style){.size = 1}, CONTACT_EDGE, u);
        const int j = random_int(r, 3);
        for (int a = 0; a < 3; a++)
            u[j][a] = nudged(r, u[(j + 1) % 3][a], 4);
    }
}

/* A vertex on the opposite edge, or beside it by what the rounding leaves: the sign of the normal is anybody's guess. */
void draw_caps(random_source *r, scene_batch *batch)
{
    draw_any_box(r, &batch->box);
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        float(*const u)[3] = batch->u[k];
        draw_contact(r, &batch->box, (contact_style){.size = 1}, CONTACT_EDGE, u);
        const int j = random_int(r, 3), first = (j + 1) % 3, second = (j + 2) % 3;
        const double share = random_double(r, 0, 1);
        for (int a = 0; a < 3; a++)
            u[j][a] = nudged(r, (float)(share * u[first][a] + (1 - share) * u[second][a]), 2);
    }
}

/* Triangles seen edge-on along a box axis: that component of the normal is zero, but for the rounding. */
void draw_edge_on(random_source *r, scene_batch *batch)
{
    draw_any_box(r, &batch->box);
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        float(*const u)[3] = batch->u[k];
        draw_contact(r, &batch->box, (contact_style){.size = 1}, any_contact_part(r), u);
        const int along = random_int(r, 3), j = random_int(r, 3), ulps = random_int(r, 3);
        for (int a = 0; a < 3; a++)
            u[j][a] = a == along ? (float)random_double(r, -2, 2) : nudged(r, u[(j + 1) % 3][a], ulps);
    }
}

/* Triangles that are flat on one axis or on two, many of them in a plane of a face. */
void draw_flat_triangles(random_source *r, scene_batch *batch)
{
    const contact_style lattice = {.step = 0.25}, any = {.size = 1};
    const bool is_lattice = random_int(r, 2);
    if (is_lattice)
        draw_lattice_box(r, 0.25f, &batch->box);
    else
        draw_any_box(r, &batch->box);
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        float(*const u)[3] = batch->u[k];
        draw_contact(r, &batch->box, is_lattice ? lattice : any, any_contact_part(r), u);
        for (int times = random_int_between(r, 1, 2), a = random_int(r, 3); times > 0; times--, a = (a + 1) % 3)
            u[1][a] = u[2][a] = u[0][a];
    }
}
