/* picture_light.h - what a ray of the picture sees: voxels under sun and sky, on ground that takes their shadow. */
#ifndef PICTURE_LIGHT_H
#define PICTURE_LIGHT_H

#include "picture_ray.h"

/* Rays of a pixel; each looks at another part of sun and sky, so that together they see all of it, and no pixel another part. */
enum { PICTURE_SAMPLES = 4, PICTURE_SKY = 6 * PICTURE_SAMPLES, PICTURE_SUN = 4 * PICTURE_SAMPLES };

typedef struct picture_light {
    const picture_grid *grid;
    vec up, sun;
    double ground;     /* how far up the ground lies */
    vec middle;        /* of the voxels */
    double radius;     /* of a ball around them */
    double pixels;     /* that a cell is wide, about */
    double smoothness; /* 0: a face has its own normal; 1: cells are as small as pixels, and the surface that they make has one */
    double sky[PICTURE_SKY][2], sun_disc[PICTURE_SUN][2]; /* points on a disc of radius 1, one for each ray */
} picture_light;

/* Fills in the points on the discs. */
void picture_light_spread(picture_light *l);

/* The colour that a sample sees: linear red, green and blue. height: 0 at the lower edge of the picture, 1 at the upper. */
vec picture_light_seen(const picture_light *l, vec eye, vec direction, double height, int sample);

#endif
