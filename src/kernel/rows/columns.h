/*
 * columns.h - what the projection along x leaves of each layer of a triangle: an interval of j. After: rows.h.
 *
 * Where the triangle is flat along x these are its cells, a column in each layer. Elsewhere they are rows (packed_rows.h).
 *
 * EXACT (`has_certain`) sets the cells that certainly overlap, and those that may wait. The others set all that may.
 */
/* The intervals of V_LANES layers: from first to before end, none where end <= first. */
typedef struct layer_packet {
    int32_t first_maybe[V_LANES], end_maybe[V_LANES], first_certain[V_LANES], end_certain[V_LANES];
} layer_packet;

/* `first` and the next whole numbers. */
TRIBOX_INLINE vnum layers_from(int64_t first)
{
    static const float count[TRIBOX_DOUBLES_MAX] = {0, 1, 2, 3, 4, 5, 6, 7};
    return v_add(v_splat((double)first), v_load(count));
}

TRIBOX_INLINE void limit_layers(const strip_place *p, int64_t first, layer_packet *layers)
{
    const vnum wide = v_splat(p->strip->cells[1][p->t]), k = layers_from(first);
    lane_run run = whole_run(wide);
    narrow_by_shadow(&run, p->limits, p->t, 0, k, true);
    write_ends(layers->first_maybe, layers->end_maybe, run.first_maybe, run.end_maybe, wide);
    write_ends(layers->first_certain, layers->end_certain, run.first_certain, run.end_certain, wide);
}

/* Cells first to before end of row (j, k), all counted from the triangle's own first, wait. */
TRIBOX_NOINLINE void wait_for_row(const strip_place *p, int64_t first, int64_t end, int64_t j, int64_t k)
{
    const tribox_strip *const strip = p->strip;
    const int64_t base[3] = {(int64_t)strip->base[0][p->t], (int64_t)strip->base[1][p->t], (int64_t)strip->base[2][p->t]};
    tribox_triangle triangle = {.number = strip->number[p->t]};
    for (int n = 0; n < 9; n++)
        triangle.u[n] = strip->u[n][p->t];
    tribox_voxels_wait_for_row(p->v, &triangle, base[0] + first, base[0] + end - 1, base[1] + j, base[2] + k);
}

static void wait_for_layer_column(const strip_place *p, int64_t first, int64_t end, int64_t k)
{
    for (int64_t j = first; j < end; j++)
        wait_for_row(p, 0, 1, j, k);
}

/* Lists a column with the triangle. */
TRIBOX_NOINLINE void pair_column(const strip_place *p, int64_t word, int64_t count)
{
    for (int64_t n = 0; n < count; n++, word += (int64_t)p->v->sinks.row_words)
        tribox_voxels_pair(p->v, (size_t)word, UINT64_C(1) << p->strip->bit[p->t], p->strip->number[p->t]);
}

/* Returns how many cells of the column were not set before. */
TRIBOX_INLINE size_t set_column(const strip_place *p, int64_t first, int64_t end, int64_t k)
{
    const int64_t row = (int64_t)p->v->sinks.row_words, layer = row * p->v->window.size[1];
    if (first >= end)
        return 0;
    const int64_t word = p->strip->word[p->t] + (k - p->first) * layer + first * row;
    if (p->v->sinks.pairs) {
        pair_column(p, word, end - first);
        return 0;
    }
    if (p->v->sinks.ids.of)
        tribox_lower_column(&p->v->sinks.ids, p->v->sinks.occupied, (size_t)word, (unsigned)p->strip->bit[p->t], end - first,
                            tribox_voxels_id(p->v, p->strip->number[p->t]));
    return tribox_set_column(p->v->sinks.occupied + word, (size_t)row, end - first, UINT64_C(1) << p->strip->bit[p->t]);
}

TRIBOX_INLINE void set_columns(const strip_place *p, bool has_certain)
{
    size_t set = 0;
    for (int64_t k = p->first; k < p->end; k += V_LANES) {
        layer_packet layers;
        limit_layers(p, k, &layers);
        for (int n = 0; n < V_LANES && k + n < p->end; n++) {
            const int64_t first = layers.first_maybe[n], end = layers.end_maybe[n];
            const int64_t certain = layers.first_certain[n], certain_end = layers.end_certain[n];
            if (!has_certain) {
                set += set_column(p, first, end, k + n);
            } else if (certain < certain_end) {
                set += set_column(p, certain, certain_end, k + n);
                wait_for_layer_column(p, first, certain, k + n);
                wait_for_layer_column(p, certain_end, end, k + n);
            } else {
                wait_for_layer_column(p, first, end, k + n);
            }
        }
    }
    p->v->counts.overlapping += set;
}
