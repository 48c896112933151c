/* picture_light.c - finds how far each light gets: faces become points, dense enough that each point of a map meets one. */
#include "picture_light.h"

#include <string.h>

enum { DEPTH_STEPS = 32 }; /* in a point of a map */

static const float density = 1.3f; /* points of a face in a point of a map, along each side: seen at an angle, 1 leaves gaps */

static const float sun_radius = 0.045f; /* radians */
static const float sky_reach = 0.5f;    /* how far voxels keep the sky off, in radii */
static const float bounce = 0.42f;      /* light from below, as a share of the sky's */

static picture_view map_view(const picture_lights *l, vec toward, int side)
{
    picture_view v = picture_view_against(toward, (vec){{0.36f, 0.48f, 0.8f}});
    const float half = 0.5f * (float)side;
    picture_view_adjust(&v, half / l->radius, picture_view_point(&v, l->middle), (vec){{half, half, half}});
    v.width = v.height = side;
    return v;
}

static int least_of(int a, int b) { return a < b ? a : b; }

/* No finer than cells where those are nearly as large as points, as each then takes one point. */
static int map_side(const picture_lights *l, int most)
{
    const float side = 2 * l->radius / (density + 0.01f);
    return side > 0.6f * (float)most && side < (float)most ? (int)side : most;
}

/* A sunflower: light n is turned by the golden angle from the last one. */
static vec turned(vec x, vec y, int n)
{
    const float turn = fmodf(2.39996323f * (float)n, 6.28318531f);
    return vec_sum(cosf(turn), x, sinf(turn), y);
}

void picture_lights_place(picture_lights *l, vec up, int pixels, uint16_t *depths)
{
    const int sun_side = map_side(l, least_of(PICTURE_SUN_SIDE, pixels * 3 / 5 + 8)),
              sky_side = map_side(l, least_of(PICTURE_SKY_SIDE, pixels * 2 / 5 + 8));
    const picture_view sun = picture_view_against(l->sun, up);
    const vec level = {{up.at[1], up.at[2], up.at[0]}}, across = vec_cross(up, level);
    for (int n = 0; n < PICTURE_LIGHTS; n++) {
        const bool is_sun = n < PICTURE_SUNS;
        const int i = is_sun ? n : n - PICTURE_SUNS, side = is_sun ? sun_side : sky_side;
        const float rise = 1 - (2 * (float)i + 1) / PICTURE_SKIES, out = sun_radius * sqrtf(((float)i + 0.5f) / PICTURE_SUNS);
        const vec toward = is_sun ? vec_sum(1, l->sun, out, turned(sun.axis[0], sun.axis[1], i))
                                  : vec_sum(rise, up, sqrtf(1 - rise * rise), turned(level, across, i));
        l->light[n] = (picture_light){map_view(l, vec_unit(toward), side), rise > 0 ? 0.55f + 0.45f * rise : bounce, depths};
        depths += side * side;
    }
}

static void cast_side(picture_light *l, const picture_faces *f, int axis, int side)
{
    const picture_view *v = &l->view;
    const int parts = (int)ceilf(density * v->scale), b = (axis + 1) % 3, c = (axis + 2) % 3;
    const uint16_t skipped = density * v->scale < 0.5f; /* faces on odd rows, where the map is coarse */
    vec step[3], part[3], start = v->origin;
    for (int a = 0; a < 3; a++) {
        step[a] = (vec){{f->cell[a] * v->axis[0].at[a], f->cell[a] * v->axis[1].at[a], f->cell[a] * v->axis[2].at[a]}};
        part[a] = vec_sum(1 / (float)parts, step[a], 0, start);
        start = a == axis ? vec_sum(1, start, (float)side, step[a]) : vec_sum(1, start, 0.5f, part[a]);
    }
    for (size_t i = 0; i < f->count[axis][side]; i++) {
        const uint16_t *cell = f->list[axis][side][i].cell;
        if ((cell[b] | cell[c]) & skipped)
            continue;
        vec line = vec_sum(1, vec_sum(1, start, cell[0], step[0]), 1, vec_sum(cell[1], step[1], cell[2], step[2]));
        for (int m = 0; m < parts; m++, line = vec_sum(1, line, 1, part[b])) {
            vec at = line;
            for (int n = 0; n < parts; n++, at = vec_sum(1, at, 1, part[c])) {
                uint16_t *depth = &l->depth[(int)at.at[1] * v->width + (int)at.at[0]];
                const uint16_t here = (uint16_t)(int)(at.at[2] * DEPTH_STEPS);
                *depth = here > *depth ? here : *depth;
            }
        }
    }
}

void picture_lights_cast(picture_lights *l, const picture_faces *f, int n)
{
    picture_light *light = &l->light[n];
    memset(light->depth, 0, (size_t)light->view.width * (size_t)light->view.width * sizeof *light->depth);
    for (int a = 0; a < 3; a++)
        cast_side(light, f, a, light->view.toward.at[a] > 0);
}

/* How far before a place the light is kept off, in points: not above 0 if it is not, or the place is beyond the map. */
static inline float kept_off(const picture_light *l, vec place)
{
    const vec p = picture_view_point(&l->view, place);
    const int side = l->view.width, x = (int)p.at[0], y = (int)p.at[1];
    if ((unsigned)x >= (unsigned)side || (unsigned)y >= (unsigned)side)
        return 0;
    const uint16_t depth = l->depth[y * side + x];
    return depth ? (float)depth / DEPTH_STEPS - p.at[2] : 0;
}

static float sun_at(const picture_lights *l, vec place, int sample)
{
    const vec apart = vec_sum(1, place, -1, l->middle);
    const float off = vec_dot(apart, l->sun), distance = vec_dot(apart, apart), far = l->radius - sun_radius * least(off, 0);
    int seen = 0;
    if (distance - off * off > far * far)
        return 1; /* beside the shadow of the ball */
    for (int n = sample; n < PICTURE_SUNS; n += PICTURE_SAMPLES)
        seen += kept_off(&l->light[n], place) <= 0;
    return (float)seen * PICTURE_SAMPLES / PICTURE_SUNS;
}

static float sky_at(const picture_lights *l, vec place, vec normal, int sample)
{
    const float scale = 1 / (sky_reach * l->radius * l->light[PICTURE_SUNS].view.scale);
    float sum = 0;
    for (int n = PICTURE_SUNS + sample; n < PICTURE_LIGHTS; n += PICTURE_SAMPLES) {
        const picture_light *light = &l->light[n];
        const float slope = vec_dot(normal, light->view.toward);
        if (slope <= 0)
            continue;
        const float gap = kept_off(light, place), near = gap > 0 ? greatest(1 - gap * scale, 0) : 0;
        sum += slope * (light->strength * (1 - near) + 0.12f * near * near);
    }
    return sum * 4 * PICTURE_SAMPLES / PICTURE_SKIES;
}

picture_lit picture_lights_at(const picture_lights *l, vec place, vec normal, float above, int sample)
{
    const float slope = vec_dot(normal, l->sun), sun_point = 1.5f / l->light[0].view.scale,
                sky_point = 1.5f / l->light[PICTURE_SUNS].view.scale;
    const float sun = slope > 0 ? slope * sun_at(l, vec_sum(1, place, above + sun_point, normal), sample) : 0;
    return (picture_lit){sun, sky_at(l, vec_sum(1, place, above + sky_point, normal), normal, sample)};
}
