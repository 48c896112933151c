/* brick_tile.c - one tile of a grid as a window: voxelized, and its bricks emitted. */
#include <float.h>

#include "base/environment.h"
#include "brick_call.h"

tribox_window tribox_brick_tile_window(const tribox_tiling *t, size_t tile)
{
    const size_t at[3] = {tile % t->along[0], tile / t->along[0] % t->along[1], tile / t->along[0] / t->along[1]};
    tribox_window w;
    for (int a = 0; a < 3; a++) {
        w.first[a] = (uint32_t)at[a] * t->side;
        w.size[a] = t->size[a] - w.first[a] < t->side ? t->size[a] - w.first[a] : t->side;
    }
    return w;
}

/* Of a block of triangles: whole packets are asked, and what follows the last triangle repeats it. */
static void find_ends_of_block(const tribox_bricks_call *s, size_t count, tribox_ends *z)
{
    for (size_t n = 6; n < 9; n++) {
        float *const number = s->block->u[n];
        for (size_t i = count; i < count + TRIBOX_LANES_MAX; i++)
            number[i] = number[count - 1];
        s->plan.kernel->cells->find_ends(number, count, z);
    }
}

/* Of doubles the ends are less plane 0, and rounded: by less than a layer, where they are sorted in float. */
static tribox_cells layers_between(const tribox_voxel_window *v, const tribox_ends *z)
{
    const double least = z->least < -FLT_MAX ? -FLT_MAX : z->least, most = z->most > FLT_MAX ? FLT_MAX : z->most;
    const double origin = v->doubles ? v->lattice.origin[2] : 0;
    tribox_cells layers = tribox_planes_cells(&v->planes, 2, v->size[2], origin + least, origin + most);
    layers.first -= v->doubles != NULL;
    layers.last += v->doubles != NULL;
    return layers;
}

/* Leaves the layers that triangles touch, from the first of a brick on: the others are empty (PROOFS.md 7.12). */
static void cut_layers(const tribox_voxels *v, const tribox_ends *z, tribox_window *w)
{
    const int64_t size = w->size[2];
    if (!(v->plan.axes & TRIBOX_AXES_BOX) || (v->window.doubles && !v->window.is_for_float))
        return;
    const tribox_cells layers = layers_between(&v->window, z);
    const int64_t from = layers.first < 0 ? 0 : layers.first / 8 * 8, end = layers.last < size ? layers.last + 1 : size;
    w->first[2] += (uint32_t)from;
    w->size[2] = z->least <= z->most && from < end ? (uint32_t)(end - from) : 0;
}

void tribox_bricks_put(tribox_bricks_call *s, tribox_voxels *v, const uint32_t *list, size_t count, tribox_ends *z)
{
    *z = (tribox_ends){FLT_MAX, -FLT_MAX};
    for (size_t at = 0; at < count; at += TRIBOX_LISTED) {
        const size_t some = count - at < TRIBOX_LISTED ? count - at : TRIBOX_LISTED;
        const tribox_soup soup =
            tribox_listed_gather(&s->triangles, s->plan.kernel, tribox_voxels_origin(v), list, at, some, s->block);
        if (v->window.has_numbers)
            memcpy(s->block->number, list + at, some * sizeof *list);
        tribox_voxels_put(v, &soup, s->block->number);
        find_ends_of_block(s, some, z);
    }
    tribox_voxels_end(v);
}

static void set_tile(tribox_bricks_call *s, tribox_window *w, const uint32_t *list, size_t count)
{
    tribox_voxels voxels, *const v = &voxels;
    tribox_ends z;
    const tribox_environment callers = tribox_environment_enter();
    v->plan = s->plan;
    tribox_voxels_begin(v, &s->triangles, s->grid, w, s->bits);
    if (s->ids.sink.take)
        tribox_voxels_ask_ids(v, s->ids.of_tile, 0);
    v->sinks.ids.has_room = true; /* they are ours, and followed by others */
    tribox_bricks_put(s, v, list, count, &z);
    s->counts.undecided += v->counts.undecided;
    cut_layers(v, &z, w);
    tribox_environment_leave(callers);
}

/* The environment of the sink is the caller's. */
bool tribox_bricks_of_tile(tribox_bricks_call *s, size_t number, const uint32_t *list, size_t count)
{
    const tribox_window all = tribox_brick_tile_window(&s->tiling, number);
    tribox_window w = s->ids.tile = all;
    set_tile(s, &w, list, count);
    uint64_t *const bits = s->bits + (w.first[2] - all.first[2]) * all.size[1] * tribox_words_of(all.size[0]);
    return s->plan.kernel->cells->emit(bits, w.first, w.size, &s->outlet);
}
