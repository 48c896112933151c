/* picture_voxels.c - fills the parallelograms that faces are to the viewer and to the sun, and shades what the viewer sees. */
#define _POSIX_C_SOURCE 200809L
#include "preview.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "colours/colours.h"
#include "console/crew.h"

enum { FINE = 2 /* samples along each side of a pixel */, SAMPLES = FINE * FINE, MAP_SIDE = 1536, DISK = 32 };

typedef struct vec {
    float at[3];
} vec;

static vec vec_sum(float s, vec a, float t, vec b) /* s a + t b */
{
    return (vec){{s * a.at[0] + t * b.at[0], s * a.at[1] + t * b.at[1], s * a.at[2] + t * b.at[2]}};
}

static float vec_dot(vec a, vec b) { return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2]; }

static vec vec_cross(vec a, vec b)
{
    return (vec){
        {a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2], a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
}

static vec vec_unit(vec a) { return vec_sum(1 / sqrtf(vec_dot(a, a)), a, 0, a); }

/* fminf and fmaxf care for NaN, which takes a call. */
static float least(float a, float b) { return a < b ? a : b; }
static float greatest(float a, float b) { return a > b ? a : b; }

static const float azimuth = 0.56f, elevation = 0.44f; /* of the viewer, in radians: to the right of the front, and up */
static const float line_darkness = 0.25f;              /* of the edges of large cells */
static const rgb clay = {{203, 188, 170}};

/* Linear red, green and blue. */
static const vec sun_colour = {{1.72f, 1.54f, 1.28f}}, sky_colour = {{0.52f, 0.60f, 0.74f}}, paper_low = {{0.78f, 0.79f, 0.80f}},
                 paper_high = {{0.56f, 0.63f, 0.71f}};

/* Voxels seen from far away. Points are counted from the upper left, and depth in points too, greater nearer to who looks. */
typedef struct view {
    vec axis[3]; /* of length 1: right, down, toward who looks */
    vec origin;  /* the point of the place 0, 0, 0 */
    float scale; /* points per length */
    int width, height;
    uint64_t *seen; /* of each point: the bits of a depth, the axis of a face and its colour, a byte each; 0: nothing */
} view;

typedef struct drawing {
    const voxels *v;
    vec cell, hi; /* lengths of a cell, the longest 1; the upper corner of the grid, whose lower one is 0, 0, 0 */
    view eye, sun;
    vec up, middle;
    float radius;        /* of a ball around the voxels */
    float smoothness;    /* 0: a face has its own normal; 1: cells are as small as samples, and their surface has one */
    float disk[DISK][2]; /* places spread over a circle of radius 1 */
    rgb_curve light;
    unsigned char *pixels;
    const picture_look *look;
    progress *bar;
} drawing;

static float ramp(float lo, float hi, float x)
{
    const float t = least(greatest((x - lo) / (hi - lo), 0), 1);
    return t * t * (3 - 2 * t);
}

static vec mixed(vec a, vec b, float share) { return vec_sum(1 - share, a, share, b); }

static vec point_of(const view *v, vec place)
{
    vec p = v->origin;
    for (int a = 0; a < 3; a++)
        p.at[a] += v->scale * vec_dot(v->axis[a], place);
    return p;
}

static vec place_of(const view *v, float x, float y, float depth)
{
    const vec p = vec_sum(1 / v->scale, (vec){{x, y, depth}}, -1 / v->scale, v->origin);
    return vec_sum(1, vec_sum(p.at[0], v->axis[0], p.at[1], v->axis[1]), p.at[2], v->axis[2]);
}

static float depth_of(uint64_t seen)
{
    float depth;
    memcpy(&depth, &(uint32_t){(uint32_t)(seen >> 32)}, sizeof depth);
    return depth;
}

static int axis_of(uint64_t seen) { return (int)(seen >> 24 & 3); }

static uint64_t seen_at(const view *v, int x, int y)
{
    return x < 0 || y < 0 || x >= v->width || y >= v->height ? 0 : v->seen[(size_t)y * (size_t)v->width + (size_t)x];
}

/* Looks from a direction at all that is occupied. */
static void place_view(view *v, const drawing *d, vec toward, float margin)
{
    vec lo = {{INFINITY, INFINITY, INFINITY}}, hi = {{-INFINITY, -INFINITY, -INFINITY}};
    v->axis[2] = vec_unit(toward);
    v->axis[0] = vec_unit(vec_cross(d->up, toward));
    v->axis[1] = vec_cross(v->axis[0], v->axis[2]);
    v->scale = 1;
    for (int n = 0; n < 8; n++) {
        const vec p = point_of(v, (vec){{(n & 1 ? d->hi.at[0] : 0), (n & 2 ? d->hi.at[1] : 0), (n & 4 ? d->hi.at[2] : 0)}});
        for (int a = 0; a < 3; a++) {
            lo.at[a] = least(lo.at[a], p.at[a]);
            hi.at[a] = greatest(hi.at[a], p.at[a]);
        }
    }
    const float width = (float)v->width, height = (float)v->height;
    v->scale = margin * least(width / greatest(hi.at[0] - lo.at[0], 1e-3f), height / greatest(hi.at[1] - lo.at[1], 1e-3f));
    v->origin = vec_sum(1, (vec){{0.5f * width, 0.5f * height, 1}}, -v->scale,
                        (vec){{0.5f * (lo.at[0] + hi.at[0]), 0.5f * (lo.at[1] + hi.at[1]), lo.at[2]}});
}

/* The faces across an axis differ in place alone. */
typedef struct shape {
    vec corner;         /* of the face of cell 0, 0, 0 */
    vec step[3];        /* from cell to cell */
    float lo[2], hi[2]; /* how far the face reaches from its corner */
    float to[2][2];     /* to shares of the face's two sides, 0 to 1 */
    float slope[2];     /* of depth */
} shape;

static shape shape_of(const view *v, vec cell, int axis)
{
    shape s;
    for (int a = 0; a < 3; a++)
        s.step[a] = (vec){{v->scale * v->axis[0].at[a] * cell.at[a], v->scale * v->axis[1].at[a] * cell.at[a],
                           v->scale * v->axis[2].at[a] * cell.at[a]}};
    s.corner = vec_sum(1, v->origin, v->axis[2].at[axis] > 0, s.step[axis]);
    const vec p = s.step[(axis + 1) % 3], q = s.step[(axis + 2) % 3];
    const float area = p.at[0] * q.at[1] - p.at[1] * q.at[0];
    const float to[2][2] = {{q.at[1] / area, -q.at[0] / area}, {-p.at[1] / area, p.at[0] / area}};
    memcpy(s.to, to, sizeof to);
    for (int c = 0; c < 2; c++) {
        s.lo[c] = least(p.at[c], 0) + least(q.at[c], 0);
        s.hi[c] = greatest(p.at[c], 0) + greatest(q.at[c], 0);
        s.slope[c] = to[0][c] * p.at[2] + to[1][c] * q.at[2];
    }
    return s;
}

static int clamp(float x, int most) { return x < 0 ? 0 : x > (float)most ? most : (int)x; }

/* A point shows the face if its middle lies within; a little beyond is within too, so that neighbours leave no gap. */
static void fill_face(const view *v, const shape *s, const uint32_t cell[3], uint32_t look)
{
    static const float gap = 1e-3f;
    vec corner = s->corner;
    for (int a = 0; a < 3; a++)
        corner = vec_sum(1, corner, (float)cell[a], s->step[a]);
    const int first_x = clamp(corner.at[0] + s->lo[0], v->width), last_x = clamp(corner.at[0] + s->hi[0] + 1, v->width);
    const int first_y = clamp(corner.at[1] + s->lo[1], v->height), last_y = clamp(corner.at[1] + s->hi[1] + 1, v->height);
    for (int y = first_y; y < last_y; y++)
        for (int x = first_x; x < last_x; x++) {
            const float dx = (float)x + 0.5f - corner.at[0], dy = (float)y + 0.5f - corner.at[1];
            const float p = s->to[0][0] * dx + s->to[0][1] * dy, q = s->to[1][0] * dx + s->to[1][1] * dy;
            const float depth = greatest(corner.at[2] + s->slope[0] * dx + s->slope[1] * dy, 0.5f);
            uint32_t bits;
            memcpy(&bits, &depth, sizeof bits);
            const uint64_t here = (uint64_t)bits << 32 | look;
            uint64_t *const at = &v->seen[(size_t)y * (size_t)v->width + (size_t)x];
            if (least(p, q) >= -gap && greatest(p, q) <= 1 + gap && here > *at)
                *at = here;
        }
}

/* A row of the grid; NULL outside. */
static const uint64_t *row_at(const voxels *v, int64_t j, int64_t k)
{
    const bool is_there = j >= 0 && k >= 0 && j < v->grid.size[1] && k < v->grid.size[2];
    return is_there ? voxels_layer(v, (uint32_t)k) + (size_t)j * voxels_row_words(&v->grid) : NULL;
}

/* The faces across an axis whose other side is free, of a row. */
static void fill_row(const drawing *d, const view *v, const shape *s, int axis, uint32_t j, uint32_t k)
{
    const int side = v->axis[2].at[axis] > 0 ? 1 : -1;
    const uint32_t words = (uint32_t)voxels_row_words(&d->v->grid);
    const uint64_t *const row = row_at(d->v, j, k);
    const uint64_t *const next = row_at(d->v, (int64_t)j + side * (axis == 1), (int64_t)k + side * (axis == 2));
    for (uint32_t w = 0; w < words; w++) {
        uint64_t beside = next ? next[w] : 0;
        if (axis == 0)
            beside = side > 0 ? row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0) : row[w] << 1 | (w ? row[w - 1] >> 63 : 0);
        for (uint64_t cells = row[w] & ~beside; cells; cells &= cells - 1) {
            const uint64_t below = (cells & -cells) - 1;
            const uint32_t cell[3] = {64 * w + (uint32_t)voxels_count(&below, 1), j, k};
            fill_face(v, s, cell, (uint32_t)axis << 24 | rgb_number(d->v->colours ? cell_colours_at(d->v->colours, cell) : clay));
        }
    }
}

static void fill_view(const drawing *d, const view *v)
{
    for (int a = 0; a < 3; a++) {
        const shape s = shape_of(v, d->cell, a);
        if (fabsf(v->axis[2].at[a]) < 1e-4f || !isfinite(s.slope[0]) || !isfinite(s.slope[1]))
            continue; /* a line */
        for (uint32_t k = 0; k < d->v->grid.size[2]; k++)
            for (uint32_t j = 0; j < d->v->grid.size[1]; j++)
                fill_row(d, v, &s, a, j, k);
    }
}

/* 1 within a cell, less by its edges, where a line of about a pixel shows which cells there are. */
static float edge_line(const drawing *d, vec place, int axis)
{
    const float pixels = d->eye.scale / FINE, strength = line_darkness * ramp(4, 12, pixels);
    float nearest = 1;
    for (int a = 0; a < 3; a++) {
        const float at = place.at[a] / d->cell.at[a], within = at - floorf(at);
        if (a != axis)
            nearest = least(nearest, least(within, 1 - within) * d->cell.at[a]);
    }
    return 1 - strength * (1 - ramp(0.3f, 1.3f, nearest * pixels));
}

/* The normal of the surface that small cells make: from depths on both sides, unless it ends or bends between them. */
static vec normal_at(const drawing *d, int x, int y, uint64_t seen)
{
    vec face = {{0, 0, 0}};
    const view *const v = &d->eye;
    const float reach = 3.5f * v->scale + 1, here = depth_of(seen);
    float sum[2] = {0, 0}, square = 1e-3f, trust = 0;
    face.at[axis_of(seen)] = v->axis[2].at[axis_of(seen)] > 0 ? 1 : -1;
    for (int n = 0; n < DISK && d->smoothness > 0; n++) {
        const int dx = (int)roundf(reach * d->disk[n][0]), dy = (int)roundf(reach * d->disk[n][1]);
        const uint64_t one = seen_at(v, x + dx, y + dy), other = seen_at(v, x - dx, y - dy);
        if (!one || !other || fabsf(depth_of(one) + depth_of(other) - 2 * here) > 3 * v->scale + 2)
            continue;
        const float rise = 0.5f * (depth_of(one) - depth_of(other));
        sum[0] += (float)dx * rise;
        sum[1] += (float)dy * rise;
        square += 0.5f * (float)(dx * dx + dy * dy);
        trust += d->smoothness / DISK;
    }
    const vec across = vec_sum(sum[0] / square, v->axis[0], sum[1] / square, v->axis[1]);
    return vec_unit(mixed(face, vec_unit(vec_sum(1, v->axis[2], -1, across)), least(2 * trust, d->smoothness)));
}

/* The share of the sun, whose edge is soft, that gets to a place. Each sample of a pixel looks at other points. */
static float sun_at(const drawing *d, vec place, int sample)
{
    const vec p = point_of(&d->sun, place);
    int lit = 0;
    for (int n = sample; n < DISK; n += SAMPLES) {
        const uint64_t seen = seen_at(&d->sun, (int)(p.at[0] + 4 * d->disk[n][0]), (int)(p.at[1] + 4 * d->disk[n][1]));
        lit += !seen || depth_of(seen) <= p.at[2];
    }
    return (float)lit * SAMPLES / DISK;
}

/* above: how far from the place voxels keep light off, in points of the sun's. */
static vec light_at(const drawing *d, vec place, vec normal, float above, int sample)
{
    const float slope = greatest(vec_dot(normal, d->sun.axis[2]), 0);
    const float sun = slope > 0 ? slope * sun_at(d, vec_sum(1, place, above / d->sun.scale, normal), sample) : 0;
    return vec_sum(sun, sun_colour, 0.71f + 0.29f * vec_dot(normal, d->up), sky_colour);
}

static vec voxel_at(const drawing *d, int x, int y, uint64_t seen, vec normal, int sample)
{
    const vec place = place_of(&d->eye, (float)x + 0.5f, (float)y + 0.5f, depth_of(seen));
    const float line = edge_line(d, place, axis_of(seen));
    vec light = light_at(d, place, normal, 4 + d->smoothness * d->sun.scale, sample);
    for (int c = 0; c < 3; c++)
        light.at[c] *= line * d->light.light[seen >> (16 - 8 * c) & 255];
    return light;
}

/* The ground has the colour of the background but for the shadow, which ends before it does. */
static vec ground_at(const drawing *d, int x, int y, vec paper, int sample)
{
    const vec start = place_of(&d->eye, (float)x + 0.5f, (float)y + 0.5f, 0), toward = d->eye.axis[2];
    const float ground = least(0, vec_dot(d->hi, d->up)) - 1e-4f * d->radius;
    const vec place = vec_sum(1, start, (ground - vec_dot(start, d->up)) / vec_dot(toward, d->up), toward);
    const vec apart = vec_sum(1, place, -1, d->middle);
    const float strength = 1 - ramp(1.2f, 3.2f, sqrtf(vec_dot(apart, apart)) / d->radius);
    const vec here = light_at(d, place, d->up, 0, sample),
              open = vec_sum(vec_dot(d->up, d->sun.axis[2]), sun_colour, 1, sky_colour);
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
    vec sum = {{0, 0, 0}}, normal = sum;
    uint64_t last = 0; /* whose normal is known, which the next share if they are about as far away */
    for (int s = 0; s < SAMPLES; s++) {
        const int x = FINE * column + s % FINE, y = FINE * row + s / FINE;
        const uint64_t seen = seen_at(&d->eye, x, y);
        const bool is_known = last && (d->smoothness >= 1 || axis_of(last) == axis_of(seen)) &&
                              fabsf(depth_of(last) - depth_of(seen)) < 1.5f * d->eye.scale;
        if (seen && !is_known) {
            normal = normal_at(d, x, y, seen);
            last = seen;
        }
        const vec light = seen ? voxel_at(d, x, y, seen, normal, s) : ground_at(d, x, y, paper, s);
        for (int c = 0; c < 3; c++)
            sum.at[c] += film(light.at[c]) / SAMPLES;
    }
    const rgb colour = rgb_of_light((const double[3]){sum.at[0], sum.at[1], sum.at[2]});
    memcpy(pixel, colour.at, sizeof colour.at);
}

static int draw_row(void *data, void *place, size_t row)
{
    const drawing *const d = data;
    const uint32_t columns = d->look->size[0], rows = d->look->size[1];
    const vec paper = mixed(paper_low, paper_high, ramp(0.1f, 1, 1 - (float)row / (float)rows));
    (void)place;
    for (uint32_t column = 0; column < columns; column++)
        draw_pixel(d, (int)column, (int)row, paper, d->pixels + 3 * (row * columns + column));
    progress_tell(d->bar, (double)(row + 1) / rows);
    return 0;
}

static void place_all(drawing *d)
{
    const double *const cell = d->v->grid.cell, longest = fmax(cell[0], fmax(cell[1], cell[2]));
    const int a = (int)d->look->up % 3;
    const vec right = {{a != 0, a == 0, 0}};
    for (int c = 0; c < 3; c++) {
        d->cell.at[c] = (float)(cell[c] / longest);
        d->hi.at[c] = d->cell.at[c] * (float)d->v->grid.size[c];
    }
    d->up.at[a] = d->look->up < 3 ? 1 : -1;
    const vec front = vec_cross(right, d->up), level = vec_sum(sinf(azimuth), right, cosf(azimuth), front);
    d->middle = vec_sum(0.5f, d->hi, 0, d->hi);
    d->radius = 1.01f * sqrtf(vec_dot(d->middle, d->middle));
    place_view(&d->eye, d, vec_sum(cosf(elevation), level, sinf(elevation), d->up), 0.90f);
    place_view(&d->sun, d, vec_sum(1, vec_sum(-0.85f, right, 0.5f, front), 0.95f, d->up), 0.98f);
    d->smoothness = least(greatest((5 - d->eye.scale / FINE) / 3, 0), 1);
    d->light = rgb_curve_make();
    for (int n = 0; n < DISK; n++) { /* a sunflower */
        const float turn = 2.39996323f * (float)n, out = sqrtf(((float)n + 0.5f) / DISK);
        d->disk[n][0] = out * cosf(turn);
        d->disk[n][1] = out * sinf(turn);
    }
}

static size_t samples_of(const picture_look *look) { return (size_t)SAMPLES * look->size[0] * look->size[1]; }

uint64_t preview_memory(const picture_look *look)
{
    return sizeof(uint64_t) * (samples_of(look) + MAP_SIDE * MAP_SIDE) + (uint64_t)3 * look->size[0] * look->size[1];
}

bool preview_pixels(const voxels *v, const picture_look *look, unsigned threads, unsigned char *pixels, progress *bar)
{
    drawing d = {.v = v, .pixels = pixels, .look = look, .bar = bar};
    d.eye = (view){.width = FINE * (int)look->size[0], .height = FINE * (int)look->size[1]};
    d.sun = (view){.width = MAP_SIDE, .height = MAP_SIDE};
    d.eye.seen = calloc(samples_of(look), sizeof *d.eye.seen);
    d.sun.seen = calloc(MAP_SIDE * MAP_SIDE, sizeof *d.sun.seen);
    const bool is_drawn = d.eye.seen && d.sun.seen;
    if (is_drawn) {
        place_all(&d);
        fill_view(&d, &d.eye);
        fill_view(&d, &d.sun);
        crew_do(&(crew_work){.threads = threads, .count = look->size[1], .step = draw_row}, &d);
    }
    free(d.eye.seen);
    free(d.sun.seen);
    return is_drawn;
}
