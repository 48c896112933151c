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
