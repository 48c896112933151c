/* picture_light.c - a sun with a soft edge, a sky that is dimmer where less of it is seen, and a ground that meets the background. */
#include "picture_light.h"

#include "picture_normal.h"

static const double golden_angle = 2.39996322972865332;

/* Linear red, green and blue. */
static const vec sun_colour = {{1.72, 1.54, 1.28}}, sky_colour = {{0.52, 0.60, 0.74}}, clay = {{0.60, 0.50, 0.40}},
                 paper_low = {{0.78, 0.79, 0.80}}, paper_high = {{0.56, 0.63, 0.71}};
static const double free_sky = 0.85;      /* the light of the sky upon level ground without anything near */
static const double bounce = 0.42;        /* light from the ground and from other cells, as a share of the sky's */
static const double sky_reach = 0.6;      /* how far voxels keep the sky off, in radii */
static const double sun_radius = 0.045;   /* in radians */
static const double line_darkness = 0.25; /* of the edges of large cells */

static vec mixed(vec a, vec b, double share) { return vec_sum(1 - share, a, share, b); }

static vec scaled(vec colour, vec by)
{
    for (int c = 0; c < 3; c++)
        colour.at[c] *= by.at[c];
    return colour;
}

static double step_between(double lo, double hi, double x)
{
    const double t = fmin(fmax((x - lo) / (hi - lo), 0), 1);
    return t * t * (3 - 2 * t);
}

/* Two directions that make right angles with n and each other. */
static void span(vec n, vec *u, vec *v)
{
    const vec side = fabs(n.at[0]) < 0.6 ? (vec){{1, 0, 0}} : (vec){{0, 1, 0}};
    *u = vec_unit(vec_cross(side, n));
    *v = vec_cross(n, *u);
}

/* Points evenly spread over the area of a disc: a sunflower. */
static void sunflower(int n, double at[][2])
{
    for (int i = 0; i < n; i++) {
        const double r = sqrt((i + 0.5) / n);
        at[i][0] = r * cos(golden_angle * i);
        at[i][1] = r * sin(golden_angle * i);
    }
}

void picture_light_spread(picture_light *l)
{
    sunflower(PICTURE_SKY, l->sky);
    sunflower(PICTURE_SUN, l->sun_disc);
}

/* The share of the sun that a point sees. */
static double sun_seen(const picture_light *l, vec point, int sample)
{
    vec u, v;
    picture_hit hit;
    int seen = 0;
    span(l->sun, &u, &v);
    for (int i = sample; i < PICTURE_SUN; i += PICTURE_SAMPLES) {
        const vec offset = vec_sum(l->sun_disc[i][0] * sun_radius, u, l->sun_disc[i][1] * sun_radius, v);
        seen += !picture_trace(l->grid, point, vec_sum(1, l->sun, 1, offset), INFINITY, &hit);
    }
    return (double)seen * PICTURE_SAMPLES / PICTURE_SUN;
}

/* The light of the sky upon a surface, in shares of a free one's: points of a disc, lifted to the half ball above it. */
static double sky_seen(const picture_light *l, vec point, vec normal, int sample)
{
    const double reach = sky_reach * l->radius;
    double light = 0;
    vec u, v;
    span(normal, &u, &v);
    for (int i = sample; i < PICTURE_SKY; i += PICTURE_SAMPLES) {
        const double x = l->sky[i][0], y = l->sky[i][1];
        const vec aside = vec_sum(x, u, y, v), to = vec_sum(1, aside, sqrt(1 - x * x - y * y), normal);
        const double rise = vec_dot(to, l->up), free = rise >= 0 ? 0.55 + 0.45 * rise : bounce;
        picture_hit hit;
        const bool is_hit = picture_trace(l->grid, point, to, reach, &hit);
        const double nearness = is_hit ? 1 - hit.t / reach : 0;
        light += free * (1 - nearness) + nearness * nearness * 0.12;
    }
    return light * PICTURE_SAMPLES / PICTURE_SKY;
}

static vec background(double height) { return mixed(paper_low, paper_high, step_between(0.1, 1, height)); }

/* 1 within a cell, less by its edges, where a line of about a pixel shows which cells there are. */
static double edge_line(const picture_light *l, vec point, const picture_hit *hit)
{
    double nearest = 1;
    for (int a = 0; a < 3; a++) {
        const double within = point.at[a] / l->grid->cell[a] - hit->cell[a];
        if (a != hit->axis)
            nearest = fmin(nearest, fmin(within, 1 - within));
    }
    const double pixels = nearest * l->pixels, strength = line_darkness * step_between(4, 12, l->pixels);
    return 1 - strength * (1 - step_between(0.3, 1.3, pixels));
}

static vec voxel_seen(const picture_light *l, vec eye, vec direction, const picture_hit *hit, int sample)
{
    vec face = {{0, 0, 0}};
    face.at[hit->axis] = direction.at[hit->axis] > 0 ? -1 : 1;
    const vec point = vec_sum(1, eye, hit->t, direction);
    const vec smooth = l->smoothness > 0 ? picture_normal(l->grid, hit->cell, face, direction) : face;
    const vec normal = vec_unit(vec_sum(1 - l->smoothness, face, l->smoothness, smooth));
    const double cell = l->grid->cell[hit->axis];
    const vec above = vec_sum(1, vec_sum(1, point, 1e-3 * cell, face), 1.7 * l->smoothness * cell, normal);
    const double slope = vec_dot(normal, l->sun);
    const double sun = slope > 0 ? slope * sun_seen(l, above, sample) : 0;
    const double sky = sky_seen(l, above, normal, sample);
    return vec_sum(edge_line(l, point, hit), scaled(clay, vec_sum(sun, sun_colour, sky, sky_colour)), 0, clay);
}

/* The ground has the colour of the background but for the shadows on it, which end before it does. */
static vec ground_seen(const picture_light *l, vec point, vec paper, int sample)
{
    const vec apart = vec_sum(1, point, -1, l->middle);
    const double away = sqrt(fmax(0, vec_dot(apart, apart) - pow(vec_dot(apart, l->up), 2))) / l->radius;
    const double strength = 1 - step_between(1.2, 3.2, away);
    if (strength <= 0)
        return paper;
    const double slope = vec_dot(l->sun, l->up), off = vec_dot(apart, l->sun);
    const double distance = sqrt(vec_dot(apart, apart)), beside = sqrt(fmax(0, distance * distance - off * off));
    const bool is_in_sun = beside > l->radius + sun_radius * distance, is_under_sky = distance > (1 + sky_reach) * l->radius;
    if (is_in_sun && is_under_sky)
        return paper;
    const double sun = is_in_sun ? 1 : sun_seen(l, point, sample),
                 sky = is_under_sky ? free_sky : sky_seen(l, point, l->up, sample);
    const vec lit = vec_sum(slope, sun_colour, free_sky, sky_colour), here = vec_sum(slope * sun, sun_colour, sky, sky_colour);
    vec dimmed = paper;
    for (int c = 0; c < 3; c++)
        dimmed.at[c] *= fmin(here.at[c] / lit.at[c], 1);
    return mixed(paper, dimmed, strength);
}

vec picture_light_seen(const picture_light *l, vec eye, vec direction, double height, int sample)
{
    picture_hit hit;
    if (picture_trace(l->grid, eye, direction, INFINITY, &hit))
        return voxel_seen(l, eye, direction, &hit, sample);
    const vec paper = background(height);
    const double fall = -vec_dot(direction, l->up), above = vec_dot(eye, l->up) - l->ground;
    return fall > 0 && above > 0 ? ground_seen(l, vec_sum(1, eye, above / fall, direction), paper, sample) : paper;
}
