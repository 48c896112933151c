/* picture_view.h - voxels seen from far away, along parallel lines, and which of their faces each point of the view shows. */
#ifndef PICTURE_VIEW_H
#define PICTURE_VIEW_H

#include "picture_faces.h"
#include "vec.h"

/* Points are counted from the upper left. Depth is in points too, and greater nearer to the viewer. */
typedef struct picture_view {
    vec toward;  /* the viewer, of length 1 */
    vec axis[3]; /* where a point more to the right, down and nearer is: at right angles, of length scale */
    vec origin;  /* the point of the place 0, 0, 0 */
    float scale; /* points per length */
    int width, height;
} picture_view;

/* Looks against a direction, with 0, 0, 0 at 0, 0, 0 and scale 1. up: not parallel to it; up in the view as far as it can be. */
picture_view picture_view_against(vec toward, vec up);

/* Makes scale points of one, and moves a point to another. */
void picture_view_adjust(picture_view *v, float scale, vec from, vec to);

static inline vec picture_view_point(const picture_view *v, vec place)
{
    return (vec){{v->origin.at[0] + vec_dot(v->axis[0], place), v->origin.at[1] + vec_dot(v->axis[1], place),
                  v->origin.at[2] + vec_dot(v->axis[2], place)}};
}

static inline vec picture_view_place(const picture_view *v, vec point)
{
    const vec p = vec_sum(1 / (v->scale * v->scale), vec_sum(1, point, -1, v->origin), 0, point);
    return vec_sum(1, vec_sum(p.at[0], v->axis[0], p.at[1], v->axis[1]), p.at[2], v->axis[2]);
}

/*
 * What a point shows at a depth up to PICTURE_DEPTH_MAX, so that the greater of two is the nearer: 0 where there is nothing, else
 * its depth and the axis of a face.
 */
enum { PICTURE_DEPTH_STEPS = 4096, PICTURE_DEPTH_MAX = 1 << 17 };
static inline uint32_t picture_seen(float depth, int axis)
{
    return (uint32_t)(greatest(depth, 1) * PICTURE_DEPTH_STEPS) << 2 | (uint32_t)axis;
}
static inline float picture_seen_depth(uint32_t seen) { return (float)(seen >> 2) / PICTURE_DEPTH_STEPS; }
static inline int picture_seen_axis(uint32_t seen) { return (int)(seen & 3); }

/* Draws the faces into seen, width times height of them, all 0 before. */
void picture_view_draw(const picture_view *v, const picture_faces *f, uint32_t *seen);

#endif
