/*
 * undecided_rows.h - rows that have undecided cells, limited once more by their own planes. After: packed_rows.h.
 *
 * That pays where few have some; where most would, rows are limited by their own planes at once (columns.h, packed_rows.h).
 */

/* Rows that the shadow along x may, and those that it certainly does, leave. */
typedef struct rows_left {
    vmask maybe, certain;
} rows_left;

TRIBOX_INLINE vmask is_between(vnum first, vnum end, const row_planes *j)
{
    const vnum one = v_splat(1);
    return m_not(m_or(v_gt(v_add(j->lower, one), end), v_gt(first, v_add(j->upper, one))));
}

TRIBOX_INLINE rows_left rows_by_own(const strip_place *p, const row_planes *j, const row_planes *k)
{
    lane_run run = endless_run();
    narrow_by_own(&run, p->own, p->t, 0, k);
    return (rows_left){is_between(run.first_maybe, run.end_maybe, j), is_between(run.first_certain, run.end_certain, j)};
}

/* A packet of rows. */
TRIBOX_INLINE void limit_rows_by_own(const strip_place *p, row_list *rows, unsigned at, tribox_shape shape)
{
    const vnum cells = v_splat(p->strip->cells[0][p->t]), zero = v_splat(0);
    const row_planes j = planes_of_rows(p, 1, v_read(&rows->j[at])), k = planes_of_rows(p, 2, v_read(&rows->k[at]));
    lane_run run = rows_by_own_planes(p, p->own, cells, &j, &k, shape);
    if (shape == TRIBOX_SOLID) {
        const rows_left left = rows_by_own(p, &j, &k);
        run.end_maybe = v_select(left.maybe, run.end_maybe, zero);
        run.end_certain = v_select(left.certain, run.end_certain, zero);
    }
    write_ends(&rows->maybe.first[at], &rows->maybe.end[at], run.first_maybe, run.end_maybe, cells);
    write_ends(&rows->certain.first[at], &rows->certain.end[at], run.first_certain, run.end_certain, cells);
}

/* Those of the rows that have undecided cells. */
static void take_open_rows(const row_list *rows, row_list *undecided)
{
    undecided->count = 0;
    for (unsigned n = 0; n < rows->count; n++) {
        undecided->j[undecided->count] = rows->j[n];
        undecided->k[undecided->count] = rows->k[n];
        undecided->word[undecided->count] = rows->word[n];
        undecided->count += rows->maybe.first[n] < rows->maybe.end[n] &&
                            (rows->maybe.first[n] != rows->certain.first[n] || rows->maybe.end[n] != rows->certain.end[n]);
    }
    for (unsigned n = undecided->count; n % V_LANES; n++) {
        undecided->j[n] = undecided->j[undecided->count - 1];
        undecided->k[n] = undecided->k[undecided->count - 1];
    }
}

static void prepare_own(const strip_place *p, tribox_shape shape)
{
    const tribox_lattice lattice = lattice_by_own_planes(p->v);
    prepare_limits(p->strip, &lattice, p->v->plan.axes, 1, p->own, shape);
    *p->has_own = true;
}

/* Sets what is certain by now; what is undecided still waits. */
static void settle_undecided_rows(const strip_place *p, const row_list *rows, tribox_shape shape)
{
    row_list undecided;
    take_open_rows(rows, &undecided);
    if (!undecided.count)
        return;
    if (!*p->has_own)
        prepare_own(p, shape);
    for (unsigned at = 0; at < undecided.count; at += V_LANES)
        limit_rows_by_own(p, &undecided, at, shape);
    p->v->counts.overlapping += set_wide_rows(p->v->sinks.occupied, &undecided, &undecided.certain, p->strip->bit[p->t]);
    if (may_be_undecided(&undecided))
        wait_for_rows(p, &undecided);
}
