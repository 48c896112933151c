/* picture_voxels.c - places a camera before voxels and lets threads draw rows. */
#define _POSIX_C_SOURCE 200809L
#include "picture_voxels.h"

#include <pthread.h>

#include "voxelize/layers.h"
#include "picture_grid.h"
#include "picture_light.h"

static const double azimuth = 0.56, elevation = 0.44; /* radians: to the right of the front, and up */
static const double half_width = 0.23;                /* of the picture, at distance 1 */
static const double margin = 0.97;                    /* of it that the voxels take */

typedef struct camera {
    vec eye, ahead, right, up;
    double shift[2]; /* of the middle of the picture, at distance 1 */
} camera;

typedef struct drawing {
    picture_grid grid;
    picture_light light;
    camera camera;
    unsigned char *pixels;
    progress *bar;
    pthread_mutex_t lock; /* of what follows, and of bar */
    int next;             /* row */
} drawing;

/* The corner of the occupied cells: bit a of n chooses the side on axis a. */
static vec corner_of(const picture_grid *g, int n)
{
    vec corner;
    for (int a = 0; a < 3; a++)
        corner.at[a] = (n >> a & 1 ? g->hi[a] : g->lo[a]) * g->cell[a];
    return corner;
}

static vec axis_up(picture_up up)
{
    vec v = {{0, 0, 0}};
    v.at[up % 3] = up < 3 ? 1 : -1;
    return v;
}

static void light_up(drawing *d, picture_up up, vec right, vec front)
{
    picture_light *l = &d->light;
    const vec lo = corner_of(&d->grid, 0), hi = corner_of(&d->grid, 7), across = vec_sum(1, hi, -1, lo);
    picture_light_spread(l);
    l->grid = &d->grid;
    l->up = axis_up(up);
    l->middle = vec_sum(0.5, lo, 0.5, hi);
    l->radius = fmax(0.5 * sqrt(vec_dot(across, across)), d->grid.cell[0]);
    l->ground = fmin(vec_dot(lo, l->up), vec_dot(hi, l->up)) - 1e-4 * l->radius;
    l->sun = vec_unit(vec_sum(1, vec_sum(-0.85, right, 0.5, front), 0.75, l->up));
}

/* How far from the middle the eye has to be for all corners to be in the picture, and where the picture's middle then is. */
static double distance_of(const drawing *d, const camera *c)
{
    const double half[2] = {margin * half_width, margin * half_width * PICTURE_HEIGHT / PICTURE_WIDTH};
    double distance = 0;
    for (int n = 0; n < 8; n++) {
        const vec to = vec_sum(1, corner_of(&d->grid, n), -1, d->light.middle);
        const double aside[2] = {vec_dot(to, c->right), vec_dot(to, c->up)};
        for (int a = 0; a < 2; a++)
            distance = fmax(distance, fabs(aside[a]) / half[a] - vec_dot(to, c->ahead));
    }
    return fmax(distance, d->light.radius);
}

static void center(const drawing *d, camera *c)
{
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    for (int n = 0; n < 8; n++) {
        const vec to = vec_sum(1, corner_of(&d->grid, n), -1, c->eye);
        const double depth = vec_dot(to, c->ahead), at[2] = {vec_dot(to, c->right) / depth, vec_dot(to, c->up) / depth};
        for (int a = 0; a < 2; a++) {
            lo[a] = fmin(lo[a], at[a]);
            hi[a] = fmax(hi[a], at[a]);
        }
    }
    for (int a = 0; a < 2; a++)
        c->shift[a] = (lo[a] + hi[a]) / 2;
}

static void place_camera(drawing *d, picture_up up)
{
    camera *c = &d->camera;
    const vec high = axis_up(up), right = up % 3 == 0 ? (vec){{0, 1, 0}} : (vec){{1, 0, 0}}, front = vec_cross(right, high);
    const vec level = vec_sum(sin(azimuth), right, cos(azimuth), front);
    light_up(d, up, right, front);
    c->ahead = vec_sum(-cos(elevation), level, -sin(elevation), high);
    c->right = vec_unit(vec_cross(c->ahead, high));
    c->up = vec_cross(c->right, c->ahead);
    const double distance = distance_of(d, c);
    c->eye = vec_sum(1, d->light.middle, -distance, c->ahead);
    center(d, c);
    const double cell = fmax(d->grid.cell[0], fmax(d->grid.cell[1], d->grid.cell[2]));
    d->light.pixels = cell / distance / (2 * half_width) * PICTURE_WIDTH;
    d->light.smoothness = fmin(fmax((5 - d->light.pixels) / 3, 0), 1);
}

static unsigned char to_byte(double linear)
{
    const double x = fmin(fmax(linear, 0), 1);
    const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055; /* sRGB */
    return (unsigned char)(255 * s + 0.5);
}

/* Bright light tends to white and never gets there. */
static double film(double light) { return light < 0.6 ? light : 1 - 0.4 * exp(-(light - 0.6) / 0.4); }

static void draw_pixel(const drawing *d, int column, int row, unsigned char *pixel)
{
    static const double offset[PICTURE_SAMPLES][2] = {{0.125, 0.625}, {0.375, 0.125}, {0.625, 0.875}, {0.875, 0.375}};
    const camera *c = &d->camera;
    vec sum = {{0, 0, 0}};
    for (int s = 0; s < PICTURE_SAMPLES; s++) {
        const double x = (2 * (column + offset[s][0]) / PICTURE_WIDTH - 1) * half_width + c->shift[0];
        const double y = (PICTURE_HEIGHT - 2 * (row + offset[s][1])) / PICTURE_WIDTH * half_width + c->shift[1];
        const vec to = vec_unit(vec_sum(1, c->ahead, 1, vec_sum(x, c->right, y, c->up)));
        const vec seen = picture_light_seen(&d->light, c->eye, to, 1 - (row + offset[s][1]) / PICTURE_HEIGHT, s);
        for (int k = 0; k < 3; k++)
            sum.at[k] += film(seen.at[k]) / PICTURE_SAMPLES;
    }
    for (int k = 0; k < 3; k++)
        pixel[k] = to_byte(sum.at[k]);
}

static int take_row(drawing *d)
{
    pthread_mutex_lock(&d->lock);
    const int row = d->next++;
    progress_tell(d->bar, fmin((double)row / PICTURE_HEIGHT, 1));
    pthread_mutex_unlock(&d->lock);
    return row;
}

static void *draw_rows(void *data)
{
    drawing *d = data;
    for (int row; (row = take_row(d)) < PICTURE_HEIGHT;)
        for (int column = 0; column < PICTURE_WIDTH; column++)
            draw_pixel(d, column, row, d->pixels + 3 * ((size_t)row * PICTURE_WIDTH + (size_t)column));
    return NULL;
}

static void draw_with(drawing *d, unsigned threads)
{
    pthread_t helpers[THREADS_MAX];
    unsigned started = 0;
    pthread_mutex_init(&d->lock, NULL);
    while (started + 1 < threads && started < THREADS_MAX && !pthread_create(&helpers[started], NULL, draw_rows, d))
        started++;
    draw_rows(d);
    while (started)
        pthread_join(helpers[--started], NULL);
    pthread_mutex_destroy(&d->lock);
}

uint64_t picture_memory(const tribox_grid *grid) { return picture_grid_memory(grid); }

bool picture_draw(const voxels *v, picture_up up, unsigned threads, unsigned char *pixels, progress *bar)
{
    drawing d = {.pixels = pixels, .bar = bar};
    if (!picture_grid_make(v, &d.grid))
        return false;
    place_camera(&d, up);
    draw_with(&d, threads);
    picture_grid_free(&d.grid);
    return true;
}
