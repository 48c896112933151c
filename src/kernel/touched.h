/*
 * touched.h - which cells of a grid the bounding boxes of triangles touch, in double.
 * After: axes.h. Needs: v_write_int.
 *
 * A number lies in the cell that its place says, unless a plane of the grid is within the lattice's error of it; then it is
 * uncertain (PROOFS.md 7.2, 7.3).
 */

/* To the nearest integer, for places in a grid: below 2^51. */
TRIBOX_INLINE vnum rounded(vnum a)
{
    const vnum shift = v_splat(0x1.8p52);
    return v_sub(v_add(a, shift), shift);
}

/*
 * The cell of a place, its floor (of a whole place that cell or the one before, PROOFS.md 7.3): -1 for everything below the grid,
 * size for everything above it.
 */
TRIBOX_INLINE vnum cell_of(vnum place, vnum size)
{
    const vnum half = v_splat(0.5);
    return rounded(v_sub(v_min(v_max(place, v_splat(-0.5)), v_add(size, half)), half));
}

/* What is known of a packet. */
typedef struct packet_touched {
    vnum base[3];
    uint64_t touching, uncertain, spans[3];
} packet_touched;

/* Axis a of the triangles from `at`; those that touch cells from .. end - 1 stay. */
TRIBOX_INLINE void touch_on_axis(packet_touched *packet, const float *const stream[3], size_t at, const tribox_lattice *lattice,
                                 int a, double from, double end, tribox_touched *touched, int lane)
{
    const vnum x0 = v_load(stream[0] + at), x1 = v_load(stream[1] + at), x2 = v_load(stream[2] + at);
    const vnum origin = v_splat(lattice->origin[a]), per_cell = v_splat(lattice->per_cell[a]);
    const vnum error = v_splat(lattice->error[a]), size = v_splat(lattice->size[a]);
    const vnum least = v_mul(v_sub(lane_min3(x0, x1, x2), origin), per_cell);
    const vnum most = v_mul(v_sub(lane_max3(x0, x1, x2), origin), per_cell);
    const vnum first = cell_of(v_sub(least, error), size), last = cell_of(v_add(most, error), size);
    const vnum first_not_below = cell_of(v_add(least, error), size), last_not_above = cell_of(v_sub(most, error), size);
    packet->base[a] = v_max(first, v_splat(0));
    v_write(&touched->base[a][lane], packet->base[a]);
    v_write(&touched->cells[a][lane], v_sub(v_min(v_add(last, v_splat(1)), size), packet->base[a]));
    packet->uncertain |= m_bits(m_or(v_gt(first_not_below, first), v_gt(last, last_not_above)));
    packet->spans[a] = m_bits(v_gt(last, first));
    packet->touching &= m_bits(m_andnot(v_gt(v_splat(end), first), v_gt(v_splat(from), last)));
}

/* Where the bits of the first cells are (PROOFS.md 7.8). */
TRIBOX_INLINE void write_words(const packet_touched *packet, const tribox_lattice *lattice, tribox_touched *touched, int lane)
{
    const vnum row = v_fma(v_sub(packet->base[2], v_splat(lattice->first_layer)), v_splat(lattice->size[1]), packet->base[1]);
    const vnum word = rounded(v_sub(v_mul(packet->base[0], v_splat(1.0 / 64)), v_splat(0.5 - 1.0 / 128)));
    v_write_int(&touched->word[lane], v_fma(row, v_splat(lattice->row_words), word));
    v_write_int(&touched->bit[lane], v_sub(packet->base[0], v_mul(word, v_splat(64))));
}

/* The lanes without NaN and infinity, which min and max can drop: the sum is finite only if every number is. */
TRIBOX_INLINE uint64_t finite_at(const tribox_soup *soup, size_t at)
{
    vnum sum = v_splat(0);
    for (int v = 0; v < 3; v++)
        sum = v_add(v_add(sum, v_load(soup->x[v] + at)), v_add(v_load(soup->y[v] + at), v_load(soup->z[v] + at)));
    return m_bits(v_gt(v_splat(INFINITY), v_abs(sum)));
}

static uint64_t touched_cells(const tribox_soup *soup, size_t word, const tribox_lattice *lattice, tribox_touched *touched)
{
    uint64_t touching = 0;
    touched->spans[0] = touched->spans[1] = touched->spans[2] = touched->uncertain = 0;
    for (int lane = 0; lane < 64; lane += V_LANES) {
        const size_t at = 64 * word + (size_t)lane;
        packet_touched packet = {.touching = LANES_ALL};
        touch_on_axis(&packet, soup->z, at, lattice, 2, lattice->first_layer, lattice->end_layer, touched, lane);
        if (!packet.touching)
            continue;
        touch_on_axis(&packet, soup->y, at, lattice, 1, 0, lattice->size[1], touched, lane);
        if (!packet.touching)
            continue;
        touch_on_axis(&packet, soup->x, at, lattice, 0, 0, lattice->size[0], touched, lane);
        packet.touching &= finite_at(soup, at);
        if (!packet.touching)
            continue;
        write_words(&packet, lattice, touched, lane);
        touching |= packet.touching << lane;
        touched->uncertain |= (packet.uncertain & packet.touching) << lane;
        for (int a = 0; a < 3; a++)
            touched->spans[a] |= (packet.spans[a] & packet.touching) << lane;
    }
    return touching;
}
