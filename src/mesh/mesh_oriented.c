/*
 * mesh_oriented.c - triangles of a mesh against an oriented box: floats as they are, as those of a soup; doubles as the floats
 * nearest to what they are from the center of the box, which is in double.
 */
#include "mesh_input.h"

static bool has_doubles(const tribox_mesh *mesh) { return mesh->position_bytes == sizeof(double); }

/* Fewer triangles than a packet has are followed by the first. */
static void pad_streams(tribox_streams *room, size_t count, size_t lanes)
{
    for (int k = 0; k < 9; k++)
        for (size_t i = count; i < lanes; i++)
            room->number[k][i] = room->number[k][0];
}

static tribox_soup mesh_block(const tribox_oriented_query *q, size_t first, size_t count, tribox_streams *room)
{
    const tribox_mesh *const mesh = q->triangles;
    float *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = room->number[k];
    tribox_mesh_write_soup(mesh, q->plan->kernel, has_doubles(mesh) ? q->box->center : NULL, NULL, first, count, to);
    pad_streams(room, count, q->plan->kernel->lanes);
    return tribox_soup_of(room->number[0], TRIBOX_ORIENTED_BLOCK, count);
}

static void mesh_triangle(const tribox_oriented_query *q, size_t i, double u[3][3])
{
    tribox_mesh_read_corners(q->triangles, 3 * i, 3, u);
}

void tribox_oriented_ask_mesh(tribox_oriented_query *q, const tribox_mesh *mesh, const tribox_oriented_box *box, tribox_plan *plan)
{
    *q = (tribox_oriented_query){.box = box,
                                 .plan = plan,
                                 .triangles = mesh,
                                 .count = mesh->count,
                                 .read_block = mesh_block,
                                 .read_triangle = mesh_triangle};
    tribox_frame_round(box, has_doubles(mesh) ? box->center : NULL, has_doubles(mesh), &q->frame);
}
