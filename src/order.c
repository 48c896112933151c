/*
 * order.c - an order of triangles or boxes in which those that are near in number are near in space.
 *
 * Their places are cut in two across their longest side, and so are the parts, down to 64. Which place lies on which side follows
 * from the places alone: so the order depends neither on how a cut is found nor on the processor.
 */
#include "dispatch.h"
#include "environment.h"
#include "mesh_input.h"
#include "places.h"
#include "soup.h"

/* Whether `count` triangles can be ordered: their numbers have 32 bits, and scratch fits the address space. */
static bool is_orderable(size_t count, const uint32_t *order, const void *scratch)
{
    return !count || (order && scratch && (uint64_t)count <= UINT64_C(1) << 32 && count <= PTRDIFF_MAX / TRIBOX_PLACE_BYTES);
}

/* All cuts of a range. Of the two parts of a cut, the second is the lesser: the depth is at most 36. */
static void cut_all(const tribox_places *places, size_t first, size_t count)
{
    for (size_t before; (before = tribox_places_before_cut(count)) != 0; first += before, count -= before) {
        tribox_places_cut(places, first, count);
        cut_all(places, first, before);
    }
    tribox_places_sort_word(places, first, count);
}

static void write_order(const tribox_places *places, uint32_t *order)
{
    cut_all(places, 0, places->count);
    if (places->count)
        memcpy(order, tribox_places_at(places, 3, 0), places->count * sizeof *order);
}

tribox_status tribox_soup_order(const tribox_soup *soup, uint32_t *order, void *scratch)
{
    if (!tribox_soup_is_readable(soup) || !is_orderable(soup->count, order, scratch))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_places places = {scratch, soup->count};
    const tribox_environment callers = tribox_environment_enter();
    tribox_places_of_soup(&places, soup, 0, soup->count);
    write_order(&places, order);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

static bool has_streams(const tribox_boxes *boxes)
{
    bool has = true;
    for (int a = 0; a < 3; a++)
        has &= boxes->lo[a] && boxes->hi[a];
    return has;
}

tribox_status tribox_boxes_order(const tribox_boxes *boxes, uint32_t *order, void *scratch)
{
    if (!boxes || !is_orderable(boxes->count, order, scratch) || (boxes->count && !has_streams(boxes)))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_places places = {scratch, boxes->count};
    const tribox_environment callers = tribox_environment_enter();
    tribox_places_of_boxes(&places, boxes, 0, boxes->count);
    write_order(&places, order);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

tribox_status tribox_mesh_order(const tribox_mesh *mesh, uint32_t *order, void *scratch)
{
    if (!tribox_mesh_is_readable(mesh) || !is_orderable(mesh->count, order, scratch))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_kernel *const kernel = tribox_kernel_find(NULL);
    const tribox_mesh strided = tribox_mesh_with_stride(mesh);
    const tribox_places places = {scratch, mesh->count};
    if (!tribox_mesh_is_in_range(&strided, kernel, 0, mesh->count))
        return TRIBOX_BAD_INDEX;
    const tribox_environment callers = tribox_environment_enter();
    tribox_places_of_mesh(&places, &strided, kernel, 0, mesh->count);
    write_order(&places, order);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}
