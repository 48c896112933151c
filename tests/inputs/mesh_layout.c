#include "mesh_layout.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { VERTEX_BYTES = 3 * sizeof(float) };

static size_t stride_of(size_t stride) { return stride ? stride : VERTEX_BYTES; }

/* Random bytes once and for all: what lies between the vertices. */
static guarded fence_of_noise(random_source *r, size_t bytes)
{
    const guarded g = guarded_make(bytes);
    for (size_t k = 0; k < g.size; k += sizeof(uint64_t)) {
        const uint64_t noise = random_bits(r);
        memcpy(g.first + k, &noise, sizeof noise);
    }
    return g;
}

mesh_fences mesh_fences_make(uint64_t seed)
{
    random_source r = random_named(seed, "fences");
    mesh_fences f = {.positions = fence_of_noise(&r, LAID_BYTES)};
    f.indices = fence_of_noise(&r, 3 * sizeof(uint32_t) * LAID_TRIANGLES + sizeof(uint32_t));
    for (int s = 0; s < 9; s++)
        f.stream[s] = guarded_make(LAID_TRIANGLES * sizeof(float) + 64);
    f.mask = guarded_make(LAID_WORDS * sizeof(uint64_t) + 64);
    f.report = guarded_make(sizeof(tribox_report) + 64);
    return f;
}

static unsigned char *place(guarded g, size_t bytes, const layout *l)
{
    return l->is_at_end ? (unsigned char *)guarded_tail(g, bytes) - l->shift : g.first + l->shift;
}

/* On a lattice about the box of the tests, so that contact is common; now and then any bits at all. */
static float draw_number(random_source *r)
{
    const uint32_t bits = (uint32_t)random_bits(r);
    float any;
    memcpy(&any, &bits, sizeof any);
    return random_int(r, 100) ? 0.25f * (float)random_int_between(r, -9, 9) : any;
}

static void draw_vertex(random_source *r, unsigned char *to)
{
    const float position[3] = {draw_number(r), draw_number(r), draw_number(r)};
    memcpy(to, position, sizeof position);
}

static size_t most_vertices(const layout *l)
{
    const size_t fit = (LAID_BYTES - sizeof(float)) / stride_of(l->stride);
    return l->index_bytes == 2 && fit > 65536 ? 65536 : fit;
}

static size_t draw_vertices(random_source *r, const layout *l)
{
    const size_t corners = 3 * l->count, most = most_vertices(l);
    if (!l->index_bytes)
        return corners + (size_t)random_int(r, 3);
    size_t vertices = l->pattern == PATTERN_SHARED ? l->count / 2 + 2 : corners + (l->pattern == PATTERN_NEVER_LAST ? 2 : 0);
    if (l->pattern == PATTERN_ONE)
        vertices = 1 + (size_t)random_int(r, 3);
    return vertices < most ? vertices : most;
}

static size_t draw_below(random_source *r, size_t count) { return (size_t)random_int(r, (int)count); }

static size_t draw_index(random_source *r, index_pattern pattern, size_t corner, size_t corners, size_t vertices)
{
    switch (pattern) {
    case PATTERN_ORDER:
        return corner % vertices;
    case PATTERN_REVERSED:
        return (corners - 1 - corner) % vertices;
    case PATTERN_NEVER_LAST:
    case PATTERN_LAST_ONCE:
        return vertices > 1 ? draw_below(r, vertices - 1) : 0;
    case PATTERN_LAST_ALWAYS:
        return corner % 3 == corner / 3 % 3 ? vertices - 1 : draw_below(r, vertices);
    case PATTERN_ONE:
        return corners % vertices;
    case PATTERN_NEAR:
        return (corner * vertices / corners + draw_below(r, 20)) % vertices;
    default:
        return draw_below(r, vertices);
    }
}

size_t mesh_number(const tribox_mesh *mesh, size_t corner)
{
    uint16_t narrow;
    uint32_t wide;
    if (!mesh->indices)
        return corner;
    const unsigned char *const at = (const unsigned char *)mesh->indices + mesh->index_bytes * corner;
    if (mesh->index_bytes == sizeof narrow) {
        memcpy(&narrow, at, sizeof narrow);
        return narrow;
    }
    memcpy(&wide, at, sizeof wide);
    return wide;
}

static void put_number(unsigned char *at, unsigned bytes, size_t number)
{
    const uint16_t narrow = (uint16_t)number;
    const uint32_t wide = (uint32_t)number;
    memcpy(at, bytes == sizeof narrow ? (const void *)&narrow : &wide, bytes);
}

void mesh_set_number(const tribox_mesh *mesh, size_t corner, size_t number)
{
    put_number((unsigned char *)(uintptr_t)mesh->indices + mesh->index_bytes * corner, mesh->index_bytes, number);
}

static const void *lay_indices(random_source *r, const layout *l, guarded fence, size_t vertices)
{
    const size_t corners = 3 * l->count;
    unsigned char *const indices = place(fence, corners * l->index_bytes, l);
    for (size_t corner = 0; corner < corners; corner++)
        put_number(indices + l->index_bytes * corner, l->index_bytes, draw_index(r, l->pattern, corner, corners, vertices));
    if (corners && l->pattern == PATTERN_LAST_ONCE)
        put_number(indices + l->index_bytes * draw_below(r, corners), l->index_bytes, vertices - 1);
    return indices;
}

tribox_mesh mesh_lay(random_source *r, const layout *l, mesh_fences f)
{
    const size_t vertices = draw_vertices(r, l), stride = stride_of(l->stride);
    unsigned char *const positions = place(f.positions, vertices ? (vertices - 1) * stride + VERTEX_BYTES : 0, l);
    for (size_t n = 0; n < vertices; n++)
        draw_vertex(r, positions + n * stride);
    return (tribox_mesh){.positions = positions,
                         .stride = l->stride,
                         .vertices = vertices,
                         .indices = l->index_bytes ? lay_indices(r, l, f.indices, vertices) : NULL,
                         .index_bytes = l->index_bytes,
                         .count = l->count};
}

void mesh_expect(const tribox_mesh *mesh, size_t first, size_t count, float *const stream[9])
{
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; v < 3; v++) {
            const size_t number = mesh_number(mesh, 3 * (first + i) + v);
            const unsigned char *const vertex = (const unsigned char *)mesh->positions + number * stride_of(mesh->stride);
            for (size_t a = 0; a < 3; a++)
                memcpy(&stream[3 * a + v][i], vertex + a * sizeof(float), sizeof(float));
        }
}

static void set_coordinate(const tribox_mesh *mesh, size_t vertex, int a, float x)
{
    unsigned char *const positions = (unsigned char *)(uintptr_t)mesh->positions;
    memcpy(positions + vertex * stride_of(mesh->stride) + sizeof x * (size_t)a, &x, sizeof x);
}

/* On the face, in the box, or no number. */
static float draw_exception(random_source *r, float face, float within)
{
    const float choice[] = {face, within, NAN};
    return choice[random_int(r, 3)];
}

void mesh_move_beside(random_source *r, const tribox_mesh *mesh, const tribox_box *box)
{
    for (size_t first = 0, end; first < mesh->vertices; first = end) {
        const int a = random_int(r, 3), side = random_int(r, 2);
        const float face = side ? (float)box->hi[a] : (float)box->lo[a], beyond = side ? INFINITY : -INFINITY;
        end = first + 1 + draw_below(r, random_int(r, 4) ? 900 : 60);
        end = end < mesh->vertices ? end : mesh->vertices;
        for (size_t n = first; n < end; n++)
            set_coordinate(mesh, n, a, random_int(r, 2) ? nextafterf(face, beyond) : face + (side ? 1.0f : -1.0f));
        const size_t places[] = {first, end - 1, first + draw_below(r, end - first)};
        if (random_int(r, 2))
            set_coordinate(mesh, places[random_int(r, 3)], a, draw_exception(r, face, ((float)box->lo[a] + (float)box->hi[a]) / 2));
    }
}

const char *mesh_text(const tribox_mesh *mesh, char text[MESH_TEXT])
{
    snprintf(text, MESH_TEXT, "%zu triangles, %zu vertices, stride %zu, indices of %u bytes", mesh->count, mesh->vertices,
             mesh->stride, mesh->indices ? mesh->index_bytes : 0);
    return text;
}
