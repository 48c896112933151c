/* mesh.c - triangles by index, or nine floats each, as they lie in memory: block by block to the kernels, or into streams. */
#include <string.h>

#include "box.h"
#include "dispatch.h"
#include "environment.h"
#include "few.h"
#include "mesh_input.h"
#include "pairs.h"
#include "soup.h"

/* Triangles whose streams fit the first-level cache; those of a block whose corners do, at first and at most. */
enum { STREAMED = 256, BLOCK_LEAST = 256, BLOCK_MOST = 1024 };

/* Words of answers that are kept, of 131072 triangles; vertices that are copied. */
enum { KEPT_WORDS = 2048, COPIED = 1024 };

/* Whether `count` items of `bytes` bytes each fit the address space. */
static bool fits(size_t count, size_t bytes) { return count <= PTRDIFF_MAX / bytes; }

bool tribox_mesh_is_readable(const tribox_mesh *mesh)
{
    if (!mesh || (mesh->stride && mesh->stride < 12) || !fits(mesh->vertices, mesh->stride ? mesh->stride : 12))
        return false;
    if (mesh->indices && mesh->index_bytes != 2 && mesh->index_bytes != 4)
        return false;
    return fits(mesh->count, 3 * sizeof(float)) && (mesh->positions || !mesh->count);
}

tribox_mesh tribox_mesh_with_stride(const tribox_mesh *mesh)
{
    tribox_mesh strided = *mesh;
    strided.stride = mesh->stride ? mesh->stride : 12;
    return strided;
}

bool tribox_mesh_is_in_range(const tribox_mesh *mesh, const tribox_kernel *kernel, size_t first, size_t count)
{
    return !count || kernel->find_vertices(mesh, first, count).greatest < mesh->vertices;
}

tribox_status tribox_mesh_to_streams(const tribox_mesh *mesh, size_t first, size_t count, const tribox_options *options,
                                     float *const x[3], float *const y[3], float *const z[3])
{
    if (!tribox_mesh_is_readable(mesh) || first > mesh->count || count > mesh->count - first || !x || !y || !z)
        return TRIBOX_BAD_ARGUMENT;
    float *const to[9] = {x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]};
    for (int k = 0; count && k < 9; k++)
        if (!to[k])
            return TRIBOX_BAD_ARGUMENT;
    const tribox_kernel *const kernel = tribox_kernel_find(options ? options->kernel : NULL);
    if (!kernel)
        return TRIBOX_NO_KERNEL;
    const tribox_mesh strided = tribox_mesh_with_stride(mesh);
    if (!tribox_mesh_is_in_range(&strided, kernel, first, count))
        return TRIBOX_BAD_INDEX;
    kernel->gather(&strided, first, count, to);
    return TRIBOX_OK;
}

/* Adds what a part of a call has found. */
static void add(tribox_report *counts, tribox_report part)
{
    counts->overlapping += part.overlapping;
    counts->undecided += part.undecided;
}

/* At most STREAMED triangles, by way of streams. */
static tribox_report answer_streams(const tribox_mesh *mesh, size_t first, size_t count, const tribox_box *box, tribox_plan *plan,
                                    uint64_t *mask)
{
    _Alignas(64) float streams[9][STREAMED]; /* no packet in two lines of the cache */
    float *to[9];
    tribox_few few;
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    plan->kernel->gather(mesh, first, count, to);
    const tribox_soup soup = tribox_soup_of(&streams[0][0], STREAMED, count);
    const tribox_pairs pairs = {.soup = tribox_few_triangles(&soup, plan->kernel, &few), .box = box, .count = count};
    return tribox_pairs_answer(&pairs, plan, mask);
}

static tribox_box_pattern box_pattern_of(const tribox_box *box)
{
    tribox_box_pattern pattern;
    for (int k = 0; k < 3 * TRIBOX_LANES_MAX; k++) {
        pattern.lo[k] = box->lo[k % 3];
        pattern.hi[k] = box->hi[k % 3];
    }
    return pattern;
}

/*
 * Some of the triangles first .. first + count - 1, at most BLOCK_MOST: from where they lie to registers if all of them can be read
 * so, else the first by way of streams. Returns how many, 0 if an index names no vertex.
 */
static size_t answer_block(const tribox_mesh *mesh, size_t first, size_t count, const tribox_box *box, tribox_plan *plan,
                           uint64_t *mask, tribox_report *counts)
{
    uint32_t offset[3 * BLOCK_MOST];
    tribox_corners corners;
    const size_t streamed = count < STREAMED ? count : STREAMED;
    if (plan->kernel->find_corners(mesh, first, count, offset, &corners) >= mesh->vertices)
        return 0;
    const tribox_pairs pairs = {.corners = &corners, .box = box, .count = count};
    const bool is_direct = corners.base && corners.has_all && plan->axes == TRIBOX_AXES_ALL && count >= plan->kernel->lanes;
    add(counts, is_direct ? tribox_pairs_answer(&pairs, plan, mask) : answer_streams(mesh, first, streamed, box, plan, mask));
    return is_direct ? count : streamed;
}

/* Answers block by block, each once its indices have been checked. False if one of them names no vertex. */
static bool answer_mesh(const tribox_mesh *mesh, const tribox_box *box, tribox_plan *plan, uint64_t *mask, tribox_report *counts)
{
    const tribox_box_pattern pattern = box_pattern_of(box);
    size_t block = BLOCK_LEAST;
    for (size_t first = 0, count; first < mesh->count; first += count) {
        const size_t left = mesh->count - first;
        uint64_t *const to = mask ? mask + first / 64 : NULL;
        count = left < 64 ? left : 64;
        const tribox_vertices found = plan->kernel->find_vertices(mesh, first, count);
        if (found.greatest >= mesh->vertices)
            return false;
        if (plan->axes & TRIBOX_AXES_BOX && plan->kernel->is_beside(mesh, &pattern, found)) {
            tribox_pairs_write_none(count, to);
            block = BLOCK_LEAST;
            continue;
        }
        /* Near in the mesh is near in space: the next words, up to a block, are likely not beside the box either. */
        count = answer_block(mesh, first, left < block ? left : block, box, plan, to, counts);
        if (!count)
            return false;
        block = 2 * count < BLOCK_MOST ? 2 * count : BLOCK_MOST;
    }
    return true;
}

/* The same mesh with a vertex after its last one, which can then be read like the others. */
static tribox_mesh copied(const tribox_mesh *mesh, float position[COPIED + 1][3])
{
    for (size_t v = 0; v < mesh->vertices; v++)
        memcpy(position[v], (const char *)mesh->positions + v * mesh->stride, sizeof position[v]);
    memset(position[mesh->vertices], 0, sizeof position[mesh->vertices]);
    tribox_mesh copy = *mesh;
    copy.positions = position;
    copy.stride = sizeof position[0];
    copy.vertices++;
    return copy;
}

/*
 * The answers, but none is written if an index names no vertex. To check all of them first would read them twice, so the answers of
 * a mesh that is not too large are kept until all are there; the few vertices of a small one are copied.
 */
static bool answer_checked(const tribox_mesh *mesh, const tribox_box *box, tribox_plan *plan, uint64_t *mask, tribox_report *counts)
{
    const size_t words = tribox_mask_words(mesh->count);
    const bool is_empty = tribox_box_is_empty(box);
    const bool is_small = mesh->indices && mesh->vertices <= COPIED && mesh->vertices <= 3 * mesh->count;
    const bool is_checked_first = !mesh->indices || is_empty || is_small || (mask && words > KEPT_WORDS);
    if (is_checked_first && !tribox_mesh_is_in_range(mesh, plan->kernel, 0, mesh->count))
        return false;
    if (is_empty) {
        tribox_pairs_write_none(mesh->count, mask);
        return true;
    }
    if (is_small) {
        float position[COPIED + 1][3];
        const tribox_mesh copy = copied(mesh, position);
        return answer_mesh(&copy, box, plan, mask, counts);
    }
    if (is_checked_first || !mask)
        return answer_mesh(mesh, box, plan, mask, counts);
    uint64_t kept[KEPT_WORDS];
    if (!answer_mesh(mesh, box, plan, kept, counts))
        return false;
    memcpy(mask, kept, words * sizeof *mask);
    return true;
}

tribox_status tribox_overlap_indexed(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                                     tribox_report *report)
{
    if (!box || !tribox_mesh_is_readable(mesh))
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_box_is_finite(box))
        return TRIBOX_BAD_BOX;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;
    const tribox_mesh strided = tribox_mesh_with_stride(mesh);
    tribox_report counts = {0, 0};
    const tribox_environment callers = tribox_environment_enter();
    const bool is_answered = answer_checked(&strided, box, &plan, mask, &counts);
    tribox_environment_leave(callers);
    if (!is_answered)
        return TRIBOX_BAD_INDEX;
    tribox_plan_report(&plan, counts, report);
    return TRIBOX_OK;
}

/* How many corners of triangles at .. at + count - 1 have no vertex; *first becomes the first of them, if it is none yet. */
static size_t count_bad(const tribox_mesh *mesh, size_t at, size_t count, size_t none, size_t *first)
{
    const unsigned bytes = tribox_vertex_bytes(mesh);
    size_t found = 0;
    for (size_t corner = 3 * at; corner < 3 * (at + count); corner++)
        if (tribox_vertex_number(mesh, bytes, corner) >= mesh->vertices) {
            found++;
            *first = *first == none ? corner : *first;
        }
    return found;
}

size_t tribox_mesh_bad_indices(const tribox_mesh *mesh, size_t *first)
{
    const tribox_kernel *const kernel = tribox_kernel_find(NULL);
    const size_t triangles = tribox_mesh_is_readable(mesh) ? mesh->count : 0, corners = 3 * triangles;
    size_t found = 0, lowest = corners;
    if (corners && !mesh->indices) {
        found = corners > mesh->vertices ? corners - mesh->vertices : 0;
        lowest = corners - found;
    }
    for (size_t at = 0; mesh && mesh->indices && at < triangles; at += 64) {
        const size_t count = triangles - at < 64 ? triangles - at : 64;
        if (!tribox_mesh_is_in_range(mesh, kernel, at, count))
            found += count_bad(mesh, at, count, corners, &lowest);
    }
    if (first)
        *first = lowest;
    return found;
}
