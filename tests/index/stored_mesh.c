#include "stored_mesh.h"

#include "common/harness.h"

#include <float.h>
#include <math.h>

#include "common/guarded_pages.h"

enum { PADDING = 1 /* numbers between two vertices */, MORE = 3 /* vertices that no triangle has */ };

stored_mesh stored_mesh_make(size_t room)
{
    const size_t vertices = 3 * room + MORE;
    stored_mesh m = {.positions_fence = guarded_make(vertices * (3 + PADDING) * sizeof(double)),
                     .indices_fence = guarded_make(3 * room * sizeof(uint32_t)),
                     .vertex = malloc(3 * room * sizeof(uint32_t) + 1)};
    assert_non_null(m.vertex);
    return m;
}

/* Near, as maps have it, at the end of what float and double can tell, and so small and large that float ends before. */
static const mesh_place places[] = {
    {1, {0, 0, 0}},
    {1, {500000.125, 5123456.7, 123.4}},
    {0x1p-10, {0x1p40, -0x1p40, 0x1p45}},
    {1, {0x1p70, 0x1p60, 0}},
    {0x1p-160, {0, 0, 0}},
    {0x1p-900, {0, 0x1p-901, 0}},
    {0x1p120, {0, 0, 0}},
    {0x1p880, {0, 0, 0}},
    {1 / 3.0, {0.1, 0, 1e9}},
};

mesh_layout draw_layout(random_source *r, size_t triangles)
{
    const size_t vertices = 3 * triangles + MORE;
    static const unsigned bytes[] = {0, 2, 4};
    mesh_layout layout = {.position_bytes = random_int(r, 3) ? 8 : 4,
                          .index_bytes = bytes[random_int(r, 3)],
                          .is_padded = random_int(r, 2),
                          .is_columns = !random_int(r, 4),
                          .place = places[0]};
    if (layout.index_bytes == 2 && vertices > 65536)
        layout.index_bytes = 4;
    if (layout.position_bytes == 8)
        layout.place = places[random_int(r, sizeof places / sizeof places[0])];
    return layout;
}

static void write_number(char *to, unsigned bytes, double number)
{
    const float single = (float)number;
    memcpy(to, bytes == 8 ? (const void *)&number : (const void *)&single, bytes);
}

static double placed(const mesh_place *place, int axis, float number)
{
    return (double)number * place->scale + place->offset[axis];
}

/* NaN in the vertices that no triangle has, and between vertices. */
static void clear_positions(stored_mesh *m, size_t bytes)
{
    char *const from = (char *)(uintptr_t)m->mesh.positions;
    for (size_t at = 0; at + m->layout.position_bytes <= bytes; at += m->layout.position_bytes)
        write_number(from + at, m->layout.position_bytes, NAN);
}

void stored_mesh_write(stored_mesh *m, const stored_soup *s, size_t first, size_t count)
{
    char *const from = (char *)(uintptr_t)m->mesh.positions;
    for (size_t i = first; i < first + count; i++)
        for (size_t k = 0; k < 9; k++) {
            const size_t vertex = m->vertex[3 * i + k % 3], axis = k / 3;
            write_number(from + vertex * m->mesh.stride + (m->mesh.axes ? 2 - axis : axis) * m->mesh.axis_stride,
                         m->layout.position_bytes, placed(&m->layout.place, (int)axis, s->stream[k][i]));
        }
}

void stored_mesh_name(stored_mesh *m, size_t corner, uint32_t vertex)
{
    const uint16_t narrow = (uint16_t)vertex;
    char *const to = (char *)(uintptr_t)m->mesh.indices + m->layout.index_bytes * corner;
    memcpy(to, m->layout.index_bytes == 2 ? (const void *)&narrow : (const void *)&vertex, m->layout.index_bytes);
}

/* Any corner has any vertex. Without vertex numbers there are no others. */
static void choose_vertices(random_source *r, stored_mesh *m, size_t corners)
{
    for (size_t k = 0; k < corners; k++)
        m->vertex[k] = (uint32_t)k;
    if (!m->layout.index_bytes)
        return;
    for (size_t k = 0; k < corners; k++) {
        const size_t other = k + random_below(r, corners - k);
        const uint32_t kept = m->vertex[k];
        m->vertex[k] = m->vertex[other];
        m->vertex[other] = kept;
    }
    for (size_t k = 0; k < corners; k++)
        stored_mesh_name(m, k, m->vertex[k]);
}

void stored_mesh_lay(random_source *r, stored_mesh *m, const mesh_layout *layout, stored_soup *s)
{
    const size_t count = s->soup.count, vertices = 3 * count + (layout->index_bytes ? (size_t)random_int(r, MORE + 1) : 0);
    const size_t padded = layout->is_padded ? PADDING : 0, number = layout->position_bytes;
    m->layout = *layout;
    m->mesh = (tribox_mesh){.vertices = vertices,
                            .index_bytes = layout->index_bytes,
                            .count = count,
                            .position_bytes = layout->position_bytes,
                            .axes = random_int(r, 4) ? 0 : 321,
                            .stride = (layout->is_columns ? 1 : 3 + padded) * number,
                            .axis_stride = (layout->is_columns ? vertices + padded : 1) * number};
    const size_t bytes = vertices == 0        ? 0
                         : layout->is_columns ? (2 * (vertices + padded) + vertices) * number
                                              : ((vertices - 1) * (3 + padded) + 3) * number;
    m->mesh.positions = guarded_tail(m->positions_fence, bytes);
    m->mesh.indices = layout->index_bytes ? guarded_tail(m->indices_fence, 3 * count * layout->index_bytes) : NULL;
    clear_positions(m, bytes);
    choose_vertices(r, m, 3 * count);
    stored_mesh_write(m, s, 0, count);
    s->index.soup = s->with_ids.soup = NULL;
    s->index.mesh = s->with_ids.mesh = &m->mesh;
}

void stored_mesh_hide(const stored_mesh *m, bool is_hidden)
{
    const guarded fences[] = {m->positions_fence, m->indices_fence};
    for (int k = 0; k < 2; k++)
        assert_true(!fences[k].size || pages_allow(fences[k].first, fences[k].size, is_hidden ? PAGES_HIDDEN : PAGES_OPEN));
}

tribox_box box_in_place(random_source *r, const mesh_layout *layout, const tribox_box *box)
{
    tribox_box moved = *box;
    for (int k = 0; k < 6; k++) {
        double *const bound = k < 3 ? &moved.lo[k] : &moved.hi[k - 3];
        const int way = random_int(r, 6);
        *bound = *bound * layout->place.scale + layout->place.offset[k % 3];
        *bound = way == 0 ? nextafter(*bound, DBL_MAX) : way == 1 ? nextafter(*bound, -DBL_MAX) : *bound;
    }
    return moved;
}
