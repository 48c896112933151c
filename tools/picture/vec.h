/* vec.h - vectors of three floats. */
#ifndef VEC_H
#define VEC_H

#include <math.h>

typedef struct vec {
    float at[3];
} vec;

static inline vec vec_sum(float s, vec a, float t, vec b) /* s a + t b */
{
    return (vec){{s * a.at[0] + t * b.at[0], s * a.at[1] + t * b.at[1], s * a.at[2] + t * b.at[2]}};
}

static inline float vec_dot(vec a, vec b) { return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2]; }

static inline vec vec_cross(vec a, vec b)
{
    return (vec){
        {a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2], a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
}

static inline vec vec_unit(vec a) { return vec_sum(1 / sqrtf(vec_dot(a, a)), a, 0, a); }

/* fminf and fmaxf care for NaN, which takes a call. */
static inline float least(float a, float b) { return a < b ? a : b; }
static inline float greatest(float a, float b) { return a > b ? a : b; }

#endif
