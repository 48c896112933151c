/*
 * tile_ranges.h - which tiles of a grid the bounding boxes of triangles touch, in float. After: reach.h. Needs: v_nearest, KERNEL.
 *
 * A number lies in the tile that its place says, unless a whole place, or an end of the grid, is within `doubt` of that: whoever
 * asks then finds out from the planes (PROOFS.md 7.12).
 */

TRIBOX_INLINE vnum tile_place(vnum x, const tribox_tile_lattice *lattice, int a)
{
    const vnum place = v_fma(v_sub(x, v_splat(lattice->origin[a])), v_splat(lattice->per_tile[a]), v_splat(lattice->off[a]));
    return v_min(v_max(place, v_splat(-1)), v_splat(lattice->end[a] + 1));
}

/* The tiles of a packet on an axis. */
typedef struct lane_tiles {
    vnum first, more; /* a whole number, and how many tiles follow it */
    vmask outside, unknown;
} lane_tiles;

TRIBOX_INLINE lane_tiles tiles_of(const vnum u[3], const tribox_tile_lattice *lattice, int a)
{
    const vnum half = v_splat(0.5f), doubt = v_splat(lattice->doubt[a]), end = v_splat(lattice->end[a]);
    const vnum from = tile_place(lane_min3(u[0], u[1], u[2]), lattice, a), to = tile_place(lane_max3(u[0], u[1], u[2]), lattice, a);
    const vnum from_middle = v_sub(from, half), to_middle = v_sub(to, half);
    const vnum first = v_nearest(from_middle), last = v_nearest(to_middle);
    const vnum off = v_max(v_abs(v_sub(from_middle, first)), v_abs(v_sub(to_middle, last)));
    lane_tiles tiles = {.first = first, .more = v_sub(last, first)};
    tiles.outside = m_or(v_gt(v_sub(v_splat(0), doubt), to), v_gt(from, v_add(end, doubt)));
    tiles.unknown = m_or(m_or(v_gt(off, v_sub(half, doubt)), v_gt(v_splat(0), first)),
                         m_or(v_gt(to, v_sub(end, doubt)), v_gt(tiles.more, v_splat(TRIBOX_TILES_MORE))));
    return tiles;
}

/* Those from triangle `at` on. */
TRIBOX_INLINE void find_packet(const tribox_soup *soup, const tribox_tile_lattice *lattice, tribox_tile_range *range, size_t at)
{
    vnum u[9];
    vint number = i_splat(0), following = i_splat(0);
    vmask outside = m_none(), unknown = m_none();
    for (int a = 2; a >= 0; a--) {
        const float *const *const stream = tribox_soup_axis(soup, a);
        for (int j = 0; j < 3; j++)
            u[3 * a + j] = v_load(stream[j] + at);
        const lane_tiles tiles = tiles_of(u + 3 * a, lattice, a);
        number = i_add(i_mul(number, i_splat(lattice->along[a])), i_cut(tiles.first));
        following = i_or(i_shl(following, i_splat(TRIBOX_TILES_BITS)), i_cut(tiles.more));
        outside = m_or(outside, tiles.outside);
        unknown = m_or(unknown, tiles.unknown);
    }
    unknown = m_andnot(m_or(unknown, m_not(is_finite(u))), outside);
    following = i_or(i_keep(m_not(m_or(unknown, outside)), following), i_keep(unknown, i_splat(TRIBOX_TILES_UNKNOWN)));
    i_write(range->first + at, number);
    i_write(range->more + at, i_or(following, i_keep(outside, i_splat(TRIBOX_TILES_NONE))));
}

/* The last packet ends with the last triangle, unless they are fewer than a packet. */
static void find_tiles(const tribox_soup *soup, const tribox_tile_lattice *lattice, tribox_tile_range *range)
{
    const size_t count = soup->count;
    for (size_t at = 0; at + V_LANES <= count; at += V_LANES)
        find_packet(soup, lattice, range, at);
    if (count % V_LANES)
        find_packet(soup, lattice, range, count < V_LANES ? 0 : count - V_LANES);
}
