/*
 * fill_labels.c - which free cells of a part of a grid are connected within it: labels of those that reach its faces, so that parts
 * are joined by their faces alone.
 */
#include "fill_runs.h"
#include "tribox_threads.h"

/* At a root that reaches a face, until it has its label. */
static const uint32_t is_at_face = UINT32_C(1) << 31;

/* Two rows of runs that are next to each other: those that have cells side by side are one. */
static void join_run_rows(uint32_t *parents, const tribox_run *a, uint32_t first_a, size_t count_a, const tribox_run *b,
                          uint32_t first_b, size_t count_b)
{
    for (size_t m = 0, n = 0; m < count_a && n < count_b;) {
        if (a[m].from < b[n].end && b[n].from < a[m].end)
            tribox_set_join(parents, first_a + (uint32_t)m, first_b + (uint32_t)n);
        if (a[m].end < b[n].end)
            m++;
        else
            n++;
    }
}

/* The runs of a row, after those of rows before it in the layer. Returns how many they are. */
static size_t find_runs(tribox_runs *r, size_t row, tribox_run *to)
{
    const tribox_run_row cells = tribox_run_row_of(r, row);
    const uint32_t first = r->first[row];
    size_t count = 0;
    for (uint32_t at = 0; tribox_run_next(&cells, at, &to[count]); count++) {
        at = to[count].end;
        r->parents[first + count] = first + (uint32_t)count;
    }
    r->first[row + 1] = first + (uint32_t)count;
    return count;
}

/* Whether a row has the words of the row before it in its layer. */
static bool is_as_before(const tribox_runs *r, size_t row)
{
    const uint64_t *const words = r->occupied + row * r->rows.words, *const before = words - r->rows.words;
    uint64_t differ = 0;
    for (size_t w = 0; w < r->rows.words && !differ; w++)
        differ = words[w] ^ before[w];
    return !differ;
}

/* Then its runs are those of that row, each joined with its own. */
static void repeat_row(tribox_runs *r, size_t row, tribox_run *spans)
{
    const uint32_t first = r->first[row], count = first - r->first[row - 1];
    memcpy(spans, spans - count, count * sizeof *spans);
    memcpy(r->parents + first, r->parents + first - count, count * sizeof *r->parents);
    r->first[row + 1] = first + count;
}

/* Row j of layer k, to the rows before it on both axes: where all four are the same in pairs, the rows before are joined. */
static void join_row(tribox_runs *r, size_t j, size_t k)
{
    const size_t lines = r->size[1], row = k * lines + j;
    const uint32_t *const first = r->first;
    const tribox_run *const before = r->spans[(k + 1) % 2] + (k ? first[row - lines] - first[(k - 1) * lines] : 0);
    tribox_run *const spans = r->spans[k % 2] + (first[row] - first[k * lines]);
    const bool is_repeated = j && is_as_before(r, row);
    if (is_repeated)
        repeat_row(r, row, spans);
    if (is_repeated && (!k || is_as_before(r, row - lines)))
        return;
    const size_t count = is_repeated ? first[row + 1] - first[row] : find_runs(r, row, spans);
    if (j && !is_repeated)
        join_run_rows(r->parents, spans, first[row], count, spans - (first[row] - first[row - 1]), first[row - 1],
                      first[row] - first[row - 1]);
    if (k)
        join_run_rows(r->parents, spans, first[row], count, before, first[row - lines],
                      first[row - lines + 1] - first[row - lines]);
}

static void mark(uint32_t *parents, uint32_t run) { parents[parents[run] & ~is_at_face] |= is_at_face; }

static bool is_rim(const tribox_runs *r, size_t row)
{
    const size_t j = row % r->size[1], k = row / r->size[1];
    return j == 0 || k == 0 || j + 1 == r->size[1] || k + 1 == r->size[2];
}

static bool is_free_at(const tribox_runs *r, size_t row, uint32_t cell)
{
    return !(r->occupied[row * r->rows.words + cell / 64] >> cell % 64 & 1);
}

/* Runs at faces; of rows within, those that begin or end there. */
static void mark_row(tribox_runs *r, size_t row)
{
    const uint32_t from = r->first[row], end = r->first[row + 1];
    if (is_rim(r, row)) {
        for (uint32_t run = from; run < end; run++)
            mark(r->parents, run);
        return;
    }
    if (is_free_at(r, row, 0))
        mark(r->parents, from);
    if (is_free_at(r, row, r->size[0] - 1))
        mark(r->parents, end - 1);
}

/* Every run has its root for a parent, as that comes before it; then its label. */
static uint32_t label_runs(tribox_runs *r)
{
    uint32_t *const parents = r->parents, runs = r->first[r->rows.count];
    uint32_t labels = 0;
    for (uint32_t run = 0; run < runs; run++)
        parents[run] = parents[parents[run]];
    for (size_t row = 0; row < r->rows.count; row++)
        mark_row(r, row);
    for (uint32_t run = 0; run < runs; run++) {
        const uint32_t root = parents[run] & ~is_at_face;
        parents[run] = root != run ? parents[root] : parents[run] & is_at_face ? labels++ : TRIBOX_NO_LABEL;
    }
    return labels;
}

/* ------------------------------------------------------------------------------------------------------------------------ faces */

/* A row in a face, at every `step`-th place. */
static void write_row_labels(const tribox_runs *r, size_t row, uint32_t *face)
{
    const tribox_run_row cells = tribox_run_row_of(r, row);
    tribox_run run = {0, 0};
    uint32_t number = r->first[row];
    for (uint32_t i = 0; i < r->size[0]; i++)
        face[i] = TRIBOX_NO_LABEL;
    for (uint32_t at = 0; tribox_run_next(&cells, at, &run); at = run.end, number++)
        for (uint32_t i = run.from; i < run.end; i++)
            face[i] = r->parents[number];
}

static void write_end_labels(const tribox_runs *r, size_t row, uint32_t *const faces[6])
{
    if (faces[0])
        faces[0][row] = is_free_at(r, row, 0) ? r->parents[r->first[row]] : TRIBOX_NO_LABEL;
    if (faces[1])
        faces[1][row] = is_free_at(r, row, r->size[0] - 1) ? r->parents[r->first[row + 1] - 1] : TRIBOX_NO_LABEL;
}

static void write_faces(const tribox_runs *r, uint32_t *const faces[6])
{
    const size_t x = r->size[0], lines = r->size[1], layers = r->size[2];
    for (size_t row = 0; row < r->rows.count; row++)
        write_end_labels(r, row, faces);
    for (size_t k = 0; k < layers; k++) {
        if (faces[2])
            write_row_labels(r, k * lines, faces[2] + k * x);
        if (faces[3])
            write_row_labels(r, (k + 1) * lines - 1, faces[3] + k * x);
    }
    for (size_t j = 0; j < lines; j++) {
        if (faces[4])
            write_row_labels(r, j, faces[4] + j * x);
        if (faces[5])
            write_row_labels(r, (layers - 1) * lines + j, faces[5] + j * x);
    }
}

/* ------------------------------------------------------------------------------------------------------------------------ calls */

size_t tribox_fill_labels_bytes(const uint32_t size[3])
{
    return tribox_runs_are_served(size) ? tribox_runs_bytes(size) : SIZE_MAX;
}

tribox_status tribox_fill_labels(const uint32_t size[3], const uint64_t *occupied, void *scratch, uint32_t *const faces[6],
                                 uint32_t *count)
{
    if (!size || !occupied || !scratch || !faces || !count)
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_runs_are_served(size))
        return TRIBOX_BAD_GRID;
    tribox_runs r = tribox_runs_in(size, occupied, scratch);
    r.first[0] = 0;
    for (size_t k = 0; k < size[2]; k++)
        for (size_t j = 0; j < size[1]; j++)
            join_row(&r, j, k);
    *count = label_runs(&r);
    write_faces(&r, faces);
    if (r.first != scratch)
        memmove(scratch, r.first, (r.rows.count + 1 + r.first[r.rows.count]) * sizeof *r.first);
    return TRIBOX_OK;
}

tribox_status tribox_fill_join(uint32_t *parents, const uint32_t *a, uint32_t from_a, const uint32_t *b, uint32_t from_b,
                               size_t count)
{
    if (count && (!parents || !a))
        return TRIBOX_BAD_ARGUMENT;
    uint32_t last_a = TRIBOX_NO_LABEL, last_b = TRIBOX_NO_LABEL;
    for (size_t n = 0; n < count; n++) {
        const uint32_t of_b = b ? b[n] : 0;
        if (a[n] == TRIBOX_NO_LABEL || of_b == TRIBOX_NO_LABEL || (a[n] == last_a && of_b == last_b))
            continue;
        last_a = a[n];
        last_b = of_b;
        tribox_set_join(parents, from_a + last_a, from_b + last_b);
    }
    return TRIBOX_OK;
}

uint32_t tribox_fill_root(uint32_t *parents, uint32_t label) { return tribox_set_root(parents, label); }
