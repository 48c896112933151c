/*
 * order.c - an order of triangles or boxes in which those that are near in number are near in space.
 *
 * Their places are cut in two across their longest side, and so are the parts, down to the 64 of a word. Which place comes before a
 * cut follows from the places alone, and how they are moved there too: so neither the processor nor the kernel changes the order.
 */
#include "sort_keys.h"

#include <float.h>
#include <string.h>

#include "base/box.h"
#include "dispatch.h"
#include "base/environment.h"
#include "base/finite.h"
#include "mesh/mesh_input.h"
#include "mesh/mesh_streams.h"
#include "base/soup.h"
#include "tribox_threads.h"

/* Triangles of a mesh whose streams fit the first-level cache. */
enum { BLOCK = 256 };

/* Whether these of `total` triangles can be ordered: their numbers have 32 bits, and scratch fits the address space. */
static bool is_range(size_t total, size_t first, size_t count, const void *scratch)
{
    return total <= PTRDIFF_MAX / TRIBOX_PLACE_BYTES && tribox_has_numbers(total) && first <= total && count <= total - first &&
           (scratch || !count);
}

static tribox_status start_soup(const tribox_soup *soup, size_t first, size_t count, void *scratch)
{
    if (!tribox_soup_is_readable(soup) || !is_range(soup->count, first, count, scratch))
        return TRIBOX_BAD_ARGUMENT;
    if (!count)
        return TRIBOX_OK;
    const tribox_sort_keys keys = tribox_sort_keys_in(scratch, soup->count, first);
    const tribox_environment callers = tribox_environment_enter();
    tribox_kernel_find(NULL)->nodes->find_middles(soup, NULL, first, count, first, &keys);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

static tribox_status start_boxes(const tribox_boxes *boxes, size_t first, size_t count, void *scratch)
{
    if (!tribox_boxes_are_readable(boxes) || !is_range(boxes->count, first, count, scratch))
        return TRIBOX_BAD_ARGUMENT;
    if (!count)
        return TRIBOX_OK;
    const tribox_sort_keys keys = tribox_sort_keys_in(scratch, boxes->count, first);
    const tribox_environment callers = tribox_environment_enter();
    tribox_kernel_find(NULL)->nodes->find_middles(NULL, boxes, first, count, first, &keys);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

/* Doubles are seen from the first vertex, as far from zero floats would see them all in one place. False if they need not be. */
static bool is_far_from_zero(const tribox_mesh *mesh, double origin[3])
{
    if (tribox_position_bytes(mesh) != sizeof(double) || !mesh->count)
        return false;
    tribox_position_read(mesh, 0, origin);
    return tribox_are_finite_doubles(origin, 3);
}

/* By way of streams, block by block. */
static void find_middles_of_mesh(const tribox_mesh *mesh, const tribox_kernel *kernel, size_t first, size_t end, void *scratch)
{
    double origin[3];
    float streams[9][BLOCK], *to[9];
    const bool is_local = is_far_from_zero(mesh, origin);
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    for (; first < end; first += BLOCK) {
        const size_t count = end - first < BLOCK ? end - first : BLOCK;
        const tribox_soup soup = tribox_soup_of(&streams[0][0], BLOCK, count);
        const tribox_sort_keys keys = tribox_sort_keys_in(scratch, mesh->count, first);
        tribox_mesh_write_soup(mesh, kernel, is_local ? origin : NULL, first, count, to);
        kernel->nodes->find_middles(&soup, NULL, 0, count, first, &keys);
    }
}

static tribox_status start_mesh(const tribox_mesh *mesh, size_t first, size_t count, void *scratch)
{
    tribox_mesh strided;
    if (!tribox_mesh_take(mesh, &strided) || !is_range(mesh->count, first, count, scratch))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_kernel *const kernel = tribox_kernel_find(NULL);
    if (!tribox_mesh_is_in_range(&strided, kernel, first, count))
        return TRIBOX_BAD_VERTEX;
    const tribox_environment callers = tribox_environment_enter();
    find_middles_of_mesh(&strided, kernel, first, first + count, scratch);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

tribox_status tribox_sort_cut(void *scratch, size_t total, size_t first, size_t count, size_t *before)
{
    if (!before || !is_range(total, first, count, scratch))
        return TRIBOX_BAD_ARGUMENT;
    *before = tribox_keys_before_cut(count);
    if (!*before)
        return TRIBOX_OK;
    const tribox_sort_keys keys = tribox_sort_keys_in(scratch, total, first);
    const tribox_environment callers = tribox_environment_enter();
    tribox_kernel_find(NULL)->nodes->cut(&keys, count, *before);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

/* The numbers of a word as they are, but those that are not finite last. */
static void write_word(const tribox_sort_keys *keys, size_t count, uint32_t *order)
{
    size_t finite = 0, wild = 0;
    for (size_t i = 0; i < count; i++)
        finite += keys->middle[0][i] <= FLT_MAX;
    memcpy(order, keys->number, count * sizeof *order);
    for (size_t i = 0, at = 0; finite < count && i < count; i++)
        order[keys->middle[0][i] <= FLT_MAX ? at++ : finite + wild++] = keys->number[i];
}

void tribox_sort_keys_finish(const tribox_kernel *kernel, void *scratch, size_t total, size_t first, size_t count, uint32_t *order)
{
    for (size_t before; (before = tribox_keys_before_cut(count)) != 0; first += before, count -= before) {
        const tribox_sort_keys keys = tribox_sort_keys_in(scratch, total, first);
        kernel->nodes->cut(&keys, count, before);
        tribox_sort_keys_finish(kernel, scratch, total, first, before, order);
    }
    const tribox_sort_keys word = tribox_sort_keys_in(scratch, total, first);
    write_word(&word, count, order + first);
}

static tribox_status finish_order(void *scratch, size_t total, size_t first, size_t count, uint32_t *order)
{
    if (!is_range(total, first, count, scratch) || (count && !order))
        return TRIBOX_BAD_ARGUMENT;
    if (!count)
        return TRIBOX_OK;
    const tribox_environment callers = tribox_environment_enter();
    tribox_sort_keys_finish(tribox_kernel_find(NULL), scratch, total, first, count, order);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

tribox_status tribox_soup_sort_start(const tribox_soup *soup, size_t first, size_t count, void *scratch)
{
    return start_soup(soup, first, count, scratch);
}

tribox_status tribox_boxes_sort_start(const tribox_boxes *boxes, size_t first, size_t count, void *scratch)
{
    return start_boxes(boxes, first, count, scratch);
}

tribox_status tribox_mesh_sort_start(const tribox_mesh *mesh, size_t first, size_t count, void *scratch)
{
    return start_mesh(mesh, first, count, scratch);
}

tribox_status tribox_sort_finish(void *scratch, size_t total, size_t first, size_t count, uint32_t *order)
{
    return finish_order(scratch, total, first, count, order);
}

tribox_status tribox_soup_sort(const tribox_soup *soup, uint32_t *order, void *scratch)
{
    if (!soup || (soup->count && !order))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = start_soup(soup, 0, soup->count, scratch);
    return status ? status : finish_order(scratch, soup->count, 0, soup->count, order);
}

tribox_status tribox_boxes_sort(const tribox_boxes *boxes, uint32_t *order, void *scratch)
{
    if (!boxes || (boxes->count && !order))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = start_boxes(boxes, 0, boxes->count, scratch);
    return status ? status : finish_order(scratch, boxes->count, 0, boxes->count, order);
}

tribox_status tribox_mesh_sort(const tribox_mesh *mesh, uint32_t *order, void *scratch)
{
    if (!mesh || (mesh->count && !order))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = start_mesh(mesh, 0, mesh->count, scratch);
    return status ? status : finish_order(scratch, mesh->count, 0, mesh->count, order);
}
