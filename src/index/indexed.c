/* indexed.c - triangles of a soup where they lie, those of a mesh by way of streams, some words at a time. */
#include "indexed.h"

#include <string.h>

#include "base/finite.h"
#include "local_bounds.h"
#include "mesh/mesh_input.h"
#include "plan.h"

/* Words that are read at a time, and their triangles: 36 KB of streams. */
enum { WORDS = TRIBOX_LANES_MAX, TRIANGLES = 64 * WORDS, NODE_TRIANGLES = 64 * 64 };

bool tribox_indexed_take(const tribox_index *index, tribox_indexed *over)
{
    if (!index || !index->soup == !index->mesh || !tribox_are_reserved_zero(index->reserved))
        return false;
    over->soup = index->soup;
    over->are_doubles = false;
    if (index->soup) {
        over->count = index->soup->count;
        return tribox_soup_is_readable(index->soup);
    }
    if (!tribox_mesh_take(index->mesh, &over->mesh))
        return false;
    over->are_doubles = tribox_position_bytes(&over->mesh) == sizeof(double);
    over->count = over->mesh.count;
    return true;
}

/* Whether all numbers of a triangle are finite; they are read in any case. */
static bool read_finite(const tribox_mesh *mesh, size_t triangle, double u[3][3])
{
    tribox_mesh_read_corners(mesh, 3 * triangle, 3, u);
    return tribox_are_finite_doubles(u[0], 9);
}

/* The first vertex of the first finite triangle; zero if there is none. */
static void find_origin(const tribox_mesh *mesh, size_t first, size_t count, double origin[3])
{
    double u[3][3];
    for (size_t i = first; i < first + count; i++)
        if (read_finite(mesh, i, u)) {
            memcpy(origin, u[0], sizeof u[0]);
            return;
        }
}

/* Finite numbers that became infinite as they were rounded. */
static void end_at_greatest(const tribox_mesh *mesh, const double origin[3], size_t first, size_t count, float *const to[9])
{
    double u[3][3];
    for (size_t i = 0; i < count; i++) {
        bool is_finite = true;
        for (int k = 0; k < 9; k++)
            is_finite &= tribox_is_finite(to[k][i]);
        for (size_t k = 0; !is_finite && read_finite(mesh, first + i, u) && k < 9; k++)
            to[k][i] = tribox_number_seen(u[k % 3][k / 3], origin[k / 3]);
    }
}

/* Whether triangles of these words are missing or not finite, as floats: then they are looked at once more. */
static bool has_gaps(const tribox_node *node, int child) { return (~node->whole >> child & ((UINT64_C(1) << WORDS) - 1)) != 0; }

static void bound_mesh(const tribox_indexed *over, const tribox_kernel *kernel, size_t first, size_t count, tribox_node *node)
{
    _Alignas(64) float streams[9][TRIANGLES];
    const double *const origin = over->are_doubles ? node->origin : NULL;
    float *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    for (int child = 0; child < 64; child += WORDS) {
        const size_t done = 64 * (size_t)child, left = done < count ? count - done : 0, some = left < TRIANGLES ? left : TRIANGLES;
        const tribox_soup soup = tribox_soup_of(&streams[0][0], TRIANGLES, some);
        if (some)
            tribox_mesh_write_soup(&over->mesh, kernel, origin, NULL, first + done, some, to);
        kernel->nodes->bound_words(&soup, 0, child, child + WORDS, node);
        if (some && origin && has_gaps(node, child)) {
            end_at_greatest(&over->mesh, origin, first + done, some, to);
            kernel->nodes->bound_words(&soup, 0, child, child + WORDS, node);
        }
    }
}

void tribox_indexed_bound(const tribox_indexed *over, const tribox_kernel *kernel, size_t first, tribox_node *node)
{
    const size_t left = over->count - first, count = left < NODE_TRIANGLES ? left : NODE_TRIANGLES;
    *node = (tribox_node){.whole = 0};
    if (over->soup) {
        kernel->nodes->bound_words(over->soup, first / 64, 0, 64, node);
        return;
    }
    if (over->are_doubles)
        find_origin(&over->mesh, first, count, node->origin);
    bound_mesh(over, kernel, first, count, node);
}

void tribox_indexed_bound_nodes(const tribox_indexed *over, const tribox_kernel *kernel, const void *nodes, size_t count,
                                tribox_node *node)
{
    kernel->nodes->bound_nodes(nodes, count, node);
    if (over->are_doubles)
        tribox_bounds_join(nodes, count, node);
}
