/*
 * order.c - an order of triangles or boxes in which those that are near in number are near in space.
 *
 * Their places are cut in two across their longest side, and so are the parts, down to the 64 of a word. Which place comes before a
 * cut follows from the places alone, and how they are moved there too: so neither the processor nor the kernel changes the order.
 */
#include "sort_keys.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/box.h"
#include "dispatch.h"
#include "base/environment.h"
#include "base/finite.h"
#include "mesh/mesh_input.h"
#include "mesh/positions.h"
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
    tribox_kernel_any()->nodes->find_middles(soup, NULL, first, count, first, &keys);
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
    tribox_kernel_any()->nodes->find_middles(NULL, boxes, first, count, first, &keys);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

/*
 * Doubles are seen from among them, as far from zero floats would see them all in one place; and by a power of two larger or
 * smaller where they would see nothing.
 */
typedef struct sight {
    double origin[3], scale;
} sight;

/* Positions that tell where a mesh is: the first vertex of triangles from all over it, whichever part of them is asked about. */
enum { WITNESSES = 64 };
typedef struct witnesses {
    double position[3][WITNESSES];
    size_t count;
} witnesses;

static void find_witnesses(const tribox_mesh *mesh, witnesses *found)
{
    const unsigned bytes = tribox_vertex_bytes(mesh);
    const uint64_t total = mesh->count, most = total < WITNESSES ? total : WITNESSES;
    found->count = 0;
    for (uint64_t k = 0; k < most; k++) {
        const uint64_t within = k * UINT64_C(0x9e3779b97f4a7c15) % total; /* of no period that a mesh might have */
        const size_t vertex = tribox_vertex_number(mesh, bytes, 3 * (size_t)((k * total + within) / most));
        double u[3] = {INFINITY, 0, 0};
        if (vertex < mesh->vertices)
            tribox_position_read(mesh, vertex, u);
        if (!tribox_are_finite_doubles(u, 3))
            continue;
        for (int a = 0; a < 3; a++)
            found->position[a][found->count] = u[a];
        found->count++;
    }
}

/* The one half way among numbers, one at least, which are put in order. */
static double median_number(double *number, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        const double moved = number[i];
        size_t k = i;
        for (; k > 0 && moved < number[k - 1]; k--)
            number[k] = number[k - 1];
        number[k] = moved;
    }
    return number[count / 2];
}

static double greater_of(double a, double b) { return a > b ? a : b; }

/* Medians, which no few witnesses far away can move: where the mesh is on each axis, and how far from there. */
static sight find_sight(const tribox_mesh *mesh)
{
    sight s = {.scale = 1};
    witnesses seen;
    double distance[WITNESSES] = {0}, sorted[WITNESSES];
    find_witnesses(mesh, &seen);
    for (int a = 0; seen.count && a < 3; a++) {
        memcpy(sorted, seen.position[a], sizeof sorted);
        s.origin[a] = median_number(sorted, seen.count);
        for (size_t k = 0; k < seen.count; k++)
            distance[k] = greater_of(distance[k], fabs(seen.position[a][k] - s.origin[a])); /* infinite if that overflows */
    }
    const double usual = seen.count ? median_number(distance, seen.count) : 0;
    while (usual * s.scale > 0x1p64 && s.scale > 0x1p-960)
        s.scale *= 0x1p-64;
    while (usual > 0 && usual * s.scale < 0x1p-64 && s.scale < 0x1p960)
        s.scale *= 0x1p64;
    return s;
}

/* A number as it is seen: one that is beyond the greatest float lies there, one that is not finite stays so. */
static float number_seen(double number, double origin, double scale)
{
    const float seen = (float)((number - origin) * scale);
    if (!tribox_are_finite_doubles(&number, 1))
        return NAN;
    return seen > FLT_MAX ? FLT_MAX : seen < -FLT_MAX ? -FLT_MAX : seen;
}

static void write_seen(const tribox_mesh *mesh, const sight *s, size_t first, size_t count, float *const to[9])
{
    for (size_t i = 0; i < count; i++) {
        double u[3][3];
        tribox_mesh_read_corners(mesh, 3 * (first + i), 3, u);
        for (int k = 0; k < 9; k++)
            to[k][i] = number_seen(u[k % 3][k / 3], s->origin[k / 3], s->scale);
    }
}

static bool are_all_finite(const tribox_sort_keys *keys, size_t count)
{
    bool are = true;
    for (size_t i = 0; i < count; i++)
        are &= keys->middle[0][i] <= FLT_MAX;
    return are;
}

/* By way of streams, block by block. The kernel writes doubles as they are seen but for a scale, and for what is beyond float. */
static void find_middles_of_mesh(const tribox_mesh *mesh, const tribox_kernel *kernel, size_t first, size_t end, void *scratch)
{
    const bool are_doubles = tribox_position_bytes(mesh) == sizeof(double);
    const sight s = are_doubles ? find_sight(mesh) : (sight){.scale = 1};
    float streams[9][BLOCK], *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    for (; first < end; first += BLOCK) {
        const size_t count = end - first < BLOCK ? end - first : BLOCK;
        const tribox_soup soup = tribox_soup_of(&streams[0][0], BLOCK, count);
        const tribox_sort_keys keys = tribox_sort_keys_in(scratch, mesh->count, first);
        tribox_mesh_write_soup(mesh, kernel, are_doubles ? s.origin : NULL, NULL, first, count, to);
        kernel->nodes->find_middles(&soup, NULL, 0, count, first, &keys);
        if (are_doubles && (s.scale != 1 || !are_all_finite(&keys, count))) {
            write_seen(mesh, &s, first, count, to);
            kernel->nodes->find_middles(&soup, NULL, 0, count, first, &keys);
        }
    }
}

static tribox_status start_mesh(const tribox_mesh *mesh, size_t first, size_t count, void *scratch)
{
    tribox_mesh strided;
    if (!tribox_mesh_take(mesh, &strided) || !is_range(mesh->count, first, count, scratch))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_kernel *const kernel = tribox_kernel_any();
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
    tribox_kernel_any()->nodes->cut(&keys, count, *before);
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
    tribox_sort_keys_finish(tribox_kernel_any(), scratch, total, first, count, order);
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
