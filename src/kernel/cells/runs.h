/*
 * runs.h - what limits leave of rows of up to 32 cells, triangle by lane: cells as bits.
 * After: limits.h. Needs: the words of integers.
 */

/*
 * Those that float is too narrow for: longer than 64 cells, where the error bounds grow to a notable part of a cell, or with edges
 * shorter than 2^-40 cells, unless they are zero before they are scaled (PROOFS.md 7.9).
 */
TRIBOX_INLINE vmask is_wild(const vnum u[3], const lane_places *a)
{
    vmask wild = v_gt(a->F, v_splat(64));
    for (int j = 0; j < 3; j++)
        wild = m_or(wild, m_andnot(v_gt(v_splat(0x1p-40f), v_abs(a->f[j])), v_is_zero(v_sub(u[(j + 1) % 3], u[j]))));
    return wild;
}

/* The cells from `first` to before `end`, a bit each, of a run of at most 32 cells (whole_run). */
TRIBOX_INLINE vint run_bits(vnum first, vnum end) { return i_run(i_cut(v_min(first, v_splat(32))), i_cut(v_max(end, v_splat(0)))); }

/* Those that certainly overlap; or, unless is_exact, those that may. */
TRIBOX_INLINE vint set_bits(const lane_run *run, bool is_exact)
{
    return is_exact ? run_bits(run->first_certain, run->end_certain) : run_bits(run->first_maybe, run->end_maybe);
}

/* Lanes whose certain and possible runs differ. Says yes for a few that differ only outside the grid, too. */
TRIBOX_INLINE vmask has_open_ends(const lane_run *run)
{
    const vnum none = v_splat(0), most = v_splat(32);
    const vint first = i_sub(i_cut(v_min(run->first_certain, most)), i_cut(v_min(run->first_maybe, most)));
    const vint end = i_sub(i_cut(v_max(run->end_certain, none)), i_cut(v_max(run->end_maybe, none)));
    return m_has_bits(i_or(first, end));
}

/* What the limits leave of the first `cells` of row p. */
TRIBOX_INLINE lane_run run_within(const shadow_limits *limits, vnum cells, vnum p, bool is_exact)
{
    lane_run run = whole_run(cells);
    narrow(&run, limits, p, is_exact);
    return run;
}
