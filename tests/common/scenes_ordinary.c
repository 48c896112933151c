/* scenes_ordinary.c - geometry as it comes: no tricks with the number format. */
#include <math.h>

#include "contact.h"
#include "scenes.h"

static const tribox_box paper_box = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};

/* The scene of the paper: everything drawn evenly about a unit cube. */
void draw_paper(random_source *r, scene_batch *batch)
{
    batch->box = paper_box;
    for (int k = 0; k < SCENE_TRIANGLES; k++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = (float)random_double(r, -2, 2);
}

/* The same in steps of 1/8: many ties, and every float operation exact. */
void draw_eighths(random_source *r, scene_batch *batch)
{
    batch->box = paper_box;
    for (int k = 0; k < SCENE_TRIANGLES; k++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = (float)random_int_between(r, -16, 16) / 8;
}

/* Triangles that are points: in and about the box, on its faces and one float next to them. */
void draw_points(random_source *r, scene_batch *batch)
{
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = (float)random_double(r, -2, 0);
        batch->box.hi[a] = (float)random_double(r, 0, 2);
    }
    for (int k = 0; k < SCENE_TRIANGLES; k++)
        for (int a = 0; a < 3; a++) {
            const float face = random_int(r, 2) ? (float)batch->box.lo[a] : (float)batch->box.hi[a];
            const float at = random_int(r, 2) ? nudged(r, face, 1) : (float)random_double(r, -2, 2);
            batch->u[k][0][a] = batch->u[k][1][a] = batch->u[k][2][a] = at;
        }
}

/* Triangles that are segments: a vertex twice, or one midway between the others. They touch the box, or nearly. */
void draw_segments(random_source *r, scene_batch *batch)
{
    const contact_style lattice = {.step = 0.125}, any = {.size = 1};
    batch->box = paper_box;
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        float(*const u)[3] = batch->u[k];
        draw_contact(r, &batch->box, k % 2 ? lattice : any, CONTACT_EDGE, u);
        const int j = random_int(r, 3), first = (j + 1) % 3, second = (j + 2) % 3;
        const float share = random_int(r, 2) ? 0.5f : 1.0f;
        for (int a = 0; a < 3; a++)
            u[j][a] = share * u[first][a] + (1 - share) * u[second][a];
    }
}

/* The paper's scene a million units away, where an ulp is 1/16. */
void draw_offset(random_source *r, scene_batch *batch)
{
    draw_paper(r, batch);
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] += 1e6f;
        batch->box.hi[a] += 1e6f;
        for (int k = 0; k < SCENE_TRIANGLES; k++)
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] += 1e6f;
    }
}

/* A triangle of another size than the box, which passes close to it: moved off contact by a share of the smaller one. */
static void draw_passing(random_source *r, scene_batch *batch, double size, double away)
{
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        draw_contact(r, &batch->box, (contact_style){.size = size}, any_contact_part(r), batch->u[k]);
        for (int a = 0; a < 3; a++) {
            const double shift = random_double(r, -away, away);
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] = (float)(batch->u[k][j][a] + shift);
        }
    }
}

void draw_big_triangles(random_source *r, scene_batch *batch)
{
    for (int a = 0; a < 3; a++) {
        const double middle = random_double(r, -1, 1), half = random_double(r, 0.01, 0.2);
        batch->box.lo[a] = (float)(middle - half);
        batch->box.hi[a] = (float)(middle + half);
    }
    draw_passing(r, batch, pow(10, random_double(r, 1, 3)), 0.1);
}

void draw_small_triangles(random_source *r, scene_batch *batch)
{
    batch->box = paper_box;
    const double size = pow(10, random_double(r, -4, -1));
    draw_passing(r, batch, size, size / 2);
}

/* Axis-aligned triangles with corners on the planes of the grid that the box is a block of. */
void draw_cad(random_source *r, scene_batch *batch)
{
    const float cell = 0.25f;
    for (int a = 0; a < 3; a++) {
        const int first = random_int_between(r, -4, 3);
        batch->box.lo[a] = cell * (float)first;
        batch->box.hi[a] = cell * (float)(first + random_int_between(r, 1, 3));
    }
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        float(*const u)[3] = batch->u[k];
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                u[j][a] = cell * (float)random_int_between(r, -6, 6);
        const int flat = random_int(r, 3);
        u[1][flat] = u[2][flat] = u[0][flat];
    }
}

static void sphere_point(double latitude, double longitude, float p[3])
{
    p[0] = (float)(cos(latitude) * cos(longitude));
    p[1] = (float)(cos(latitude) * sin(longitude));
    p[2] = (float)sin(latitude);
}

/* A cell of 1/32 on a tessellated unit sphere, and the triangles near it. */
void draw_sphere(random_source *r, scene_batch *batch)
{
    const double step = 0.04, latitude = random_double(r, -1.5, 1.5), longitude = random_double(r, -3, 3);
    float at[3];
    sphere_point(latitude, longitude, at);
    for (int a = 0; a < 3; a++) {
        const float cell = floorf(at[a] * 32);
        batch->box.lo[a] = cell / 32;
        batch->box.hi[a] = (cell + 1) / 32;
    }
    for (int k = 0; k < SCENE_TRIANGLES; k++) {
        const int side = random_int(r, 2);
        const double row = floor(latitude / step) + random_int_between(r, -1, 1);
        const double column = floor(longitude / step) + random_int_between(r, -1, 1);
        sphere_point((row + side) * step, (column + side) * step, batch->u[k][0]);
        sphere_point((row + 1) * step, column * step, batch->u[k][1]);
        sphere_point(row * step, (column + 1) * step, batch->u[k][2]);
    }
}

/* Boxes that are rectangles, segments and points. */
void draw_flat_boxes(random_source *r, scene_batch *batch)
{
    const contact_style lattice = {.step = 0.125}, any = {.size = 1};
    batch->box = paper_box;
    const int flat = random_int_between(r, 1, 3), first = random_int(r, 3);
    for (int k = 0; k < flat; k++) {
        const int a = (first + k) % 3;
        batch->box.lo[a] = batch->box.hi[a] = (float)random_int_between(r, -4, 4) / 8;
    }
    for (int k = 0; k < SCENE_TRIANGLES; k++)
        draw_contact(r, &batch->box, k % 2 ? lattice : any, any_contact_part(r), batch->u[k]);
}
