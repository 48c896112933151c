/*
 * extents.h - the nodes of an index, from the triangles of a soup or from nodes of the level below.
 * After: axes.h. Needs: v_load_few, v_transpose4, v_drop.
 *
 * The extent of a child is found lane by lane, and then across the lanes for V_LANES children at once.
 */

/* In each lane, the bounds of a part of what a child has. */
typedef struct lane_extent {
    vnum bound[6]; /* in the order of a node */
} lane_extent;

TRIBOX_INLINE lane_extent no_extent(void)
{
    lane_extent extent;
    for (int a = 0; a < 3; a++) {
        extent.bound[a] = v_splat(INFINITY);
        extent.bound[3 + a] = v_splat(-INFINITY);
    }
    return extent;
}

/* In each lane zero of a finite triangle, NaN of others. */
TRIBOX_INLINE vnum lost_of_triangles(const vnum u[9])
{
    return v_add(v_add(lane_lost3(u[0], u[1], u[2]), lane_lost3(u[3], u[4], u[5])), lane_lost3(u[6], u[7], u[8]));
}

/* Takes in a packet of triangles but those that are left out, u[k] being number k in the order of the streams. */
TRIBOX_INLINE void take_triangles(lane_extent *extent, const vnum u[9], vmask left_out)
{
    for (int a = 0; a < 3; a++) {
        const vnum least = lane_min3(u[3 * a], u[3 * a + 1], u[3 * a + 2]);
        const vnum most = lane_max3(u[3 * a], u[3 * a + 1], u[3 * a + 2]);
        /* Of NaN and a bound, the bound. */
        extent->bound[a] = v_min(v_drop(left_out, least), extent->bound[a]);
        extent->bound[3 + a] = v_max(v_drop(left_out, most), extent->bound[3 + a]);
    }
}

/* A packet at triangle `at`; if it is not whole, lanes past its last triangle repeat another, which changes no bound. */
TRIBOX_INLINE void load_triangles(vnum u[9], const tribox_soup *soup, size_t at, size_t count)
{
    for (int k = 0; k < 9; k++) {
        const float *const from = tribox_soup_axis(soup, k / 3)[k % 3] + at;
        u[k] = count < V_LANES ? v_load_few(from, count) : v_load(from);
    }
}

/* The same of a word that is not whole. */
static void take_finite(lane_extent *extent, const tribox_soup *soup, size_t first, size_t count)
{
    vnum u[9];
    *extent = no_extent();
    for (size_t done = 0; done < count; done += V_LANES) {
        load_triangles(u, soup, first + done, count - done);
        take_triangles(extent, u, m_not(v_is_zero(lost_of_triangles(u))));
    }
}

/*
 * `count` triangles of a soup, 64 at most. Returns whether they are 64, and all are finite. As in most words they are, that is
 * asked once for all of them.
 */
TRIBOX_INLINE bool take_word(lane_extent *extent, const tribox_soup *soup, size_t first, size_t count)
{
    vnum u[9], lost = v_splat(0);
    size_t done = 0;
    for (; done + V_LANES <= count; done += V_LANES) {
        load_triangles(u, soup, first + done, V_LANES);
        lost = v_add(lost, lost_of_triangles(u));
        take_triangles(extent, u, m_none());
    }
    if (done == count && m_bits(v_is_zero(lost)) == LANES_ALL)
        return count == 64;
    take_finite(extent, soup, first, count);
    return false;
}

/* All children of a node. */
TRIBOX_INLINE void take_node(lane_extent *extent, const tribox_node *node)
{
    for (int c = 0; c < 64; c += V_LANES)
        for (int a = 0; a < 3; a++) {
            extent->bound[a] = v_min(v_load(node->bound[a] + c), extent->bound[a]);
            extent->bound[3 + a] = v_max(v_load(node->bound[3 + a] + c), extent->bound[3 + a]);
        }
}

/* The extents of V_LANES children: bound k of child i, lane by lane. */
typedef struct lane_children {
    float bound[6][V_LANES][V_LANES];
} lane_children;

TRIBOX_INLINE void put_child(lane_children *children, int i, const lane_extent *extent)
{
    for (int k = 0; k < 6; k++)
        v_write(children->bound[k][i], extent->bound[k]);
}

/* In lane i, bound k of child i: across its lanes. */
TRIBOX_INLINE vnum across_lanes(const lane_children *children, int k)
{
    vnum bound = v_splat(k < 3 ? INFINITY : -INFINITY);
    if (V_LANES == 1)
        return v_load(children->bound[k][0]);
    for (int lane = 0; lane < V_LANES; lane += 4) {
        const void *row[V_LANES];
        vnum four[4];
        for (int i = 0; i < V_LANES; i++)
            row[i] = &children->bound[k][i][lane];
        v_transpose4(row, four);
        for (int i = 0; i < 4; i++)
            bound = k < 3 ? v_min(four[i], bound) : v_max(four[i], bound);
    }
    return bound;
}

/* Children `first` to first + V_LANES - 1 of a node. */
TRIBOX_INLINE void put_children(tribox_node *node, int first, const lane_children *children)
{
    for (int k = 0; k < 6; k++)
        v_write(node->bound[k] + first, v_add(across_lanes(children, k), v_splat(0))); /* -0 becomes +0 */
}

static void bound_words(const tribox_soup *soup, size_t first, int child, int end, tribox_node *node)
{
    for (int c = child; c < end; c += V_LANES) {
        lane_children children;
        uint64_t whole = 0;
        for (int i = 0; i < V_LANES; i++) {
            const size_t at = 64 * (first + (size_t)(c - child + i)), left = at < soup->count ? soup->count - at : 0;
            lane_extent extent = no_extent();
            whole |= (uint64_t)take_word(&extent, soup, at, left < 64 ? left : 64) << i;
            put_child(&children, i, &extent);
        }
        node->whole = (node->whole & ~(LANES_ALL << c)) | whole << c;
        put_children(node, c, &children);
    }
}

static void bound_nodes(const void *nodes, size_t count, tribox_node *node)
{
    *node = (tribox_node){.whole = 0};
    for (int c = 0; c < 64; c += V_LANES) {
        lane_children children;
        for (int i = 0; i < V_LANES; i++) {
            lane_extent extent = no_extent();
            if ((size_t)(c + i) < count) {
                tribox_node child; /* aligned */
                memcpy(&child, (const char *)nodes + sizeof child * (size_t)(c + i), sizeof child);
                take_node(&extent, &child);
                node->whole |= (uint64_t) !~child.whole << (c + i);
            }
            put_child(&children, i, &extent);
        }
        put_children(node, c, &children);
    }
}
