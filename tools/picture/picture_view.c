/* picture_view.c - fills the parallelograms that faces are in a view. */
#include "picture_view.h"

picture_view picture_view_against(vec toward, vec up)
{
    picture_view v = {.toward = toward, .scale = 1};
    v.axis[0] = vec_unit(vec_cross(up, toward));
    v.axis[1] = vec_cross(v.axis[0], toward);
    v.axis[2] = toward;
    return v;
}

void picture_view_adjust(picture_view *v, float scale, vec from, vec to)
{
    v->scale *= scale;
    v->origin = vec_sum(1, to, scale, vec_sum(1, v->origin, -1, from));
    for (int a = 0; a < 3; a++)
        v->axis[a] = vec_sum(scale, v->axis[a], 0, from);
}

/* The faces of an axis differ in place alone. */
typedef struct shape {
    int axis;
    vec corner;         /* from the lowest corner of the cell to that of the face */
    vec step[3];        /* from cell to cell */
    float lo[2], hi[2]; /* how far the face reaches from its corner */
    float to[2][2];     /* to shares of the face's two sides, 0 to 1 */
    float slope[2];     /* of depth */
} shape;

static shape shape_of(const picture_view *v, const picture_faces *f, int axis, int side)
{
    shape s = {.axis = axis};
    const vec origin = picture_view_point(v, (vec){{0, 0, 0}});
    for (int a = 0; a < 3; a++) {
        vec cell = {{0, 0, 0}};
        cell.at[a] = f->cell[a];
        s.step[a] = vec_sum(1, picture_view_point(v, cell), -1, origin);
    }
    s.corner = vec_sum((float)side, s.step[axis], 1, origin);
    const vec p = s.step[(axis + 1) % 3], q = s.step[(axis + 2) % 3];
    const float area = p.at[0] * q.at[1] - p.at[1] * q.at[0];
    s.to[0][0] = q.at[1] / area;
    s.to[0][1] = -q.at[0] / area;
    s.to[1][0] = -p.at[1] / area;
    s.to[1][1] = p.at[0] / area;
    for (int c = 0; c < 2; c++) {
        s.lo[c] = least(p.at[c], 0) + least(q.at[c], 0);
        s.hi[c] = greatest(p.at[c], 0) + greatest(q.at[c], 0);
        s.slope[c] = s.to[0][c] * p.at[2] + s.to[1][c] * q.at[2];
    }
    return s;
}

static int clamp(float x, int most) { return x < 0 ? 0 : x > (float)most ? most : (int)x; }

/* A point shows the face if its middle lies within; a little beyond is within too, so that neighbours leave no gap. */
static void fill(const picture_view *v, const shape *s, const picture_face *face, uint32_t *seen)
{
    static const float gap = 1e-3f;
    vec corner = s->corner;
    for (int a = 0; a < 3; a++)
        corner = vec_sum(1, corner, face->cell[a], s->step[a]);
    const int first_x = clamp(corner.at[0] + s->lo[0], v->width), last_x = clamp(corner.at[0] + s->hi[0] + 1, v->width);
    const int first_y = clamp(corner.at[1] + s->lo[1], v->height), last_y = clamp(corner.at[1] + s->hi[1] + 1, v->height);
    for (int y = first_y; y < last_y; y++)
        for (int x = first_x; x < last_x; x++) {
            const float dx = (float)x + 0.5f - corner.at[0], dy = (float)y + 0.5f - corner.at[1];
            const float p = s->to[0][0] * dx + s->to[0][1] * dy, q = s->to[1][0] * dx + s->to[1][1] * dy;
            uint32_t *at = &seen[(size_t)y * (size_t)v->width + (size_t)x];
            if (least(p, q) < -gap || greatest(p, q) > 1 + gap)
                continue;
            const uint32_t here = picture_seen(corner.at[2] + s->slope[0] * dx + s->slope[1] * dy, s->axis);
            *at = here > *at ? here : *at;
        }
}

void picture_view_draw(const picture_view *v, const picture_faces *f, uint32_t *seen)
{
    for (int a = 0; a < 3; a++) {
        const int side = v->toward.at[a] > 0;
        if (fabsf(v->toward.at[a]) < 1e-4f)
            continue; /* seen edge on */
        const shape s = shape_of(v, f, a, side);
        if (!isfinite(s.slope[0]) || !isfinite(s.slope[1]))
            continue; /* cells so flat that the face is a line */
        for (size_t i = 0; i < f->count[a][side]; i++)
            fill(v, &s, &f->list[a][side][i], seen);
    }
}
