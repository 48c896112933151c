/*
 * gather.h - triangles of a mesh into nine streams: V_LANES vertices at a time, read four floats wide and transposed in registers.
 * After: nine.h. Needs: v_transpose4.
 *
 * The last vertex is not read wide: its z may be the last float in memory. Words of triangles that refer to it, and an incomplete
 * packet at the end, go number by number.
 */

/* The width of the indices, and whether the stride is the least: constants of an instance. */
typedef struct mesh_kind {
    unsigned index_bytes; /* 0 for none */
    bool is_packed;       /* 12 bytes from a vertex to the next */
} mesh_kind;

TRIBOX_INLINE const void *vertex_of(const tribox_mesh *mesh, mesh_kind kind, size_t corner)
{
    return (const char *)mesh->positions +
           tribox_vertex_number(mesh, kind.index_bytes, corner) * (kind.is_packed ? 12 : mesh->stride);
}

typedef struct vertex_span {
    size_t least, greatest;
} vertex_span;

/* Of the vertex numbers of triangles first .. first + count - 1; of none, 0 is the greatest. */
TRIBOX_INLINE vertex_span span_of_vertices(const tribox_mesh *mesh, mesh_kind kind, size_t first, size_t count)
{
    uint32_t least = UINT32_MAX, greatest = 0; /* no wider than an index, for the most lanes */
    if (!kind.index_bytes)
        return (vertex_span){3 * first, count ? 3 * (first + count) - 1 : 0};
    for (size_t corner = 3 * first; corner < 3 * (first + count); corner++) {
        const uint32_t number = (uint32_t)tribox_vertex_number(mesh, kind.index_bytes, corner);
        least = number < least ? number : least;
        greatest = number > greatest ? number : greatest;
    }
    return (vertex_span){least, greatest};
}

/* Triangle `from` of the mesh to place `at` of the streams x_0 x_1 x_2 y_0 .. z_2. */
TRIBOX_INLINE void gather_triangle(const tribox_mesh *mesh, mesh_kind kind, size_t from, float *const to[9], size_t at)
{
    for (size_t v = 0; v < 3; v++) {
        const char *const vertex = vertex_of(mesh, kind, 3 * from + v);
        for (size_t a = 0; a < 3; a++)
            memcpy(to[3 * a + v] + at, vertex + a * sizeof(float), sizeof(float));
    }
}

TRIBOX_INLINE void gather_packet(const tribox_mesh *mesh, mesh_kind kind, size_t from, float *const to[9], size_t at)
{
    for (size_t v = 0; v < 3; v++) {
        const void *vertex[V_LANES];
        vnum number[4];
        for (size_t lane = 0; lane < V_LANES; lane++)
            vertex[lane] = vertex_of(mesh, kind, 3 * (from + lane) + v);
        v_transpose4(vertex, number);
        for (size_t a = 0; a < 3; a++)
            v_write(to[3 * a + v] + at, number[a]);
    }
}

TRIBOX_INLINE void gather_kind(const tribox_mesh *mesh, mesh_kind kind, size_t first, size_t count, float *const to[9])
{
    for (size_t word = 0; word < count; word += 64) {
        const size_t end = word + (count - word < 64 ? count - word : 64);
        const bool is_wide = span_of_vertices(mesh, kind, first + word, end - word).greatest + 1 < mesh->vertices;
        size_t at = word;
        for (; is_wide && at + V_LANES <= end; at += V_LANES)
            gather_packet(mesh, kind, first + at, to, at);
        for (; at < end; at++)
            gather_triangle(mesh, kind, first + at, to, at);
    }
}

TRIBOX_INLINE void gather_nines(const tribox_mesh *mesh, size_t first, size_t count, float *const to[9])
{
    const mesh_kind kind = {0, true};
    size_t at = 0;
    for (; at + V_LANES <= count; at += V_LANES)
        gather_nine(vertex_of(mesh, kind, 3 * (first + at)), to, at);
    for (; at < count; at++)
        gather_triangle(mesh, kind, first + at, to, at);
}

static void gather(const tribox_mesh *mesh, size_t first, size_t count, float *const to[9])
{
    const bool is_packed = mesh->stride == 12;
    const unsigned index_bytes = tribox_index_bytes(mesh);
    if (index_bytes == 4 && is_packed)
        gather_kind(mesh, (mesh_kind){4, true}, first, count, to);
    else if (index_bytes == 4)
        gather_kind(mesh, (mesh_kind){4, false}, first, count, to);
    else if (index_bytes == 2 && is_packed)
        gather_kind(mesh, (mesh_kind){2, true}, first, count, to);
    else if (index_bytes == 2)
        gather_kind(mesh, (mesh_kind){2, false}, first, count, to);
    else if (is_packed && V_LANES > 8) /* with fewer lanes, blends take longer than transposes */
        gather_nines(mesh, first, count, to);
    else if (is_packed)
        gather_kind(mesh, (mesh_kind){0, true}, first, count, to);
    else
        gather_kind(mesh, (mesh_kind){0, false}, first, count, to);
}

TRIBOX_INLINE vertex_span span_of_mesh(const tribox_mesh *mesh, size_t first, size_t count)
{
    return !mesh->indices           ? span_of_vertices(mesh, (mesh_kind){0, false}, first, count)
           : mesh->index_bytes == 2 ? span_of_vertices(mesh, (mesh_kind){2, false}, first, count)
                                    : span_of_vertices(mesh, (mesh_kind){4, false}, first, count);
}

static size_t greatest_vertex(const tribox_mesh *mesh, size_t first, size_t count)
{
    return span_of_mesh(mesh, first, count).greatest;
}
