/* mesh_floats.c - triangles of floats, by index or nine floats each, as they lie in memory: a block to the kernel. */
#include "mesh_floats.h"

#include <string.h>

#include "base/bits.h"
#include "pairs/pairs.h"

/* Adds what a part of a call has found. */
static void add(tribox_report *counts, tribox_report part)
{
    counts->overlapping += part.overlapping;
    counts->undecided += part.undecided;
}

/* At most TRIBOX_MESH_STREAMED triangles, by way of streams. */
TRIBOX_NOINLINE tribox_report answer_streams(const tribox_mesh *mesh, size_t first, size_t count, const tribox_rounded_box *box,
                                             tribox_plan *plan, uint64_t *mask)
{
    _Alignas(64) float streams[9][TRIBOX_MESH_STREAMED]; /* no packet in two lines of the cache */
    float *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    plan->kernel->gather(mesh, NULL, NULL, first, count, to);
    const tribox_soup soup = tribox_soup_of(&streams[0][0], TRIBOX_MESH_STREAMED, count);
    const tribox_query pairs = {.soup = &soup, .box = box, .count = count};
    return tribox_pairs_answer(&pairs, plan, mask);
}

void tribox_float_box_make(const tribox_box *box, const tribox_plan *plan, tribox_float_box *rounded)
{
    tribox_box_round(box, plan->axes & TRIBOX_AXES_BOX, plan->accuracy == TRIBOX_FAST, &rounded->box);
    rounded->pattern.origin = NULL;
    for (int k = 0; k < 3 * TRIBOX_LANES_MAX; k++) {
        rounded->pattern.lo[k] = rounded->box.lo[k % 3];
        rounded->pattern.hi[k] = rounded->box.hi[k % 3];
    }
}

static size_t answer_float_corners(const tribox_mesh_query *q, const tribox_mesh *mesh, const tribox_corners *corners,
                                   const size_t *first, size_t count, uint64_t *hit)
{
    const tribox_rounded_box *const box = &((const tribox_float_box *)q->about)->box;
    const tribox_query pairs = {.corners = corners, .box = box, .count = count};
    (void)mesh; /* corners are enough */
    (void)first;
    return tribox_pairs_answer_block(&pairs, q->plan, 0, tribox_words_of(count), hit);
}

tribox_answer_corners *tribox_mesh_floats_corners(const tribox_plan *plan)
{
    return tribox_mesh_are_corners_walked(plan) ? answer_float_corners : NULL;
}

/* Answers all of the block from where it lies to registers, if it can be read so; *is_there: whether its vertices are there. */
TRIBOX_NOINLINE bool answer_in_place(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t count,
                                     uint64_t *mask, tribox_report *counts, bool *is_there)
{
    uint32_t offset[3 * TRIBOX_MESH_BLOCK];
    tribox_corners corners;
    *is_there = q->plan->kernel->find_corners(mesh, first, count, offset, &corners) < mesh->vertices;
    if (!*is_there || !tribox_mesh_are_corners_walked(q->plan) || !corners.base || !corners.has_all ||
        count < q->plan->kernel->lanes)
        return false;
    const tribox_query pairs = {.corners = &corners, .box = &((const tribox_float_box *)q->about)->box, .count = count};
    add(counts, tribox_pairs_answer(&pairs, q->plan, mask));
    return true;
}

/* Else the first of them by way of streams: one after the other, so that the stack has only one of the two. */
size_t tribox_mesh_answer_floats(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                                 tribox_report *counts)
{
    bool is_there;
    if (answer_in_place(q, mesh, first, count, mask, counts, &is_there) || !is_there)
        return is_there ? count : 0;
    const size_t streamed = count < TRIBOX_MESH_STREAMED ? count : TRIBOX_MESH_STREAMED;
    add(counts, answer_streams(mesh, first, streamed, &((const tribox_float_box *)q->about)->box, q->plan, mask));
    return streamed;
}

/* Where so many corners lie, from the first on; in place of the last vertex of the mesh, `copy`. Returns the greatest number. */
TRIBOX_INLINE size_t find_places(const tribox_mesh *mesh, unsigned index_bytes, size_t count, const char *copy, const char **place)
{
    const tribox_mesh from = *mesh; /* known not to change while places are written */
    const char *const positions = from.positions;
    size_t greatest = 0;
    for (size_t k = 0; k < count; k++) {
        const size_t number = tribox_vertex_number(&from, index_bytes, k);
        greatest = number > greatest ? number : greatest;
        place[k] = number + 1 == from.vertices ? copy : positions + number * from.stride;
    }
    return greatest;
}

size_t tribox_mesh_answer_few(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                              tribox_report *counts)
{
    const char *place[3 * TRIBOX_MESH_FEW];
    float last[4] = {0};
    const char *const copy = (const char *)last;
    const unsigned bytes = tribox_vertex_bytes(mesh);
    const size_t corners = 3 * count, packets = 3 * q->plan->kernel->lanes;
    const size_t greatest = bytes == 4   ? find_places(mesh, 4, corners, copy, place)
                            : bytes == 2 ? find_places(mesh, 2, corners, copy, place)
                                         : find_places(mesh, 0, corners, copy, place);
    (void)first; /* it is 0 */
    if (greatest >= mesh->vertices)
        return 0;
    if (greatest + 1 == mesh->vertices)
        memcpy(last, (const char *)mesh->positions + greatest * mesh->stride, 3 * sizeof(float));
    const char *const repeated[3] = {place[0], place[1], place[2]};
    for (size_t k = corners; k % packets; k += 3)
        memcpy(place + k, repeated, sizeof repeated);
    const tribox_corners at = {.place = place};
    const tribox_query pairs = {.corners = &at, .box = &((const tribox_float_box *)q->about)->box, .count = count};
    add(counts, tribox_pairs_answer(&pairs, q->plan, mask));
    return count;
}
