/* mesh.c - triangles by index, or nine floats each: gathered into streams, block by block. */
#include "box.h"
#include "dispatch.h"
#include "environment.h"
#include "few.h"
#include "pairs.h"
#include "soup.h"

/* Triangles whose streams fit the first-level cache. */
enum { BLOCK = 256 };

/* Whether `count` items of `bytes` bytes each fit the address space. */
static bool fits(size_t count, size_t bytes) { return count <= PTRDIFF_MAX / bytes; }

static bool is_readable(const tribox_mesh *mesh)
{
    if (!mesh || (mesh->stride && mesh->stride < 12) || !fits(mesh->vertices, mesh->stride ? mesh->stride : 12))
        return false;
    if (mesh->indices && mesh->index_bytes != 2 && mesh->index_bytes != 4)
        return false;
    return fits(mesh->count, 3 * sizeof(float)) && (mesh->positions || !mesh->count);
}

/* The same mesh, its stride set. */
static tribox_mesh with_stride(const tribox_mesh *mesh)
{
    tribox_mesh strided = *mesh;
    strided.stride = mesh->stride ? mesh->stride : 12;
    return strided;
}

static bool is_in_range(const tribox_mesh *mesh, const tribox_kernel *kernel, size_t first, size_t count)
{
    return !count || kernel->greatest_vertex(mesh, first, count) < mesh->vertices;
}

tribox_status tribox_mesh_to_streams(const tribox_mesh *mesh, size_t first, size_t count, const tribox_options *options,
                                     float *const x[3], float *const y[3], float *const z[3])
{
    if (!is_readable(mesh) || first > mesh->count || count > mesh->count - first || !x || !y || !z)
        return TRIBOX_BAD_ARGUMENT;
    float *const to[9] = {x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]};
    for (int k = 0; count && k < 9; k++)
        if (!to[k])
            return TRIBOX_BAD_ARGUMENT;
    const tribox_kernel *const kernel = tribox_kernel_find(options ? options->kernel : NULL);
    if (!kernel)
        return TRIBOX_NO_KERNEL;
    const tribox_mesh strided = with_stride(mesh);
    if (!is_in_range(&strided, kernel, first, count))
        return TRIBOX_BAD_INDEX;
    kernel->gather(&strided, first, count, to);
    return TRIBOX_OK;
}

/* Triangles first .. first + count - 1, of which there are at most BLOCK. */
static tribox_report answer_mesh_block(const tribox_mesh *mesh, size_t first, size_t count, const tribox_box *box,
                                       tribox_plan *plan, uint64_t *mask)
{
    _Alignas(64) float streams[9][BLOCK]; /* no packet in two lines of the cache */
    float *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    plan->kernel->gather(mesh, first, count, to);
    tribox_few few;
    const tribox_soup soup = tribox_soup_of(&streams[0][0], BLOCK, count), *const packets =
                                                                               tribox_few_triangles(&soup, plan->kernel, &few);
    return tribox_pairs_answer(&(tribox_pairs){.soup = packets, .box = box, .count = count}, plan, mask);
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

static tribox_report answer_mesh(const tribox_mesh *mesh, const tribox_box *box, tribox_plan *plan, uint64_t *mask)
{
    const bool is_box_asked = plan->axes & TRIBOX_AXES_BOX;
    const tribox_box_pattern pattern = box_pattern_of(box);
    tribox_report counts = {0, 0};
    for (size_t first = 0, count; first < mesh->count; first += count) {
        const size_t left = mesh->count - first;
        count = left < 64 ? left : 64;
        if (is_box_asked && plan->kernel->is_beside(mesh, &pattern, first, count)) {
            if (mask)
                mask[first / 64] = 0;
            continue;
        }
        /* Near in the mesh is near in space: the next words, up to a block, are likely not beside the box either. */
        count = left < BLOCK ? left : BLOCK;
        const tribox_report report = answer_mesh_block(mesh, first, count, box, plan, mask ? mask + first / 64 : NULL);
        counts.overlapping += report.overlapping;
        counts.undecided += report.undecided;
    }
    return counts;
}

tribox_status tribox_overlap_indexed(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                                     tribox_report *report)
{
    if (!box || !is_readable(mesh))
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_box_is_finite(box))
        return TRIBOX_BAD_BOX;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;
    const tribox_mesh strided = with_stride(mesh);
    if (!is_in_range(&strided, plan.kernel, 0, mesh->count))
        return TRIBOX_BAD_INDEX;

    tribox_report counts = {0, 0};
    const tribox_environment callers = tribox_environment_enter();
    if (tribox_box_is_empty(box))
        tribox_pairs_write_none(mesh->count, mask);
    else
        counts = answer_mesh(&strided, box, &plan, mask);
    tribox_environment_leave(callers);
    tribox_plan_report(&plan, counts, report);
    return TRIBOX_OK;
}

/* How many corners of triangles at .. at + count - 1 have no vertex; *first becomes the first of them, if it is none yet. */
static size_t count_bad(const tribox_mesh *mesh, size_t at, size_t count, size_t none, size_t *first)
{
    const unsigned bytes = tribox_index_bytes(mesh);
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
    const size_t triangles = is_readable(mesh) ? mesh->count : 0, corners = 3 * triangles;
    size_t found = 0, lowest = corners;
    if (corners && !mesh->indices) {
        found = corners > mesh->vertices ? corners - mesh->vertices : 0;
        lowest = corners - found;
    }
    for (size_t at = 0; mesh && mesh->indices && at < triangles; at += 64) {
        const size_t count = triangles - at < 64 ? triangles - at : 64;
        if (!is_in_range(mesh, kernel, at, count))
            found += count_bad(mesh, at, count, corners, &lowest);
    }
    if (first)
        *first = lowest;
    return found;
}
