/* voxelizing.c - one voxelization: begun, given triangles of a soup or a mesh, and ended. */
#include "voxelizing.h"

#include "base/floats.h"
#include "pairs/partial_packet.h"

/* FAST would save error bounds alone, which cost little where triangles are of doubles. */
void tribox_voxels_begin(tribox_voxels *v, const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                         uint64_t *occupied)
{
    if (triangles->are_doubles && v->plan.accuracy == TRIBOX_FAST)
        v->plan.accuracy = TRIBOX_CONSERVATIVE;
    v->plan.kernel->cells->make_window(&v->window, grid, window, triangles->are_doubles ? &triangles->mesh : NULL, v->plan.axes);
    v->sinks.is_counted = false;
    tribox_voxels_empty_sinks(v, occupied);
}

void tribox_voxels_limit_layers(tribox_voxels *v, uint32_t first, uint32_t layers)
{
    v->window.first_layer = first;
    v->window.end_layer = (int64_t)first + layers;
    tribox_voxels_empty_sinks(v, v->sinks.occupied);
}

static bool has_whole_layers(const tribox_grid *grid, const tribox_window *window)
{
    return window->size[0] == grid->size[0] && window->size[1] == grid->size[1] && grid->size[2] <= 1 << 30;
}

void tribox_voxels_begin_window(tribox_voxels *v, const tribox_triangles *triangles, const tribox_grid *grid,
                                const tribox_window *window, uint64_t *occupied)
{
    if (has_whole_layers(grid, window)) {
        const tribox_window whole = tribox_whole_window(grid);
        tribox_voxels_begin(v, triangles, grid, &whole, occupied);
        tribox_voxels_limit_layers(v, window->first[2], window->size[2]);
    } else {
        tribox_voxels_begin(v, triangles, grid, window, occupied);
    }
}

void tribox_voxels_ask_pairs(tribox_voxels *v, const tribox_pair_sink *pairs)
{
    v->sinks.pairs = pairs;
    v->sinks.is_far = false; /* no words come into the cache */
    v->window.has_numbers = true;
}

void tribox_voxels_ask_ids(tribox_voxels *v, uint32_t *ids, uint32_t first)
{
    const uint32_t row_words = (uint32_t)v->sinks.row_words;
    v->sinks.ids = (tribox_cell_ids){
        .of = ids, .first = first, .row_words = row_words, .gap = (uint32_t)(64 * (uint64_t)row_words - v->window.size[0])};
    v->window.has_numbers = true;
}

static tribox_triangle triangle_at(const tribox_voxels *v, const tribox_soup *streams, const int32_t *number, size_t i)
{
    tribox_triangle triangle = {.number = v->window.has_numbers ? number[i] : 0};
    if (v->window.doubles)
        return tribox_window_read_triangle(&v->window, number[i]);
    for (int n = 0; n < 9; n++)
        triangle.u[n] = (double)tribox_float_at(tribox_soup_axis(streams, n / 3)[n % 3] + i);
    return triangle;
}

/* Without the box normals a triangle may overlap cells anywhere: every cell is tested by its own box. */
static void put_one(tribox_voxels *v, const tribox_triangle *triangle)
{
    if (v->plan.axes & TRIBOX_AXES_BOX)
        tribox_voxels_add_triangle(v, triangle);
    else
        tribox_voxels_wait_everywhere(v, triangle);
}

void tribox_voxels_put(tribox_voxels *v, const tribox_soup *streams, const int32_t *number)
{
    if (v->window.is_for_float && streams->count) {
        v->window.number = v->window.has_numbers ? number : NULL;
        v->plan.kernel->cells->sort(v, streams);
        return;
    }
    for (size_t i = 0; i < streams->count; i++) {
        const tribox_triangle triangle = triangle_at(v, streams, number, i);
        put_one(v, &triangle);
    }
}

/* Triangles that have no numbers: as they lie in a soup. */
static void put_soup(tribox_voxels *v, const tribox_soup *soup)
{
    tribox_partial_packet partial;
    tribox_voxels_put(v, tribox_pad_triangles(soup, v->plan.kernel, &partial), NULL);
}

/*
 * Triangles have numbers of 32 bits in a part of a mesh, which is whole before the next one begins. Room and numbers are not
 * cleared: a call about few triangles would take longer for that than for all else.
 */
static void put_streams(tribox_voxels *v, const tribox_triangles *triangles)
{
    enum { PART = 1 << 30 };
    tribox_stream_room room;
    int32_t number[TRIBOX_STREAMED];
    const size_t at_once = tribox_triangles_at_once(triangles);
    const size_t most = v->window.has_numbers && at_once > TRIBOX_STREAMED ? TRIBOX_STREAMED : at_once;
    for (size_t at = 0, some; at < triangles->count; at += some) {
        const size_t left = triangles->count - at;
        some = left < most ? left : most;
        if (at - v->window.first_triangle >= PART) {
            tribox_voxels_end(v);
            v->window.first_triangle = at;
        }
        for (size_t i = 0; v->window.has_numbers && i < some; i++)
            number[i] = (int32_t)(at - v->window.first_triangle + i);
        const tribox_soup streams = tribox_triangles_stream(triangles, v->plan.kernel, tribox_voxels_origin(v), at, some, &room);
        tribox_voxels_put(v, &streams, number);
    }
}

/* Triangles that fill no packet, number by number. */
static void put_few(tribox_voxels *v, const tribox_triangles *triangles)
{
    static const int32_t number[TRIBOX_LANES_MAX] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    double u[9][TRIBOX_LANES_MAX];
    float nine[TRIBOX_LANES_MAX][9];
    tribox_partial_packet partial;
    tribox_triangles_read(triangles, 0, triangles->count, &u[0][0], TRIBOX_LANES_MAX);
    for (size_t i = 0; i < triangles->count; i++)
        for (int n = 0; n < 9; n++)
            tribox_float_put(&nine[i][n], u[n][i] - (triangles->are_doubles ? tribox_voxels_origin(v)[n / 3] : 0));
    v->plan.kernel->cells->spread_nines((const float(*)[9])nine, triangles->count, &partial);
    tribox_voxels_put(v, &partial.soup, number);
}

void tribox_voxels_put_all(tribox_voxels *v, const tribox_triangles *triangles)
{
    const size_t few = triangles->are_doubles ? v->plan.kernel->lanes : 2; /* of more than one, floats are streams as soon */
    if (triangles->is_soup && !v->window.has_numbers)
        put_soup(v, triangles->soup);
    else if (!TRIBOX_WALKS_SOUPS_ALONE && triangles->count && triangles->count < few)
        put_few(v, triangles);
    else
        put_streams(v, triangles);
}

void tribox_voxels_end(tribox_voxels *v)
{
    if (v->window.is_for_float)
        v->plan.kernel->cells->finish(v);
    tribox_voxels_set_strips(v);
    if (v->sinks.waiting.count)
        tribox_voxels_settle_waiting(v);
    else if (v->sinks.pairs) /* strips list theirs, too */
        v->plan.kernel->cells->write(v);
}
