/*
 * rows.h - limits of a strip of triangles, in double, and of one of them on many rows at a time.
 * After: limits.h, voxelizing.h. Needs: v_read, v_write_int.
 */

/* As in limits.h, of each triangle. */
typedef struct strip_limit {
    double slope[TRIBOX_STRIP], maybe[TRIBOX_STRIP], certain[TRIBOX_STRIP];
} strip_limit;

typedef struct strip_plane {
    double end_maybe[TRIBOX_STRIP], first_maybe[TRIBOX_STRIP], end_certain[TRIBOX_STRIP], first_certain[TRIBOX_STRIP];
    double j_slope[TRIBOX_STRIP], k_slope[TRIBOX_STRIP];
} strip_plane;

/* Those that a shape needs. [0]: of the shadow along x, on j by k; [1]: along y, on i by k; [2]: along z, on i by j. */
typedef struct strip_limits {
    strip_limit upper[3][2], lower[3][2];
    strip_plane plane; /* on i by both */
} strip_limits;

/* Whether the shadow along i limits a shape. */
TRIBOX_INLINE bool is_limited(tribox_shape shape, int i) { return shape == TRIBOX_SOLID || (int)shape == TRIBOX_FLAT_X + i; }

TRIBOX_INLINE lane_places strip_places(const tribox_strip *strip, unsigned at, const tribox_lattice *lattice, int a)
{
    const vnum u[3] = {v_read(&strip->u[3 * a][at]), v_read(&strip->u[3 * a + 1][at]), v_read(&strip->u[3 * a + 2][at])};
    return places_of(u, v_read(&strip->base[a][at]), v_read(&strip->cells[a][at]), v_splat(lattice->origin[a]),
                     v_splat(lattice->per_cell[a]), v_splat(lattice->error[a]));
}

/* One triangle. Its layers from `first` to before `end`, counted from its own first, are asked. */
typedef struct strip_place {
    tribox_voxels *v;
    const tribox_strip *strip;
    const strip_limits *limits;
    unsigned t;
    int64_t first, end;
} strip_place;

TRIBOX_INLINE void write_limit(strip_limit *limit, unsigned at, const shadow_limit *from)
{
    v_write(&limit->slope[at], from->slope);
    v_write(&limit->maybe[at], from->maybe);
    v_write(&limit->certain[at], from->certain);
}

TRIBOX_INLINE void write_plane(strip_plane *plane, unsigned at, const plane_limits *from)
{
    v_write(&plane->end_maybe[at], from->end_maybe);
    v_write(&plane->first_maybe[at], from->first_maybe);
    v_write(&plane->end_certain[at], from->end_certain);
    v_write(&plane->first_certain[at], from->first_certain);
    v_write(&plane->j_slope[at], from->j_slope);
    v_write(&plane->k_slope[at], from->k_slope);
}

TRIBOX_INLINE void prepare_limits(const tribox_strip *strip, const tribox_lattice *lattice, unsigned axes, double bound_scale,
                                  strip_limits *limits, tribox_shape shape)
{
    static const int axis_q[3] = {1, 0, 0}, axis_p[3] = {2, 2, 1};
    const vnum scale = v_splat(bound_scale);
    const vmask has_edges = axes & TRIBOX_AXES_EDGES ? m_all() : m_none(),
                has_plane = axes & TRIBOX_AXES_PLANE ? m_all() : m_none();
    for (unsigned at = 0; at < strip->count; at += V_LANES) {
        lane_places p[3];
        for (int a = 0; a < 3; a++)
            p[a] = strip_places(strip, at, lattice, a);
        for (int i = 0; i < 3; i++) {
            if (!is_limited(shape, i))
                continue;
            const shadow_limits of_shadow = limits_of(&p[axis_q[i]], &p[axis_p[i]], scale, has_edges);
            for (int e = 0; e < 2; e++) {
                write_limit(&limits->upper[i][e], at, &of_shadow.upper[e]);
                write_limit(&limits->lower[i][e], at, &of_shadow.lower[e]);
            }
        }
        if (shape == TRIBOX_SOLID) {
            const plane_limits plane = plane_of(p, scale, has_plane);
            write_plane(&limits->plane, at, &plane);
        }
    }
}

TRIBOX_INLINE shadow_limit splat_limit(const strip_limit *limit, unsigned t)
{
    return (shadow_limit){v_splat(limit->slope[t]), v_splat(limit->maybe[t]), v_splat(limit->certain[t])};
}

/* By triangle t's shadow along i, in rows p. */
TRIBOX_INLINE void narrow_by_shadow(lane_run *run, const strip_limits *limits, unsigned t, int i, vnum p, bool has_certain)
{
    const shadow_limits of_shadow = {{splat_limit(&limits->upper[i][0], t), splat_limit(&limits->upper[i][1], t)},
                                     {splat_limit(&limits->lower[i][0], t), splat_limit(&limits->lower[i][1], t)}};
    narrow(run, &of_shadow, p, has_certain);
}

TRIBOX_INLINE void narrow_by_plane(lane_run *run, const strip_plane *plane, unsigned t, vnum j, vnum k)
{
    const plane_limits limits = {v_splat(plane->end_maybe[t]),     v_splat(plane->first_maybe[t]), v_splat(plane->end_certain[t]),
                                 v_splat(plane->first_certain[t]), v_splat(plane->j_slope[t]),     v_splat(plane->k_slope[t])};
    const lane_run left = run_by_plane(&limits, v_fma(limits.j_slope, j, v_mul(limits.k_slope, k)));
    run->end_maybe = v_min(run->end_maybe, left.end_maybe);
    run->first_maybe = v_max(run->first_maybe, left.first_maybe);
    run->end_certain = v_min(run->end_certain, left.end_certain);
    run->first_certain = v_max(run->first_certain, left.first_certain);
}

/* Whole cells, from first to before end: clamped once more, both lie in the run of `cells` whatever the limits (PROOFS.md 7.5). */
TRIBOX_INLINE void write_ends(int32_t *to_first, int32_t *to_end, vnum first, vnum end, vnum cells)
{
    const vnum half = v_splat(0.5);
    v_write_int(to_first, v_min(first, v_add(cells, half)));
    v_write_int(to_end, v_max(end, half));
}
