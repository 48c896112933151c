/* fill_labelled.c - a part of a grid whose free cells have labels: what the outside does not reach is solid. */
#include "fill_runs.h"
#include "tribox_threads.h"

/* Sets the bits of a run. */
static void close_run(uint64_t *solid, const tribox_run *run)
{
    const uint32_t first = run->from / 64, last = (run->end - 1) / 64;
    const uint64_t from = ~UINT64_C(0) << run->from % 64, to = ~UINT64_C(0) >> (63 - (run->end - 1) % 64);
    for (uint32_t w = first; w <= last; w++)
        solid[w] |= (w == first ? from : ~UINT64_C(0)) & (w == last ? to : ~UINT64_C(0));
}

/* What tribox_fill_labels leaves from the first byte of scratch on, which may have been moved: firsts of rows, then labels. */
static uint32_t number_in(const void *scratch, size_t n)
{
    uint32_t number;
    memcpy(&number, (const char *)scratch + n * sizeof number, sizeof number);
    return number;
}

/* Returns how many cells were filled. */
static size_t fill_labelled_row(const tribox_runs *r, size_t row, const void *scratch, const uint64_t *outside, uint64_t *solid)
{
    const tribox_run_row cells = tribox_run_row_of(r, row);
    tribox_run run = {0, 0};
    size_t number = r->rows.count + 1 + number_in(scratch, row);
    size_t inside = 0;
    for (size_t w = 0; w < r->rows.words; w++)
        solid[w] = cells.occupied[w] & tribox_row_mask(&r->rows, w);
    for (uint32_t at = 0; tribox_run_next(&cells, at, &run); at = run.end, number++) {
        const uint32_t label = number_in(scratch, number);
        if (label != TRIBOX_NO_LABEL && outside[label / 64] >> label % 64 & 1)
            continue;
        close_run(solid, &run);
        inside += run.end - run.from;
    }
    return inside;
}

tribox_status tribox_fill_labelled(const uint32_t size[3], const uint64_t *occupied, void *scratch, const uint64_t *outside,
                                   uint64_t *solid, size_t *inside)
{
    if (!size || !occupied || !scratch || !outside || !solid)
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_runs_are_served(size))
        return TRIBOX_BAD_GRID;
    const tribox_runs r = tribox_runs_in(size, occupied, scratch);
    size_t filled = 0;
    for (size_t row = 0; row < r.rows.count; row++)
        filled += fill_labelled_row(&r, row, scratch, outside, solid + row * r.rows.words);
    if (inside)
        *inside = filled;
    return TRIBOX_OK;
}
