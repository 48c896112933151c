/*
 * apart_words.h - is a word of a mesh apart from the box: all its vertices beyond one face?
 * After: gather.h.
 *
 * Then bullet 1 separates every triangle, and none has to be gathered. All vertices from the least number to the greatest are
 * compared: they lie side by side in memory, and in most meshes what is near in number is near in space. Stops at the first packet
 * after which no face is left.
 */

/* More vertices than this are not compared: gathering would cost less. */
enum { BESIDE_MAX = 768 };

/* Numbers to the vertices of the next word, if no two triangles share one: where positions are far, these are read ahead. */
enum { WORD_AHEAD = 9 * 64 };

/* Position k of 3 * V_LANES floats is axis k % 3 of a vertex. */
#define BESIDE_AXIS(a) ((UINT64_C(0x249249249249) << (a)) & (~UINT64_C(0) >> (64 - 3 * V_LANES)))

TRIBOX_INLINE bool has_whole_axis(uint64_t bits)
{
    return (bits & BESIDE_AXIS(0)) == BESIDE_AXIS(0) || (bits & BESIDE_AXIS(1)) == BESIDE_AXIS(1) ||
           (bits & BESIDE_AXIS(2)) == BESIDE_AXIS(2);
}

TRIBOX_INLINE bool are_apart(const char *positions, const tribox_box_pattern *box, size_t vertices, bool is_far,
                             lane_numbers numbers)
{
    vnum lo[3], hi[3];
    for (int t = 0; t < 3; t++) {
        lo[t] = v_load(box->lo + V_LANES * t);
        hi[t] = v_load(box->hi + V_LANES * t);
    }
    uint64_t below = ~UINT64_C(0), above = ~UINT64_C(0);
    for (size_t done = 0; done < vertices; done += V_LANES) {
        const size_t at = done + V_LANES <= vertices ? done : vertices - V_LANES; /* the last packet overlaps the one before it */
        uint64_t is_below = 0, is_above = 0;
        for (int t = 0; t < 3; t++) {
            const char *const from = positions + (3 * at + (size_t)(V_LANES * t)) * (size_t)bytes_of(numbers);
            for (int line = 0; is_far && line < V_LANES * bytes_of(numbers); line += 64)
                tribox_will_read(from + WORD_AHEAD * bytes_of(numbers) + line);
            const vnum u = load_numbers(from, V_LANES * t, numbers);
            is_below |= m_bits(v_gt(lo[t], u)) << (V_LANES * t);
            is_above |= m_bits(v_gt(u, hi[t])) << (V_LANES * t);
        }
        below &= is_below;
        above &= is_above;
        if (!has_whole_axis(below) && !has_whole_axis(above))
            return false;
    }
    return true;
}

static bool is_mesh_apart(const tribox_mesh *mesh, const tribox_box_pattern *box, tribox_vertices named)
{
    const size_t bytes = tribox_position_bytes(mesh), vertices = named.greatest + 1 - named.least;
    if (mesh->stride != 3 * bytes || (uintptr_t)mesh->positions % bytes || vertices < V_LANES || vertices > BESIDE_MAX)
        return false;
    const bool is_far = has_far_positions(mesh);
    const char *const positions = (const char *)mesh->positions + mesh->stride * named.least;
    return box->origin ? are_apart(positions, box, vertices, is_far, (lane_numbers){true, box->origin})
                       : are_apart(positions, box, vertices, is_far, (lane_numbers){false, NULL});
}
