/* scenes_f64_plain.c - geometry as it comes, near the origin and far from it. */
#include <math.h>
#include <string.h>

#include "contact_f64.h"

static const tribox_box paper_box = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};

static void draw_all(random_source *r, batch_f64 *batch, double least, double most)
{
    for (int k = 0; k < BATCH_F64; k++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = random_double(r, least, most);
}

static void draw_on_lattice(random_source *r, batch_f64 *batch, double origin, double step, int least, int most)
{
    for (int k = 0; k < BATCH_F64; k++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = origin + step * random_int_between(r, least, most);
}

void draw_f64_paper(random_source *r, batch_f64 *batch)
{
    batch->box = paper_box;
    draw_all(r, batch, -2, 2);
}

/* The same ten million units away. */
void draw_f64_offset(random_source *r, batch_f64 *batch)
{
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = 1e7 - 0.5;
        batch->box.hi[a] = 1e7 + 0.5;
    }
    draw_all(r, batch, 1e7 - 2, 1e7 + 2);
}

/* Nanometres from the centre of the earth: what is asked is some units of the last place. */
void draw_f64_nanometres(random_source *r, batch_f64 *batch)
{
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = 4e6 - 2e-9;
        batch->box.hi[a] = 4e6 + 2e-9;
    }
    draw_on_lattice(r, batch, 4e6, 2e-9, -4, 3);
}

/* Small triangles that are mostly far off. */
void draw_f64_sparse(random_source *r, batch_f64 *batch)
{
    batch->box = paper_box;
    for (int k = 0; k < BATCH_F64; k++)
        for (int a = 0; a < 3; a++) {
            const double about = random_double(r, -1.5, 1.5);
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] = about + random_double(r, -0.2, 0.2);
        }
}

/* Quarters: contact is common. */
void draw_f64_lattice(random_source *r, batch_f64 *batch)
{
    batch->box = paper_box;
    draw_on_lattice(r, batch, 0, 0.25, -8, 8);
}

/* Whole units of the last place, as far away as those exist, in a unit of each axis. */
void draw_f64_far_lattice(random_source *r, batch_f64 *batch)
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
    place_f64(batch, exponent, offset);
}

void draw_f64_tenths(random_source *r, batch_f64 *batch)
{
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = 0.8;
        batch->box.hi[a] = 1.7;
    }
    for (int k = 0; k < BATCH_F64; k++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = random_int(r, 26) / 10.0;
}

/* Numbers that float has. */
void draw_f64_widened(random_source *r, batch_f64 *batch)
{
    draw_f64_touching(r, batch);
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = (float)batch->box.lo[a];
        batch->box.hi[a] = (float)batch->box.hi[a];
        for (int k = 0; k < BATCH_F64; k++)
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] = (float)batch->u[k][j][a];
    }
}

/* A map in metres with three decimals, and cells of half a metre. */
void draw_f64_northings(random_source *r, batch_f64 *batch)
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
void draw_f64_degenerate(random_source *r, batch_f64 *batch)
{
    draw_f64_touching(r, batch);
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
