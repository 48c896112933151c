/*
 * runs.h - what limits leave of rows of up to 32 cells, triangle by lane: cells as bits.
 * After: limits.h. Needs: the words of integers.
 */

/*
 * Those that float is too narrow for: longer than 2^20 cells, or with edges shorter than 2^-40 cells, unless they are zero before they
 * are scaled.
 */
TRIBOX_INLINE vmask is_wild(const vnum u[3], const lane_places *a)
{
    vmask wild = v_gt(a->F, v_splat(0x1p20f));
    for (int j = 0; j < 3; j++)
        wild = m_or(wild, m_andnot(v_gt(v_splat(0x1p-40f), v_abs(a->f[j])), v_is_zero(v_sub(u[(j + 1) % 3], u[j]))));
    return wild;
}

/* Cells of a row from `first` to before `end`, once their fractions are cut off: those that may overlap, and those that certainly do. */
typedef struct lane_run {
    vnum first_maybe, end_maybe, first_certain, end_certain;
} lane_run;

TRIBOX_INLINE lane_run whole_run(vnum cells)
{
    const vnum half = v_splat(0.5f), last = v_add(cells, half);
    return (lane_run){half, last, half, last};
}

/* What the limits leave of a run in row p. */
TRIBOX_INLINE void narrow(lane_run *run, const shadow_limits *limits, vnum p, bool is_exact)
{
    for (int j = 0; j < 2; j++) {
        const shadow_limit *const upper = &limits->upper[j], *const lower = &limits->lower[j];
        run->end_maybe = v_min(run->end_maybe, v_fma(upper->slope, p, upper->maybe));
        run->first_maybe = v_max(run->first_maybe, v_fma(lower->slope, p, lower->maybe));
        if (is_exact) {
            run->end_certain = v_min(run->end_certain, v_fma(upper->slope, p, upper->certain));
            run->first_certain = v_max(run->first_certain, v_fma(lower->slope, p, lower->certain));
        }
    }
}

/* Cells of a row, a bit each. */
typedef struct row_cells {
    vint maybe, certain;
} row_cells;

TRIBOX_INLINE vint run_bits(vnum first, vnum end)
{
    const vnum half = v_splat(0.5f);
    return i_andnot(i_ones_from(v_max(first, half)), i_ones_from(v_max(end, half)));
}

TRIBOX_INLINE row_cells cells_of(const lane_run *run, bool is_exact)
{
    row_cells cells;
    cells.maybe = run_bits(run->first_maybe, run->end_maybe);
    cells.certain = is_exact ? run_bits(run->first_certain, run->end_certain) : cells.maybe;
    return cells;
}

/* The cells that the limits leave of the first `cells` of row p. */
TRIBOX_INLINE row_cells cells_within(const shadow_limits *limits, vnum cells, vnum p, bool is_exact)
{
    lane_run run = whole_run(cells);
    narrow(&run, limits, p, is_exact);
    return cells_of(&run, is_exact);
}
