/* fill_bodies.c - bodies made of formulas that show what filling does. */
#include "fill_bodies.h"

#include <math.h>
#include <stdbool.h>

enum { AROUND = 72, ACROSS = 36 };

typedef struct ball {
    double centre[3], radius;
    /* The part left out: from this step on, and so many. */
    int around, arounds, across, acrosses;
} ball;

/* Poles on the z axis. */
static void ball_vertex(const ball *b, int i, int j, float v[3])
{
    const double turn = 8 * atan(1), p = turn * (i % AROUND) / AROUND, q = turn / 2 * j / ACROSS;
    const double ring = j % ACROSS ? b->radius * sin(q) : 0;
    v[0] = (float)(b->centre[0] + ring * cos(p));
    v[1] = (float)(b->centre[1] + ring * sin(p));
    v[2] = (float)(b->centre[2] + b->radius * cos(q));
}

static void put(fill_body *body, float v[3][3])
{
    for (int n = 0; n < 9; n++)
        body->stream[n][body->count] = v[n % 3][n / 3];
    body->count += body->count < FILL_TRIANGLES - 1;
}

static void put_ball(fill_body *body, const ball *b)
{
    for (int i = 0; i < AROUND; i++)
        for (int j = 0; j < ACROSS; j++) {
            const bool is_out = (i + AROUND - b->around) % AROUND < b->arounds && j >= b->across && j < b->across + b->acrosses;
            float v[3][3];
            for (int half = 0; half < 2 && !is_out; half++) {
                ball_vertex(b, i, j, v[0]);
                ball_vertex(b, i + 1, j + half, v[1]);
                ball_vertex(b, i + half, j + 1, v[2]);
                if (half) {
                    ball_vertex(b, i + 1, j + 1, v[1]);
                    ball_vertex(b, i, j, v[0]);
                    ball_vertex(b, i, j + 1, v[2]);
                } else
                    ball_vertex(b, i + 1, j + 1, v[2]);
                put(body, v);
            }
        }
}

static void make_closed(fill_body *body) { put_ball(body, &(ball){.centre = {32.1, 24.2, 24.3}, .radius = 21}); }

/* One surface in another: a wall with a hollow in it. */
static void make_hollow(fill_body *body)
{
    make_closed(body);
    put_ball(body, &(ball){.centre = {32.1, 24.2, 24.3}, .radius = 12});
}

/* A hole of many cells. */
static void make_open(fill_body *body)
{
    put_ball(body,
             &(ball){.centre = {32.1, 24.2, 24.3}, .radius = 21, .around = AROUND - 3, .arounds = 6, .across = 15, .acrosses = 6});
}

/* Two halves that are half a cell apart: the middle of a row of cells looks through the crack. */
static void make_cracked(fill_body *body)
{
    ball half = {.centre = {32.1, 23.9, 24.3}, .radius = 21, .around = AROUND / 8, .arounds = AROUND / 2, .acrosses = ACROSS};
    put_ball(body, &half);
    half.around += AROUND / 2;
    half.centre[0] += 0.35;
    half.centre[1] -= 0.35;
    put_ball(body, &half);
}

static void make_doubled(fill_body *body)
{
    make_closed(body);
    make_closed(body);
}

static void make_crossing(fill_body *body)
{
    put_ball(body, &(ball){.centre = {23.1, 24.2, 24.3}, .radius = 17});
    put_ball(body, &(ball){.centre = {41.2, 24.1, 24.2}, .radius = 17});
}

static const fill_kind kinds[] = {{"closed", make_closed},   {"hollow", make_hollow},   {"open", make_open},
                                  {"cracked", make_cracked}, {"doubled", make_doubled}, {"crossing", make_crossing}};

size_t fill_kind_count(void) { return sizeof kinds / sizeof kinds[0]; }

const fill_kind *fill_kind_at(size_t n) { return &kinds[n]; }

tribox_soup fill_body_soup(const fill_body *body)
{
    tribox_soup soup = {.count = body->count};
    for (int v = 0; v < 3; v++) {
        soup.x[v] = body->stream[v];
        soup.y[v] = body->stream[3 + v];
        soup.z[v] = body->stream[6 + v];
    }
    return soup;
}
