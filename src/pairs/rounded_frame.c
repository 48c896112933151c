/* rounded_frame.c - an oriented box of doubles, as floats that answer for it. */
#include "rounded_frame.h"

#include <float.h>
#include <math.h>

#include "base/floats.h"
#include "base/rounded_box.h"

/* A number of an axis. Rounded among subnormal floats it moves by 2^-150 at most. */
static void round_number(double number, float *nearest, float *size)
{
    *nearest = tribox_float_nearest(number);
    *size = fabsf(*nearest);
    if ((double)*nearest != number && *size < FLT_MIN)
        *size = FLT_MIN;
}

/* The box on axis k, about what the center leaves there. */
static void round_bounds(tribox_rounded_frame *frame, int k, double half)
{
    const double middle = frame->middle[k], slack = frame->slack[k];
    frame->outer_hi[k] = tribox_float_from(middle + half + slack);
    frame->outer_lo[k] = -tribox_float_from(half - middle + slack);
    frame->inner_hi[k] = -tribox_float_from(-(middle + half - slack));
    frame->inner_lo[k] = tribox_float_from(middle - half + slack);
}

/* Axis k, where `rest` is what of the center is left. */
static void round_axis(const tribox_oriented_box *box, int k, const double rest[3], bool are_rounded, tribox_rounded_frame *frame)
{
    double middle = 0, reach = 0, size = 0;
    for (int a = 0; a < 3; a++) {
        round_number(box->axis[k][a], &frame->axis[k][a], &frame->size[k][a]);
        size += (double)frame->size[k][a];
        middle += box->axis[k][a] * rest[a];
        reach += fabs(box->axis[k][a] * rest[a]);
    }
    const bool is_narrow = !(reach <= FLT_MAX); /* a NaN too */
    frame->middle[k] = is_narrow ? 0 : middle;
    frame->slack[k] = is_narrow || reach == 0 ? 0 : 0x1p-49 * reach + 0x1p-51 * box->half[k];
    frame->lost[k] = is_narrow ? INFINITY : are_rounded ? (float)(0x1p-149 * size) : 0;
}

/*
 * 64 times the longest side of the box, but of sides beyond 1024 times the shortest that is there: their ends are as far as other
 * triangles. Any number would do: it decides how near its own an error is, and the time.
 */
static float near_of(const tribox_oriented_box *box)
{
    double longest = 0, shortest = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double x = fabs(box->axis[k][0]), y = fabs(box->axis[k][1]), z = fabs(box->axis[k][2]);
        const double side = box->half[k] > 0 ? box->half[k] / (x > y ? x > z ? x : z : y > z ? y : z) : 0;
        longest = side > longest ? side : longest;
        shortest = side > 0 && side < shortest ? side : shortest;
    }
    return (float)(64 * (longest < 1024 * shortest ? longest : 1024 * shortest));
}

float tribox_frame_error(const tribox_rounded_frame *frame, int k, float reach)
{
    const double size = (double)frame->size[k][0] + (double)frame->size[k][1] + (double)frame->size[k][2];
    return tribox_float_from(0x1p-21 * size * (double)reach + 0x1p-120 + (double)frame->lost[k]);
}

void tribox_frame_round(const tribox_oriented_box *box, const double *origin, bool are_rounded, tribox_rounded_frame *frame)
{
    double rest[3];
    frame->near = near_of(box);
    for (int a = 0; a < 3; a++) {
        const double less = origin ? origin[a] : 0, difference = box->center[a] - less;
        frame->center[a] = tribox_float_nearest(difference);
        rest[a] = (difference - (double)frame->center[a]) + tribox_lost_by_difference(box->center[a], less);
    }
    for (int k = 0; k < 3; k++) {
        round_axis(box, k, rest, are_rounded, frame);
        round_bounds(frame, k, box->half[k]);
    }
}
