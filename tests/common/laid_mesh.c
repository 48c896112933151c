#include "laid_mesh.h"

#include <stdio.h>
#include <string.h>

static const unsigned index_sizes[] = {0, 2, 4};
static const unsigned axes_orders[] = {0, 123, 132, 213, 231, 312, 321};

mesh_form mesh_form_draw(random_source *r, bool may_be_floats)
{
    static const unsigned narrow[] = {0, 4};
    const bool is_plain = random_int(r, 3) == 0;
    mesh_form form = {.position_bytes = may_be_floats && random_int(r, 2) ? narrow[random_int(r, 2)] : 8,
                      .index_bytes = index_sizes[random_int(r, 3)],
                      .axes = random_int(r, 3) ? 0 : axes_orders[random_int(r, 7)],
                      .is_at_end = random_int(r, 2),
                      .is_shared = random_int(r, 2)};
    if (is_plain)
        return form;
    form.order = (vertex_order)random_int(r, VERTEX_ORDERS);
    form.gap = random_int(r, 2) ? (size_t)random_int_between(r, 1, 40) : 8 * (size_t)random_int(r, 3);
    form.shift = random_int(r, 2) ? 0 : random_int_between(r, 1, 7);
    return form;
}

static guarded fence_of_noise(random_source *r, size_t bytes)
{
    const guarded g = guarded_make(bytes);
    for (size_t k = 0; k < g.size; k += sizeof(uint64_t)) {
        const uint64_t noise = random_bits(r);
        memcpy(g.first + k, &noise, sizeof noise);
    }
    return g;
}

laid_fences laid_fences_for(uint64_t seed, size_t triangles, size_t bytes)
{
    random_source r = random_named(seed, "laid fences");
    laid_fences f = {.positions = fence_of_noise(&r, bytes)};
    f.indices = fence_of_noise(&r, 3 * triangles * sizeof(uint32_t) + 8);
    return f;
}

laid_fences laid_fences_make(uint64_t seed) { return laid_fences_for(seed, LAID_MOST, LAID_BYTES); }

/* Strides by the order; the greatest fits LAID_MOST triangles into the fence only where there are no gaps. */
static void put_strides(random_source *r, const mesh_form *form, tribox_mesh *mesh)
{
    const size_t bytes = mesh_number_bytes(mesh);
    if (form->order == ROWS) {
        mesh->axis_stride = random_int(r, 2) ? 0 : bytes;
        mesh->stride = form->gap || random_int(r, 2) ? 3 * bytes + form->gap : 0;
    } else if (form->order == SPREAD_ROWS) {
        mesh->axis_stride = bytes + form->gap;
        mesh->stride = 2 * mesh->axis_stride + bytes + (random_int(r, 2) ? 0 : form->gap);
    } else {
        const size_t stride = bytes + (random_int(r, 2) ? 0 : form->gap);
        mesh->stride = stride == bytes && random_int(r, 2) ? 0 : stride;
        mesh->axis_stride = (mesh->vertices ? mesh->vertices : 1) * stride + form->gap;
    }
}

static unsigned char *place(guarded g, size_t bytes, const mesh_form *form)
{
    return form->is_at_end ? (unsigned char *)guarded_tail(g, bytes) - form->shift : g.first + form->shift;
}

static size_t draw_vertices(random_source *r, const mesh_form *form, size_t count)
{
    const size_t corners = 3 * count;
    return !form->index_bytes || form->pattern == PATTERN_EACH ? corners + random_below(r, 3)
           : form->pattern == PATTERN_SHARED                   ? count / 2 + 2
           : form->pattern == PATTERN_NEVER_LAST               ? corners + 2
           : form->pattern == PATTERN_ONE                      ? 1 + random_below(r, 3)
                                                               : corners;
}

static size_t draw_index(random_source *r, index_pattern pattern, size_t corner, size_t corners, size_t vertices)
{
    switch (pattern) {
    case PATTERN_EACH:
    case PATTERN_ORDER:
        return corner;
    case PATTERN_REVERSED:
        return corners - 1 - corner;
    case PATTERN_NEVER_LAST:
    case PATTERN_LAST_ONCE:
        return random_below(r, vertices - 1);
    case PATTERN_LAST_ALWAYS:
        return corner % 3 == corner / 3 % 3 ? vertices - 1 : random_below(r, vertices);
    case PATTERN_ONE:
        return corners % vertices;
    case PATTERN_NEAR:
        return (corner + random_below(r, 20)) % vertices;
    default:
        return random_below(r, vertices);
    }
}

static void lay_indices(random_source *r, const mesh_form *form, tribox_mesh *mesh, laid_fences f)
{
    const size_t corners = 3 * mesh->count;
    mesh->indices = place(f.indices, corners * form->index_bytes, form);
    mesh->index_bytes = form->index_bytes;
    for (size_t k = 0; k < corners; k++)
        mesh_set_index(mesh, k, draw_index(r, form->pattern, k, corners, mesh->vertices));
    if (corners && form->pattern == PATTERN_LAST_ONCE)
        mesh_set_index(mesh, random_below(r, corners), mesh->vertices - 1);
    for (size_t k = 0; form->pattern == PATTERN_EACH && k + 1 < corners; k++) {
        const size_t other = k + random_below(r, corners - k), swapped = mesh_index(mesh, k);
        mesh_set_index(mesh, k, mesh_index(mesh, other));
        mesh_set_index(mesh, other, swapped);
    }
}

/* Corners whose vertices are the same, bit for bit, get one number: that of the first. Looks at near ones alone. */
static void share_vertices(const tribox_mesh *mesh)
{
    for (size_t k = 1; k < 3 * mesh->count; k++)
        for (size_t back = 1; back <= 8 && back <= k; back++) {
            bool is_same = true;
            for (int a = 0; a < 3; a++)
                is_same = is_same && !memcmp(mesh_address(mesh, mesh_index(mesh, k), a),
                                             mesh_address(mesh, mesh_index(mesh, k - back), a), mesh_number_bytes(mesh));
            if (is_same) {
                mesh_set_index(mesh, k, mesh_index(mesh, k - back));
                break;
            }
        }
}

tribox_mesh laid_mesh_of(random_source *r, const mesh_form *form, const double (*u)[3][3], size_t count, const int turn[3],
                         laid_fences f)
{
    const bool is_each = !form->index_bytes || form->pattern == PATTERN_EACH;
    const size_t vertices = count ? draw_vertices(r, form, count) : 0;
    tribox_mesh mesh = {.vertices = vertices, .count = count, .position_bytes = form->position_bytes, .axes = form->axes};
    put_strides(r, form, &mesh);
    if (form->index_bytes)
        lay_indices(r, form, &mesh, f);
    mesh.positions = place(f.positions, mesh_bytes(&mesh), form);
    for (size_t k = 0; k < (is_each ? 3 * count : vertices); k++)
        for (int a = 0; a < 3; a++)
            mesh_put(&mesh, is_each ? mesh_index(&mesh, k) : k, a, u[k / 3 % count][turn[k % 3]][a]);
    if (form->index_bytes && form->is_shared && is_each)
        share_vertices(&mesh);
    return mesh;
}

const char *laid_mesh_text(const tribox_mesh *mesh, char text[LAID_TEXT])
{
    snprintf(text, LAID_TEXT, "%zu triangles of %u-byte numbers, stride %zu, axis stride %zu, axes %u, indices of %u bytes",
             mesh->count, mesh->position_bytes, mesh->stride, mesh->axis_stride, mesh->axes, mesh->indices ? mesh->index_bytes : 0);
    return text;
}
