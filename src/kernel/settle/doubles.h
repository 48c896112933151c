/*
 * doubles.h - what the walks left undecided, in double: certain where a slack exceeds its error bound, or where nothing was
 * rounded. After: axes.h, bounds.h. Needs: KERNEL, inexact_flag.h.
 *
 * The processor's inexact flag shows for a whole packet at once that every slack is exact; then the signs decide ties as well. That
 * is for EXACT alone: CONSERVATIVE must give a pair the same answer whatever pairs share its packet (PROOFS.md 6.4). Where the flag
 * does not rise, short numbers show it lane by lane (6.5). Either only saves time. Otherwise redundant axes are left out (2), and
 * the rest are compared with the bounds of bounds.h (6.3).
 */

/* Nine edge slacks and the plane's; infinite for groups that axes leaves out. */
typedef struct lane_slacks {
    vnum edge[3][3]; /* edge[i][j]: axis a_ij */
    vnum plane;
} lane_slacks;

TRIBOX_INLINE lane_slacks slacks_of(const lane_shape *s, unsigned axes)
{
    lane_slacks slack;
    for (int i = 0; i < 3; i++) {
        edge_slacks edges = {{v_splat(INFINITY), v_splat(INFINITY), v_splat(INFINITY)}};
        if (axes & TRIBOX_AXES_EDGES) /* else they could only raise the flag */
            edges = edge_slacks_along(s, i, axes & TRIBOX_AXES_BOX);
        for (int j = 0; j < 3; j++)
            slack.edge[i][j] = edges.of[j];
    }
    slack.plane = axes & TRIBOX_AXES_PLANE ? plane_slack(s, plane_reach(s)) : v_splat(INFINITY);
    return slack;
}

TRIBOX_INLINE vmask is_zero(vnum a) { return m_not(v_gt(v_abs(a), v_splat(0))); }

/* Neither so small nor so large that products of three of them underflow or overflow: PROOFS.md 6.1. */
TRIBOX_INLINE vmask is_tame(vnum length)
{
    return m_or(is_zero(length), m_and(v_gt(length, v_splat(0x1p-200)), v_gt(v_splat(0x1p200), length)));
}

/*
 * The least of a slack plus or minus its bound, over all axes that are not redundant: where the bounds hold, negative in `most`
 * separates, and positive in `least` is an overlap.
 */
typedef struct lane_range {
    vnum least, most;
    vmask is_certain; /* the bounds hold */
} lane_range;

TRIBOX_INLINE void widen(lane_range *range, vnum slack, vnum error, vmask redundant)
{
    range->least = v_min(range->least, v_select(redundant, v_splat(INFINITY), v_sub(slack, error)));
    range->most = v_min(range->most, v_select(redundant, v_splat(INFINITY), v_add(slack, error)));
}

TRIBOX_INLINE lane_range range_of(const lane_slacks *slack, const lane_triangle *t, const lane_box *box, const lane_shape *s,
                                  bool is_box_asked)
{
    const lane_bounds bound = bounds_of(t, box);
    lane_range range = {v_splat(INFINITY), v_splat(INFINITY), m_all()};
    vmask is_flat = m_none();
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        for (int j = 0; j < 3; j++)
            widen(&range, slack->edge[i][j], bound.edges[i],
                  is_box_asked ? m_or(is_zero(s->f[j][a]), is_zero(s->f[j][b])) : m_none());
        is_flat = m_or(is_flat, is_zero(bound.F[i]));
        range.is_certain = m_and(range.is_certain, m_and(is_tame(bound.F[i]), is_tame(bound.m[i])));
    }
    widen(&range, slack->plane, bound.plane, is_box_asked ? is_flat : m_none());
    return range;
}

TRIBOX_INLINE vnum least_slack(const lane_slacks *slack)
{
    vnum least = slack->plane;
    for (int i = 0; i < 3; i++)
        least = v_min(lane_min3(slack->edge[i][0], slack->edge[i][1], slack->edge[i][2]), least);
    return least;
}

/* A vertex in the closed box is a common point, whatever the axes. A shortcut: the slacks find every overlap without it. */
TRIBOX_INLINE vmask has_vertex_inside(const lane_triangle *t, const lane_box *box)
{
    vmask inside = m_none();
    for (int j = 0; j < 3; j++) {
        vmask outside = m_none();
        for (int a = 0; a < 3; a++)
            outside = m_or(outside, m_or(v_gt(box->lo[a], t->u[j][a]), v_gt(t->u[j][a], box->hi[a])));
        inside = m_or(inside, m_not(outside));
    }
    return inside;
}

/*
 * Zero times a number is zero, and NaN if it is not finite: never inexact. Edges of finite doubles may overflow, so vertices are
 * asked.
 */
TRIBOX_INLINE vmask is_finite_triangle(const lane_triangle *t)
{
    vnum sum = v_splat(0);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            sum = v_fma(v_splat(0), t->u[j][a], sum);
    return v_gt(v_splat(1), sum);
}

/* What is lost of the size of a number where it is added to one so far from zero. */
TRIBOX_INLINE vnum lost_beside(vnum a, vnum far_away)
{
    const vnum size = v_abs(a);
    return v_abs(v_sub(size, v_sub(v_add(size, far_away), far_away)));
}

/*
 * The lanes whose numbers are so short that nothing of them is rounded: all are multiples of one power of two, and no distance
 * between a point of the triangle and a point of the box on an axis reaches 2^16 of it (PROOFS.md 6.5).
 */
TRIBOX_INLINE vmask has_short_numbers(const lane_triangle *t, const lane_box *box)
{
    vnum longest = v_splat(0), lost = v_splat(0);
    for (int a = 0; a < 3; a++) {
        const vnum least = lane_min3(t->u[0][a], t->u[1][a], t->u[2][a]), most = lane_max3(t->u[0][a], t->u[1][a], t->u[2][a]);
        longest = v_max(longest, v_max(v_sub(most, box->lo[a]), v_sub(box->hi[a], least)));
    }
    const vnum far_away = v_mul(v_splat(0x1p37), longest);
    for (int a = 0; a < 3; a++)
        lost = v_add(lost, lost_beside(t->u[0][a], far_away));
    if (!m_bits(is_zero(lost))) /* most numbers are long, and one vertex shows it */
        return m_none();
    for (int a = 0; a < 3; a++)
        lost = v_add(lost, v_add(v_add(lost_beside(t->u[1][a], far_away), lost_beside(t->u[2][a], far_away)),
                                 v_add(lost_beside(box->lo[a], far_away), lost_beside(box->hi[a], far_away))));
    return m_and(is_zero(lost), is_tame(longest));
}

/* Whether the flag rises in this kernel's own arithmetic: a product and a sum that have to be rounded, fused or not. */
TRIBOX_INLINE bool is_rounding_told(void)
{
    const volatile double odd = 1 + 0x1p-52;
    tribox_exactness_watch();
    const vnum a = v_splat(odd);
    return !tribox_exactness_kept(m_bits(v_gt(v_fma(a, a, a), a)));
}

/* How packets of a batch are found to be exact. */
typedef enum exactness { NOT_ASKED, BY_FLAG, BY_SHORT_NUMBERS } exactness;

/* One packet of the batch, from pair `at`. */
TRIBOX_INLINE tribox_verdict packet_in_double(const tribox_batch *batch, unsigned at, unsigned axes, exactness asked)
{
    lane_triangle t;
    lane_box box;
    lane_shape s;
    tribox_exactness_watch();
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            t.u[j][a] = v_read(&batch->number[3 * a + j][at]);
        set_bounds(&box, a, v_read(&batch->number[9 + a][at]), v_read(&batch->number[12 + a][at]));
        shape_axis(&s, &t, &box, a);
    }
    shape_normal(&s);
    const lane_slacks slack = slacks_of(&s, axes);
    const uint64_t negative = m_bits(v_gt(v_splat(0), least_slack(&slack)));
    const uint64_t finite = m_bits(is_finite_triangle(&t));
    uint64_t exact = tribox_exactness_kept(negative) && asked == BY_FLAG ? LANES_ALL : 0;
    if (asked == BY_SHORT_NUMBERS)
        exact = m_bits(has_short_numbers(&t, &box));
    if (exact == LANES_ALL)
        return (tribox_verdict){finite & ~negative, 0, finite, 0};
    const lane_range range = range_of(&slack, &t, &box, &s, axes & TRIBOX_AXES_BOX);
    const vmask inside = has_vertex_inside(&t, &box), above = v_gt(range.least, v_splat(0)), below = v_gt(v_splat(0), range.most);
    const uint64_t apart = m_bits(m_and(range.is_certain, below));
    const uint64_t overlapping = m_bits(m_or(m_and(range.is_certain, above), inside)) | (exact & ~negative);
    const uint64_t undecided = finite & ~(apart | overlapping | exact);
    return (tribox_verdict){finite & overlapping, undecided, finite, undecided & ~m_bits(range.is_certain)};
}

TRIBOX_INLINE void unpack(const tribox_packed *packed, tribox_batch *batch, unsigned count)
{
    for (int k = 0; k < 9; k++)
        for (unsigned at = 0; at < count; at += V_LANES)
            v_write(&batch->number[k][at], v_load(&packed->number[k][at]));
}

/* The flag is one for a packet: pairs that are undecided in company are asked once more, each alone. Integers take far longer. */
TRIBOX_NOINLINE void settle_alone(const tribox_batch *batch, unsigned axes, tribox_verdict *all)
{
    tribox_batch one;
    for (uint64_t left = all->undecided; left; left &= left - 1) {
        const unsigned i = tribox_lowest_bit(left);
        for (int k = 0; k < 15; k++)
            v_write(one.number[k], v_splat(batch->number[k][i]));
        const tribox_verdict alone = packet_in_double(&one, 0, axes, BY_FLAG);
        if (alone.undecided)
            continue;
        const uint64_t bit = UINT64_C(1) << i;
        all->undecided &= ~bit;
        all->wild &= ~bit;
        all->overlapping |= alone.overlapping & 1 ? bit : 0;
    }
}

static tribox_verdict in_double(tribox_batch *batch, const tribox_packed *packed, unsigned count, unsigned axes, bool is_exact)
{
    if (packed)
        unpack(packed, batch, count);
    const exactness asked = !is_exact ? NOT_ASKED : is_rounding_told() ? BY_FLAG : BY_SHORT_NUMBERS;
    tribox_verdict all = {0, 0, 0, 0};
    for (unsigned at = 0; at < count; at += V_LANES) {
        const tribox_verdict packet = packet_in_double(batch, at, axes, asked);
        all.overlapping |= packet.overlapping << at;
        all.undecided |= packet.undecided << at;
        all.finite |= packet.finite << at;
        all.wild |= packet.wild << at;
    }
    const uint64_t present = ~UINT64_C(0) >> (TRIBOX_BATCH - count);
    all = (tribox_verdict){all.overlapping & present, all.undecided & present, all.finite & present, all.wild & present};
    if (asked == BY_FLAG && all.undecided && V_LANES > 1)
        settle_alone(batch, axes, &all);
    return all;
}
