/*
 * writes.h - bits of cells: listed first, then written many at a time, so that misses of the cache overlap.
 * After: voxelizing.h. Needs: the words of integers.
 *
 * An entry is some of the 32 bits of half a word. Halves are counted from the start of the first layer asked for, modulo 2^32: a
 * window has no more of them.
 */

/* Half `half` of the grid: on a machine that stores the high half of a word first, the other one in memory. */
TRIBOX_INLINE unsigned char *half_at(uint64_t *occupied, uint32_t half)
{
    const uint64_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return (unsigned char *)occupied + 4 * (size_t)(first ? half : half ^ 1);
}

/* The ids of its cells. */
TRIBOX_INLINE uint32_t *ids_of_half(const tribox_cell_ids *ids, uint32_t half)
{
    return tribox_ids_of_word(ids, half / 2) + half % 2 * 32;
}

/*
 * Leaves in the place of each half what it was before. Fetching ahead pays where the grid is larger than a cache, and costs where
 * it is not. Of ids it pays always, as there are 32 times as many bytes: two lines of a cache for a half. `first` is the id of
 * triangle 0.
 */
TRIBOX_INLINE void write_each(tribox_writes *w, uint64_t *occupied, bool is_far, bool is_counted, const tribox_cell_ids *ids,
                              uint32_t first)
{
    const unsigned count = w->count;
    for (unsigned n = 0; n < count; n++) {
        unsigned char *const at = half_at(occupied, (uint32_t)w->half[n]);
        uint32_t before;
        if (is_far)
            tribox_will_write(half_at(occupied, (uint32_t)w->half[n + TRIBOX_WRITES_AHEAD]));
        if (ids) {
            uint32_t *const next = ids_of_half(ids, (uint32_t)w->half[n + TRIBOX_WRITES_AHEAD]);
            tribox_will_write(next);
            tribox_will_write(next + 16);
        }
        memcpy(&before, at, sizeof before);
        const uint32_t after = before | (uint32_t)w->bits[n];
        memcpy(at, &after, sizeof after);
        if (ids)
            tribox_lower_ids(ids, ids_of_half(ids, (uint32_t)w->half[n]), before, (uint32_t)w->bits[n],
                             first + (uint32_t)w->number[n]);
        if (is_counted)
            w->half[n] = (int32_t)before;
    }
}

/* How many bits all entries have that were not set before. */
TRIBOX_INLINE size_t count_written(tribox_writes *w)
{
    int32_t in_lane[V_LANES];
    vint sum = i_splat(0);
    size_t bits = 0;
    i_write(&w->bits[w->count], sum);
    for (unsigned n = 0; n < w->count; n += V_LANES)
        sum = i_add(sum, i_count(i_andnot(i_load(&w->bits[n]), i_load(&w->half[n]))));
    i_write(in_lane, sum);
    for (int n = 0; n < V_LANES; n++)
        bits += (size_t)in_lane[n];
    return bits;
}

TRIBOX_NOINLINE void write_listed(tribox_voxels *v)
{
    tribox_writes *const w = &v->sinks.writes;
    if (!w->count)
        return;
    for (unsigned n = 0; n < TRIBOX_WRITES_AHEAD && (v->sinks.is_far || v->sinks.ids.of || v->sinks.pairs); n++)
        w->half[w->count + n] = w->half[w->count - 1];
    if (v->sinks.pairs)
        v->sinks.pairs->take(v->sinks.pairs->taker, w, tribox_voxels_id(v, 0));
    else if (v->sinks.ids.of)
        write_each(w, v->sinks.occupied, true, true, &v->sinks.ids, tribox_voxels_id(v, 0));
    else if (v->sinks.is_counted && v->sinks.is_far)
        write_each(w, v->sinks.occupied, true, true, NULL, 0);
    else if (v->sinks.is_counted)
        write_each(w, v->sinks.occupied, false, true, NULL, 0);
    else if (v->sinks.is_far)
        write_each(w, v->sinks.occupied, true, false, NULL, 0);
    else
        write_each(w, v->sinks.occupied, false, false, NULL, 0);
    if (v->sinks.is_counted)
        v->counts.overlapping += count_written(w);
    w->count = 0;
}

/* Room for what a step lists. */
TRIBOX_INLINE void make_room(tribox_voxels *v)
{
    if (v->sinks.writes.count > TRIBOX_WRITES)
        write_listed(v);
}

/* The numbers of a packet of triangles, if they are to be listed. */
TRIBOX_INLINE const int32_t *listed_numbers(const tribox_voxels *v, const int32_t *number)
{
    return v->sinks.ids.of || v->sinks.pairs ? number : NULL;
}

TRIBOX_INLINE void list(tribox_voxels *v, vmask m, vint half, vint bits, const int32_t *number)
{
    tribox_writes *const w = &v->sinks.writes;
    i_pack(&w->half[w->count], m, half);
    i_pack(&w->bits[w->count], m, bits);
    if (number)
        i_pack(&w->number[w->count], m, i_load(number));
    w->count += m_count(m);
}

/* Bits that begin at bit `from`, 0 to 31, of a half, and may go on in the next. */
TRIBOX_INLINE void list_bits(tribox_voxels *v, vint half, vint from, vint bits, const int32_t *number)
{
    const vint high = i_shl_over(bits, from), low = i_shl(bits, from);
    const vmask has_high = m_has_bits(high);
    list(v, m_has_bits(low), half, low, number);
    if (m_bits(has_high))
        list(v, has_high, i_add(half, i_splat(1)), high, number);
}

/* Where the bits of cells are: their halves, and the bit of the first. */
typedef struct lane_bits {
    vint half, from;
} lane_bits;

/* Of cells in layers before those asked for, too. Axes have at most 2^20 cells here (PROOFS.md 7.9), and halves are modulo 2^32. */
TRIBOX_INLINE lane_bits bits_at(const tribox_voxels *v, const vnum base[3])
{
    const vint layer = i_add(i_cut(base[2]), i_splat((int32_t)-v->window.first_layer));
    const vint row = i_add(i_mul(layer, i_splat((int32_t)v->window.size[1])), i_cut(base[1]));
    return (lane_bits){i_add(i_mul(row, i_splat(v->sinks.row_halves)), i_cut(v_mul(base[0], v_splat(0x1p-5f)))),
                       i_and(i_cut(base[0]), i_splat(31))};
}
