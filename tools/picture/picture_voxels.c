/* picture_voxels.c - voxels in matte shading, with a ground and its shadow. */
#define _POSIX_C_SOURCE 200809L
#include "picture_voxels.h"

#include <pthread.h>
#include <stdlib.h>

#include "console/crew.h"
#include "picture_colours.h"
#include "picture_light.h"
#include "picture_normal.h"

enum { FINE = 2 /* samples along each side of a pixel */, CURVE = 4096 };

static const float margin = 0.90f;        /* of the picture: what the voxels take of it */
static const float line_darkness = 0.25f; /* of the edges of large cells */

/* Linear red, green and blue. */
static const vec sun_colour = {{1.72f, 1.54f, 1.28f}}, sky_colour = {{0.52f, 0.60f, 0.74f}}, clay = {{0.60f, 0.50f, 0.40f}},
                 paper_low = {{0.78f, 0.79f, 0.80f}}, paper_high = {{0.56f, 0.63f, 0.71f}};

typedef struct drawing {
    picture_faces faces;
    picture_colours colours;
    picture_view view; /* a point for each sample */
    uint32_t *seen;
    picture_lights lights;
    vec up;
    float ground;                      /* how far up it lies */
    picture_lit open[PICTURE_SAMPLES]; /* the light upon ground without voxels */
    float smoothness; /* 0: a face has its own normal; 1: cells are as small as samples, and the surface that they make has one */
    unsigned char curve[CURVE + 1]; /* from linear light to bytes */
    unsigned char *pixels;
    int columns, rows;
    progress *bar;
    pthread_mutex_t lock; /* of bar, and of what follows */
    int done;             /* rows */
} drawing;

static float ramp(float lo, float hi, float x)
{
    const float t = least(greatest((x - lo) / (hi - lo), 0), 1);
    return t * t * (3 - 2 * t);
}

static vec mixed(vec a, vec b, float share) { return vec_sum(1 - share, a, share, b); }

static vec colour_of(picture_lit lit) { return vec_sum(lit.sun, sun_colour, lit.sky, sky_colour); }

/* 1 within a cell, less by its edges, where a line of about a pixel shows which cells there are. */
static float edge_line(const drawing *d, vec place, int axis)
{
    const float pixels = d->view.scale / FINE, strength = line_darkness * ramp(4, 12, pixels);
    float nearest = 1;
    for (int a = 0; a < 3 && strength > 0; a++) {
        const float at = place.at[a] / d->faces.cell[a], within = at - floorf(at);
        if (a != axis)
            nearest = least(nearest, least(within, 1 - within) * d->faces.cell[a]);
    }
    return 1 - strength * (1 - ramp(0.3f, 1.3f, nearest * pixels));
}

static vec normal_at(const drawing *d, int x, int y, uint32_t seen)
{
    const int axis = picture_seen_axis(seen);
    vec face = {{0, 0, 0}};
    face.at[axis] = d->view.toward.at[axis] > 0 ? 1 : -1;
    return d->smoothness > 0 ? vec_unit(mixed(face, picture_normal(&d->view, d->seen, x, y, face), d->smoothness)) : face;
}

/* What a sample of a pixel shows, and the normal, which the next ones of the pixel share if they show the same. */
typedef struct shown {
    uint32_t seen;
    vec normal;
} shown;

static bool is_same_surface(const drawing *d, uint32_t a, uint32_t b)
{
    return a && (picture_seen_axis(a) == picture_seen_axis(b) || d->smoothness >= 1) &&
           fabsf(picture_seen_depth(a) - picture_seen_depth(b)) < 1.5f * d->view.scale;
}

/* Of the cell behind a place on a face across an axis; the middle of a sample may be beside its face, and then beside the cell. */
static vec colour_at(const drawing *d, vec place, int axis)
{
    static const int beside[][2] = {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    vec colour = clay;
    int cell[3];
    for (int a = 0; a < 3; a++) {
        const float at = place.at[a] / d->faces.cell[a];
        cell[a] = (int)floorf(a != axis ? at : roundf(at) + (d->view.toward.at[a] > 0 ? -0.5f : 0.5f));
    }
    for (size_t n = 0; d->colours.v->colours && n < sizeof beside / sizeof *beside; n++) {
        int near[3] = {cell[0], cell[1], cell[2]};
        near[(axis + 1) % 3] += beside[n][0];
        near[(axis + 2) % 3] += beside[n][1];
        if (picture_colours_at(&d->colours, near, &colour))
            break;
    }
    return colour;
}

static vec voxel_seen(const drawing *d, int x, int y, uint32_t seen, shown *last, int sample)
{
    const vec place = picture_view_place(&d->view, (vec){{(float)x + 0.5f, (float)y + 0.5f, picture_seen_depth(seen)}});
    if (!is_same_surface(d, last->seen, seen))
        *last = (shown){seen, normal_at(d, x, y, seen)};
    const float above = greatest(1.6f * d->smoothness, 0.02f);
    vec light = colour_of(picture_lights_at(&d->lights, place, last->normal, above, sample));
    const float line = edge_line(d, place, picture_seen_axis(seen));
    const vec colour = colour_at(d, place, picture_seen_axis(seen));
    for (int c = 0; c < 3; c++)
        light.at[c] *= line * colour.at[c];
    return light;
}

/* The ground has the colour of the background but for shadows, which end before it does. */
static vec ground_seen(const drawing *d, int x, int y, vec paper, int sample)
{
    const vec start = picture_view_place(&d->view, (vec){{(float)x + 0.5f, (float)y + 0.5f, 0}});
    const float rise = vec_dot(d->view.toward, d->up);
    const vec place = vec_sum(1, start, (d->ground - vec_dot(start, d->up)) / rise, d->view.toward);
    const vec apart = vec_sum(1, place, -1, d->lights.middle);
    const float strength = 1 - ramp(1.2f, 3.2f, sqrtf(vec_dot(apart, apart)) / d->lights.radius);
    if (strength <= 0 || rise < 1e-3f)
        return paper;
    const vec here = colour_of(picture_lights_at(&d->lights, place, d->up, 0, sample)), open = colour_of(d->open[sample]);
    vec dimmed = paper;
    for (int c = 0; c < 3; c++)
        dimmed.at[c] *= here.at[c] / open.at[c];
    return mixed(paper, dimmed, strength);
}

/* Bright light tends to white and never gets there. */
static float film(float light)
{
    const float over = (light - 0.6f) / 0.4f;
    return over < 0 ? light : 0.6f + 0.4f * over / (1 + over);
}

static void draw_pixel(const drawing *d, int column, int row, vec paper, unsigned char *pixel)
{
    vec sum = {{0, 0, 0}};
    shown last = {.seen = 0};
    for (int s = 0; s < PICTURE_SAMPLES; s++) {
        const int x = FINE * column + s % FINE, y = FINE * row + s / FINE;
        const uint32_t seen = d->seen[(size_t)y * (size_t)d->view.width + (size_t)x];
        const vec light = seen ? voxel_seen(d, x, y, seen, &last, s) : ground_seen(d, x, y, paper, s);
        for (int c = 0; c < 3; c++)
            sum.at[c] += film(light.at[c]) / PICTURE_SAMPLES;
    }
    for (int c = 0; c < 3; c++)
        pixel[c] = d->curve[(int)(least(sum.at[c], 1) * CURVE)];
}

static void draw_row(void *data, size_t n)
{
    drawing *const d = data;
    const int row = (int)n;
    const vec paper = mixed(paper_low, paper_high, ramp(0.1f, 1, 1 - (float)row / (float)d->rows));
    for (int column = 0; column < d->columns; column++)
        draw_pixel(d, column, row, paper, d->pixels + 3 * (n * (size_t)d->columns + (size_t)column));
    pthread_mutex_lock(&d->lock);
    progress_tell(d->bar, (double)++d->done / d->rows);
    pthread_mutex_unlock(&d->lock);
}

static void cast_light(void *data, size_t n)
{
    drawing *const d = data;
    picture_lights_cast(&d->lights, &d->faces, (int)n);
}

/* The corner of the occupied cells: bit a of n chooses the side on axis a. */
static vec corner_of(const picture_faces *f, int n)
{
    vec corner;
    for (int a = 0; a < 3; a++)
        corner.at[a] = (float)(n >> a & 1 ? f->hi[a] : f->lo[a]) * f->cell[a];
    return corner;
}

/* Fits all corners into the picture. */
static void fit_view(picture_view *v, const picture_faces *f)
{
    vec lo = {{INFINITY, INFINITY, INFINITY}}, hi = {{-INFINITY, -INFINITY, -INFINITY}};
    for (int n = 0; n < 8; n++) {
        const vec p = picture_view_point(v, corner_of(f, n));
        for (int a = 0; a < 3; a++) {
            lo.at[a] = least(lo.at[a], p.at[a]);
            hi.at[a] = greatest(hi.at[a], p.at[a]);
        }
    }
    const float width = (float)v->width, height = (float)v->height;
    const float fitting = margin * least(width / greatest(hi.at[0] - lo.at[0], 1), height / greatest(hi.at[1] - lo.at[1], 1));
    const float scale = least(fitting, 0.9f * PICTURE_DEPTH_MAX / greatest(hi.at[2] - lo.at[2], 1)); /* a bar seen from its end */
    const vec middle = {{0.5f * (lo.at[0] + hi.at[0]), 0.5f * (lo.at[1] + hi.at[1]), lo.at[2]}};
    picture_view_adjust(v, scale, middle, (vec){{0.5f * width, 0.5f * height, 1}});
}

static void place_all(drawing *d, const picture_look *look, uint16_t *maps)
{
    const float degree = 0.0174532925f, azimuth = look->azimuth * degree, elevation = look->elevation * degree;
    const int a = (int)look->up % 3;
    const vec right = {{a != 0, a == 0, 0}}, lo = corner_of(&d->faces, 0), hi = corner_of(&d->faces, 7);
    const vec across = vec_sum(1, hi, -1, lo);
    d->up = (vec){{0, 0, 0}};
    d->up.at[a] = look->up < 3 ? 1 : -1;
    const vec front = vec_cross(right, d->up), level = vec_sum(sinf(azimuth), right, cosf(azimuth), front);
    d->lights.middle = vec_sum(0.5f, lo, 0.5f, hi);
    d->lights.radius = greatest(0.505f * sqrtf(vec_dot(across, across)), 1);
    d->lights.sun = vec_unit(vec_sum(1, vec_sum(-0.85f, right, 0.5f, front), 0.95f, d->up));
    d->ground = least(vec_dot(lo, d->up), vec_dot(hi, d->up)) - 1e-4f * d->lights.radius;
    d->view = picture_view_against(vec_sum(cosf(elevation), level, sinf(elevation), d->up),
                                   vec_sum(-sinf(elevation), level, cosf(elevation), d->up));
    d->view.width = FINE * d->columns;
    d->view.height = FINE * d->rows;
    fit_view(&d->view, &d->faces);
    d->smoothness = least(greatest((5 - d->view.scale / FINE) / 3, 0), 1);
    picture_lights_place(&d->lights, d->up, d->columns > d->rows ? d->columns : d->rows, maps);
    for (int s = 0; s < PICTURE_SAMPLES; s++)
        d->open[s] = picture_lights_at(&d->lights, vec_sum(1, d->lights.middle, 9 * d->lights.radius, right), d->up, 0, s);
    for (int i = 0; i <= CURVE; i++) {
        const double x = (double)i / CURVE, s = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055; /* sRGB */
        d->curve[i] = (unsigned char)(255 * s + 0.5);
    }
}

static size_t samples_of(const picture_look *look) { return (size_t)PICTURE_SAMPLES * look->size[0] * look->size[1]; }

uint64_t picture_memory(const tribox_grid *grid, const picture_look *look)
{
    return picture_faces_memory(grid) + samples_of(look) * sizeof(uint32_t) + PICTURE_MAP_POINTS * sizeof(uint16_t);
}

bool picture_draw(const voxels *v, const picture_look *look, unsigned threads, unsigned char *pixels, progress *bar)
{
    drawing d = {.pixels = pixels, .columns = (int)look->size[0], .rows = (int)look->size[1], .bar = bar};
    if (!picture_faces_make(v, &d.faces))
        return false;
    d.colours = picture_colours_of(v, d.faces.factor);
    uint16_t *maps = malloc(PICTURE_MAP_POINTS * sizeof *maps);
    d.seen = calloc(samples_of(look), sizeof *d.seen);
    const bool is_drawn = maps && d.seen;
    if (is_drawn) {
        place_all(&d, look, maps);
        picture_view_draw(&d.view, &d.faces, d.seen);
        crew_each(threads, PICTURE_LIGHTS, cast_light, &d);
        pthread_mutex_init(&d.lock, NULL);
        crew_each(threads, look->size[1], draw_row, &d);
        pthread_mutex_destroy(&d.lock);
    }
    free(maps);
    free(d.seen);
    picture_faces_free(&d.faces);
    return is_drawn;
}
