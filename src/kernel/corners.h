/*
 * corners.h - a packet of triangles of a mesh, from where they lie in memory to registers.
 * After: axes.h, nine.h. Needs: v_transpose4.
 *
 * Vertices are read four floats wide and transposed. What is read beside one of them lies in the mesh: of nine floats each, the
 * last vertex of a triangle is read from the float before it on; of others none is the last of the mesh (gather.h).
 */

TRIBOX_INLINE void load_vertices(lane_triangle *t, int j, const void *const place[V_LANES], int before)
{
    vnum number[4];
    v_transpose4(place, number);
    for (int a = 0; a < 3; a++)
        t->u[j][a] = number[a + before];
}

/* Vertex j of triangles of nine floats each, from `before` floats before it on. */
TRIBOX_INLINE void load_vertex_of_nine(lane_triangle *t, const char *from, int j, int before)
{
    const void *place[V_LANES];
    for (int lane = 0; lane < V_LANES; lane++)
        place[lane] = from + 36 * lane + 12 * j - 4 * before;
    load_vertices(t, j, place, before);
}

TRIBOX_INLINE void load_vertex_at(lane_triangle *t, const char *base, const uint32_t *offset, int j)
{
    const void *place[V_LANES];
    for (int lane = 0; lane < V_LANES; lane++)
        place[lane] = base + offset[3 * lane + j];
    load_vertices(t, j, place, 0);
}

/* Three calls and no loop: compilers keep a loop as large as this, and with it the triangle in memory. */
TRIBOX_INLINE void load_nines(lane_triangle *t, const char *from)
{
    load_vertex_of_nine(t, from, 0, 0);
    load_vertex_of_nine(t, from, 1, 0);
    load_vertex_of_nine(t, from, 2, 1);
}

TRIBOX_INLINE void load_offsets(lane_triangle *t, const char *base, const uint32_t *offset)
{
    load_vertex_at(t, base, offset, 0);
    load_vertex_at(t, base, offset, 1);
    load_vertex_at(t, base, offset, 2);
}

/* The packet at triangle `at`. */
TRIBOX_INLINE void load_corners(lane_triangle *t, const tribox_corners *corners, size_t at)
{
    if (corners->offset)
        load_offsets(t, corners->base, corners->offset + 3 * at);
    else if (V_LANES > 8) /* with fewer lanes, blends take longer than transposes */
        load_nine(t, (const float *)(const void *)(corners->base + 36 * at));
    else
        load_nines(t, corners->base + 36 * at);
}
