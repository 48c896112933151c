/* picture_ray.h - vectors, and rays through the cells of a picture_grid. */
#ifndef PICTURE_RAY_H
#define PICTURE_RAY_H

#include <math.h>

#include "picture_grid.h"

typedef struct vec {
    double at[3];
} vec;

static inline vec vec_sum(double s, vec a, double t, vec b) /* s a + t b */
{
    return (vec){{s * a.at[0] + t * b.at[0], s * a.at[1] + t * b.at[1], s * a.at[2] + t * b.at[2]}};
}

static inline double vec_dot(vec a, vec b) { return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2]; }

static inline vec vec_cross(vec a, vec b)
{
    return (vec){
        {a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2], a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
}

static inline vec vec_unit(vec a) { return vec_sum(1 / sqrt(vec_dot(a, a)), a, 0, a); }

/* Lengths are those of the picture_grid: cell (i, j, k) starts at (i, j, k) times its cell lengths. */
typedef struct picture_hit {
    double t; /* origin + t * direction */
    int cell[3];
    int axis; /* of the face that was hit */
} picture_hit;

/* The first occupied cell that a ray enters with 0 < t < most; a cell that holds the origin is passed by. */
bool picture_trace(const picture_grid *g, vec origin, vec direction, double most, picture_hit *hit);

#endif
