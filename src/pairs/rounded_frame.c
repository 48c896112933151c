/* rounded_frame.c - an oriented box of doubles, as floats that answer for it. */
#include "rounded_frame.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/environment.h"
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

/* The axis of space that axis k of the box is, up or down, if the others do not see it; else -1. */
static int space_axis_of(const tribox_oriented_box *box, int k)
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        if (fabs(box->axis[k][a]) == 1 && box->axis[k][b] == 0 && box->axis[k][c] == 0 && box->axis[(k + 1) % 3][a] == 0 &&
            box->axis[(k + 2) % 3][a] == 0)
            return a;
    }
    return -1;
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
    frame->lost[k] = is_narrow ? INFINITY : 0x1p-120f + (are_rounded ? (float)(0x1p-149 * size) : 0);
}

static bool are_bounds_doubles(double middle, double half)
{
    return fabs(tribox_lost_by_difference(middle, half)) + fabs(tribox_lost_by_difference(middle, -half)) == 0;
}

/* The same of an axis of space, of which all of the center is left: a place is as exact as a coordinate. */
static void forget_rounding(const tribox_oriented_box *box, int k, tribox_rounded_frame *frame)
{
    memset(frame->size[k], 0, sizeof frame->size[k]);
    frame->lost[k] = frame->lost[k] < INFINITY ? 0 : INFINITY;
    if (are_bounds_doubles(frame->middle[k], box->half[k]))
        frame->slack[k] = 0;
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
    return tribox_float_from(0x1p-21 * size * (double)reach + (double)frame->lost[k]);
}

void tribox_frame_round(const tribox_oriented_box *box, const double *origin, bool are_rounded, tribox_rounded_frame *frame)
{
    double rest[3];
    int space_axis[3];
    bool is_moved[3] = {true, true, true};
    for (int k = 0; k < 3; k++) {
        space_axis[k] = origin || are_rounded ? -1 : space_axis_of(box, k);
        if (space_axis[k] >= 0)
            is_moved[space_axis[k]] = false;
    }
    for (int a = 0; a < 3; a++) {
        const double less = origin ? origin[a] : 0, difference = box->center[a] - less;
        frame->near[a] = is_moved[a] ? near_of(box) : INFINITY;
        frame->center[a] = is_moved[a] ? tribox_float_nearest(difference) : 0;
        rest[a] = (difference - (double)frame->center[a]) + tribox_lost_by_difference(box->center[a], less);
    }
    for (int k = 0; k < 3; k++) {
        round_axis(box, k, rest, are_rounded, frame);
        if (space_axis[k] >= 0)
            forget_rounding(box, k, frame);
        round_bounds(frame, k, box->half[k]);
    }
}

bool tribox_oriented_is_upright(const tribox_oriented_box *box, tribox_box *upright)
{
    const tribox_environment callers = tribox_environment_enter();
    bool is = true;
    for (int k = 0; is && k < 3; k++) {
        const int a = space_axis_of(box, k);
        is = a >= 0 && are_bounds_doubles(box->center[a], box->half[k]);
        if (is) {
            upright->lo[a] = box->center[a] - box->half[k];
            upright->hi[a] = box->center[a] + box->half[k];
        }
    }
    tribox_environment_leave(callers);
    return is;
}
