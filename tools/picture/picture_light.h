/* picture_light.h - a sun with a soft edge and a sky that is dimmer where less of it is seen: many lights, each with a map. */
#ifndef PICTURE_LIGHT_H
#define PICTURE_LIGHT_H

#include "picture_view.h"

/*
 * Every sample of a pixel is lit by other lights, so that the pixel is lit by all. Maps are squares with at most these points a
 * side.
 */
enum {
    PICTURE_SAMPLES = 4,
    PICTURE_SUNS = 6 * PICTURE_SAMPLES,
    PICTURE_SKIES = 12 * PICTURE_SAMPLES,
    PICTURE_LIGHTS = PICTURE_SUNS + PICTURE_SKIES,
    PICTURE_SUN_SIDE = 768,
    PICTURE_SKY_SIDE = 256,
    PICTURE_MAP_POINTS = PICTURE_SUNS * PICTURE_SUN_SIDE * PICTURE_SUN_SIDE + PICTURE_SKIES * PICTURE_SKY_SIDE * PICTURE_SKY_SIDE
};

typedef struct picture_light {
    picture_view view; /* of the voxels from the light */
    float strength;    /* of a light of the sky */
    uint16_t *depth;   /* of what the light meets first, 0 where it meets nothing */
} picture_light;

typedef struct picture_lights {
    vec sun, middle;                     /* where the sun is; the middle of the voxels */
    float radius;                        /* of a ball around them */
    picture_light light[PICTURE_LIGHTS]; /* suns, then skies */
} picture_lights;

/* Shares of the light upon what faces the sun, and, for the sky, about that upon level ground. */
typedef struct picture_lit {
    float sun, sky;
} picture_lit;

/*
 * Places lights, whose sun, middle and radius are there, with maps among PICTURE_MAP_POINTS depths. pixels: along the longer side
 * of the picture, as a small one is content with small maps.
 */
void picture_lights_place(picture_lights *l, vec up, int pixels, uint16_t *depths);

/* Fills in the map of light n. */
void picture_lights_cast(picture_lights *l, const picture_faces *f, int n);

/* The light upon a place. above: how far from it voxels keep light off, along the normal. */
picture_lit picture_lights_at(const picture_lights *l, vec place, vec normal, float above, int sample);

#endif
