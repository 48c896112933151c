/*
 * corners.h - a packet of triangles of a mesh, from where they lie in memory to registers.
 * After: axes.h, nine.h. Needs: v_transpose4, v_local_transpose4.
 *
 * Vertices are read four numbers wide and transposed. What is read next to one of them lies in the mesh: of nine numbers each, the
 * last vertex of a triangle is read from the number before it on; of others none is the last of the mesh (gather.h).
 */

/* Vertices read from `before` numbers before them. */
TRIBOX_INLINE void load_vertices(lane_triangle *t, int j, const void *const place[V_LANES], int before, lane_numbers numbers)
{
    vnum number[4];
    if (numbers.are_doubles)
        v_local_transpose4(place, numbers.origin + (3 - before) % 3, number);
    else
        v_transpose4(place, number);
    for (int a = 0; a < 3; a++)
        t->u[j][a] = number[a + before];
}

/* Vertex j of triangles of nine numbers each, from `before` numbers before it on. */
TRIBOX_INLINE void load_vertex_of_nine(lane_triangle *t, const char *from, int j, int before, lane_numbers numbers)
{
    const void *place[V_LANES];
    for (int lane = 0; lane < V_LANES; lane++)
        place[lane] = from + (9 * lane + 3 * j - before) * bytes_of(numbers);
    load_vertices(t, j, place, before, numbers);
}

TRIBOX_INLINE void load_vertex_at(lane_triangle *t, const char *base, const uint32_t *offset, int j, lane_numbers numbers)
{
    const void *place[V_LANES];
    for (int lane = 0; lane < V_LANES; lane++)
        place[lane] = base + offset[3 * lane + j];
    load_vertices(t, j, place, 0, numbers);
}

/* Three calls and no loop: compilers keep a loop as large as this, and with it the triangle in memory. */
TRIBOX_INLINE void load_nines(lane_triangle *t, const char *from, lane_numbers numbers)
{
    load_vertex_of_nine(t, from, 0, 0, numbers);
    load_vertex_of_nine(t, from, 1, 0, numbers);
    load_vertex_of_nine(t, from, 2, 1, numbers);
}

TRIBOX_INLINE void load_offsets(lane_triangle *t, const char *base, const uint32_t *offset, lane_numbers numbers)
{
    load_vertex_at(t, base, offset, 0, numbers);
    load_vertex_at(t, base, offset, 1, numbers);
    load_vertex_at(t, base, offset, 2, numbers);
}

/* Vertices at places given one by one. */
TRIBOX_INLINE void load_places(lane_triangle *t, const char *const *corner)
{
    for (int j = 0; j < 3; j++) {
        const void *place[V_LANES];
        for (int lane = 0; lane < V_LANES; lane++)
            place[lane] = corner[3 * lane + j];
        load_vertices(t, j, place, 0, (lane_numbers){false, NULL});
    }
}

/*
 * Nine numbers each: a packet some way ahead comes into the cache while this one is tested, as tests keep the processor so busy
 * that it does not look that far by itself. Corners by offset are so many lines that to fetch them takes longer than to wait.
 */
enum { LANES_AHEAD = 4 * V_LANES };
TRIBOX_INLINE void fetch_ahead(const tribox_corners *corners, size_t at, int bytes)
{
    const char *const ahead = corners->base + (at + LANES_AHEAD) * (size_t)(9 * bytes);
    if (at + LANES_AHEAD + V_LANES <= corners->ahead)
        for (int line = 0; line < 9 * bytes * V_LANES; line += 64)
            tribox_will_read(ahead + line);
}

/* The packet at triangle `at`. */
TRIBOX_INLINE void load_corners(lane_triangle *t, const tribox_corners *corners, size_t at, bool is_local)
{
    const lane_numbers numbers = {is_local, corners->origin};
    const char *const nines = corners->base + (size_t)(9 * bytes_of(numbers)) * at;
    if (corners->ahead)
        fetch_ahead(corners, at, bytes_of(numbers));
    if (corners->offset)
        load_offsets(t, corners->base, corners->offset + 3 * at, numbers);
    else if (V_LANES > 8) /* with fewer lanes, blends take longer than transposes */
        load_nine(t, nines, numbers);
    else
        load_nines(t, nines, numbers);
}
