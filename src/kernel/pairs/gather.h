/*
 * gather.h - where triangles of a mesh lie, and the same as nine streams.
 * After: corners.h, tail.h.
 *
 * Packets are read four numbers at a vertex (corners.h). The last vertex is not, unless triangles are nine numbers each, as its z
 * may be the last number in memory: the first vertex is read in its place, and streams get its numbers one by one.
 */

/* The least and the greatest vertex number at corners first .. first + count - 1. */
TRIBOX_INLINE tribox_vertices vertices_at(const tribox_mesh *mesh, unsigned index_bytes, size_t first, size_t count)
{
    uint32_t least = UINT32_MAX, greatest = 0; /* no wider than an index, for the most lanes */
    for (size_t corner = first; corner < first + count; corner++) {
        const uint32_t number = (uint32_t)tribox_vertex_number(mesh, index_bytes, corner);
        least = number < least ? number : least;
        greatest = number > greatest ? number : greatest;
    }
    return (tribox_vertices){least, greatest};
}

static tribox_vertices find_vertices(const tribox_mesh *mesh, size_t first, size_t count)
{
    return !mesh->indices           ? (tribox_vertices){3 * first, 3 * (first + count) - 1}
           : mesh->index_bytes == 2 ? vertices_at(mesh, 2, 3 * first, 3 * count)
                                    : vertices_at(mesh, 4, 3 * first, 3 * count);
}

/*
 * How many bytes `count` vertices come after the first of the mesh; for the last of the mesh, and for numbers past it, none.
 * Returns the greatest number.
 */
TRIBOX_INLINE size_t find_offsets(const tribox_mesh *mesh, unsigned index_bytes, size_t first, size_t count,
                                  uint32_t *restrict offset)
{
    const tribox_mesh from = *mesh; /* known not to change while offsets are written */
    const uint32_t stride = (uint32_t)from.stride, last = (uint32_t)(from.vertices - 1);
    uint32_t greatest = 0;
    for (size_t k = 0; k < count; k++) {
        const uint32_t number = (uint32_t)tribox_vertex_number(&from, index_bytes, first + k);
        greatest = number > greatest ? number : greatest;
        offset[k] = number < last ? number * stride : 0;
    }
    return greatest;
}

/* More than the nearer caches hold: 2 MiB. */
static bool has_far_positions(const tribox_mesh *mesh) { return mesh->vertices > ((size_t)1 << 21) / mesh->stride; }

static size_t find_corners(const tribox_mesh *mesh, size_t first, size_t count, uint32_t *offset, tribox_corners *corners)
{
    const char *const positions = mesh->positions;
    if (!mesh->indices && mesh->stride == 3 * tribox_position_bytes(mesh)) {
        *corners = (tribox_corners){.base = positions + 3 * mesh->stride * first,
                                    .has_all = true,
                                    .ahead = has_far_positions(mesh) ? mesh->count - first : 0};
        return 3 * (first + count) - 1;
    }
    *corners = (tribox_corners){.offset = offset};
    const bool is_beyond = !mesh->indices && 3 * (first + count) > mesh->vertices; /* perhaps beyond 32 bits */
    if (is_beyond || mesh->vertices < 2 || mesh->vertices > UINT32_MAX / mesh->stride)
        return find_vertices(mesh, first, count).greatest;
    const size_t greatest = !mesh->indices           ? find_offsets(mesh, 0, 3 * first, 3 * count, offset)
                            : mesh->index_bytes == 2 ? find_offsets(mesh, 2, 3 * first, 3 * count, offset)
                                                     : find_offsets(mesh, 4, 3 * first, 3 * count, offset);
    corners->base = positions;
    corners->has_all = greatest < mesh->vertices - 1;
    return greatest;
}

/*
 * The same for the triangles of a list, in whole packets: those past its end have vertex 0. Vertices are read once all are found,
 * and come into the cache meanwhile.
 */
TRIBOX_INLINE size_t find_listed_offsets(const tribox_mesh *mesh, unsigned index_bytes, const uint32_t *list, size_t count,
                                         uint32_t *restrict offset)
{
    const tribox_mesh from = *mesh;
    const uint32_t stride = (uint32_t)from.stride, last = (uint32_t)(from.vertices - 1);
    const char *const positions = from.positions;
    uint32_t greatest = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; v < 3; v++) {
            const uint32_t number = (uint32_t)tribox_vertex_number(&from, index_bytes, 3 * (size_t)list[i] + v);
            greatest = number > greatest ? number : greatest;
            offset[3 * i + v] = number < last ? number * stride : 0;
            tribox_will_read(positions + offset[3 * i + v]);
        }
    for (size_t k = 3 * count; k % (3 * V_LANES); k++)
        offset[k] = 0;
    return greatest;
}

static void find_listed_corners(const tribox_mesh *mesh, const uint32_t *list, size_t count, uint32_t *offset,
                                tribox_corners *corners)
{
    *corners = (tribox_corners){.offset = offset};
    if (mesh->vertices < 2 || mesh->vertices > UINT32_MAX / mesh->stride)
        return;
    const size_t greatest = !mesh->indices           ? find_listed_offsets(mesh, 0, list, count, offset)
                            : mesh->index_bytes == 2 ? find_listed_offsets(mesh, 2, list, count, offset)
                                                     : find_listed_offsets(mesh, 4, list, count, offset);
    corners->base = mesh->positions;
    corners->has_all = greatest < mesh->vertices - 1;
}

/* Where gathered triangles go: the streams x_0 x_1 x_2 y_0 .. z_2, from place `start` on. */
typedef struct gather_to {
    float *const *streams;
    size_t start;
} gather_to;

/* Triangles of a list, or from `first` on, to streams, number by number: vertices from `least` on. */
static void gather_vertices(const tribox_mesh *mesh, const double *origin, const uint32_t *list, size_t first, size_t count,
                            size_t least, gather_to to)
{
    const unsigned bytes = tribox_vertex_bytes(mesh);
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; v < 3; v++) {
            const size_t vertex = tribox_vertex_number(mesh, bytes, 3 * (list ? (size_t)list[i] : first + i) + v);
            const char *const from = (const char *)mesh->positions + vertex * mesh->stride;
            for (size_t a = 0; vertex >= least && a < 3; a++) {
                float *const number = to.streams[3 * a + v] + to.start + i;
                const float local = origin ? tribox_local_number(from + a * sizeof(double), origin[a]) : 0;
                memcpy(number, origin ? (const char *)&local : from + a * sizeof(float), sizeof(float));
            }
        }
}

/* The packet at triangle `at` to the same place of the streams, after their start. */
TRIBOX_INLINE void gather_packet(const tribox_corners *corners, size_t at, gather_to to, bool is_local)
{
    lane_triangle t;
    load_corners(&t, corners, at, is_local);
    for (int k = 0; k < 9; k++)
        v_write(to.streams[k] + to.start + at, t.u[k % 3][k / 3]);
}

TRIBOX_INLINE void gather_packets(const tribox_corners *corners, size_t count, gather_to to, bool is_local)
{
    for (size_t at = 0; at + V_LANES <= count; at += V_LANES)
        gather_packet(corners, at, to, is_local);
    if (count % V_LANES) /* the last packet repeats triangles of the one before it */
        gather_packet(corners, count - V_LANES, to, is_local);
}

static void gather_word(const tribox_mesh *mesh, const double *origin, const uint32_t *list, size_t first, size_t count,
                        gather_to to)
{
    uint32_t offset[3 * 64];
    tribox_corners corners;
    const size_t written = list ? (count + V_LANES - 1) / V_LANES * V_LANES : count;
    if (list ? count <= V_LANES / 2 || TRIBOX_WALKS_SOUPS_ALONE : count < V_LANES) { /* where packets take longer, or much code */
        gather_vertices(mesh, origin, list, first, count, 0, to);
        return;
    }
    if (list)
        find_listed_corners(mesh, list, count, offset, &corners);
    else
        find_corners(mesh, first, count, offset, &corners);
    corners.origin = origin;
    if (!corners.base) {
        gather_vertices(mesh, origin, list, first, count, 0, to);
        return;
    }
    if (origin)
        gather_packets(&corners, written, to, true);
    else
        gather_packets(&corners, written, to, false);
    if (!corners.has_all)
        gather_vertices(mesh, origin, list, first, count, mesh->vertices - 1, to);
}

static void gather(const tribox_mesh *mesh, const double *origin, const uint32_t *list, size_t first, size_t count,
                   float *const to[9])
{
    for (size_t word = 0; word < count; word += 64)
        gather_word(mesh, origin, list ? list + first + word : NULL, first + word, count - word < 64 ? count - word : 64,
                    (gather_to){to, word});
}
