#include "window_f64.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/oracle_f64.h"
#include "common/window_bits.h"

void window_f64_open(window_f64 *w) { w->at = (tribox_window){{0, 0, 0}, {w->grid.size[0], w->grid.size[1], w->grid.size[2]}}; }

void window_f64_draw(window_f64 *w, random_source *r)
{
    for (int a = 0; a < 3; a++) {
        const int size = (int)w->grid.size[a];
        w->at.first[a] = (uint32_t)random_int(r, size);
        w->at.size[a] = (uint32_t)random_int_between(r, 1, size - (int)w->at.first[a]);
    }
}

size_t window_f64_words(const window_f64 *w) { return tribox_window_words(w->at.size); }

double window_f64_plane(const tribox_grid *grid, int a, double p) { return fma(p, grid->cell[a], grid->origin[a]); }

static pair_f64 pair_at(const window_f64 *w, size_t triangle, const uint32_t at[3])
{
    pair_f64 pair;
    memcpy(pair.u, w->triangle[triangle], sizeof pair.u);
    for (int a = 0; a < 3; a++) {
        pair.box.lo[a] = window_f64_plane(&w->grid, a, (double)w->at.first[a] + at[a]);
        pair.box.hi[a] = window_f64_plane(&w->grid, a, (double)w->at.first[a] + at[a] + 1);
    }
    return pair;
}

/* The cells of an axis that the triangle's bounding box touches, each looked at: from first to before end. */
typedef struct cells_touched {
    uint32_t first, end;
} cells_touched;

static cells_touched touched_by(const window_f64 *w, size_t triangle, int a)
{
    const double(*const u)[3] = (const double(*)[3])w->triangle[triangle];
    const double least = fmin(fmin(u[0][a], u[1][a]), u[2][a]), most = fmax(fmax(u[0][a], u[1][a]), u[2][a]);
    cells_touched touched = {w->at.size[a], 0};
    double above = window_f64_plane(&w->grid, a, w->at.first[a]);
    for (uint32_t i = 0; i < w->at.size[a]; i++) {
        const double below = above;
        above = window_f64_plane(&w->grid, a, (double)w->at.first[a] + i + 1);
        if (below > most || above < least)
            continue;
        touched.first = i < touched.first ? i : touched.first;
        touched.end = i + 1;
    }
    return touched;
}

size_t window_f64_expect(const window_f64 *w, size_t first, size_t count, unsigned axes, uint64_t *occupied)
{
    size_t asked = 0;
    uint32_t at[3];
    memset(occupied, 0, window_f64_words(w) * sizeof *occupied);
    for (size_t t = first; t < first + count; t++) {
        cells_touched in[3];
        for (int a = 0; a < 3; a++)
            in[a] = axes & TRIBOX_AXES_BOX ? touched_by(w, t, a) : (cells_touched){0, w->at.size[a]};
        for (at[2] = in[2].first; at[2] < in[2].end; at[2]++)
            for (at[1] = in[1].first; at[1] < in[1].end; at[1]++)
                for (at[0] = in[0].first; at[0] < in[0].end; at[0]++) {
                    uint64_t *const word = occupied + window_place(w->at.size, at[0], at[1], at[2]);
                    const pair_f64 pair = pair_at(w, t, at);
                    if (*word >> at[0] % 64 & 1)
                        continue;
                    asked++;
                    *word |= (uint64_t)oracle_answer_f64(&pair, axes) << at[0] % 64;
                }
    }
    return asked;
}

void window_f64_ask(const window_f64 *w, size_t first, size_t count, uint64_t *occupied)
{
    const size_t words = window_f64_words(w);
    const tribox_mesh mesh = {.positions = w->triangle + first, .vertices = 3 * count, .count = count, .position_bytes = 8};
    tribox_report report;
    size_t set = 0;
    memset(occupied, 0, words * sizeof *occupied);
    occupied[words] = UINT64_C(0x5555555555555555);
    assert_int_equal(tribox_mesh_voxelize(&mesh, &w->grid, &w->at, &w->options, occupied, &report), TRIBOX_OK);
    assert_true(occupied[words] == UINT64_C(0x5555555555555555));
    for (size_t k = 0; k < words; k++) {
        const uint64_t outside =
            w->at.size[0] % 64 && (k + 1) % window_row(w->at.size) == 0 ? ~UINT64_C(0) << w->at.size[0] % 64 : 0;
        assert_true((occupied[k] & outside) == 0);
        for (uint64_t left = occupied[k]; left; left &= left - 1)
            set++;
    }
    assert_int_equal(report.overlapping, set);
}

static void fail_cell(const window_f64 *w, size_t first, size_t count, const uint32_t at[3], bool answer)
{
    fprintf(stderr, "%s, seed %llu, kernel %s, accuracy %d, axes %u, triangles %zu to %zu: cell %u %u %u is %s\n", w->scene,
            (unsigned long long)w->seed, w->options.kernel, (int)w->options.accuracy, w->options.axes, first, first + count - 1,
            (unsigned)at[0], (unsigned)at[1], (unsigned)at[2], answer ? "set" : "not set");
    for (int a = 0; a < 3; a++)
        fprintf(stderr, "  %c   origin %a, cell %a, size %u, window %u + %u\n", "xyz"[a], w -> grid.origin[a], w->grid.cell[a],
                (unsigned)w->grid.size[a], (unsigned)w->at.first[a], (unsigned)w->at.size[a]);
    for (size_t t = first; t < first + count; t++) {
        const pair_f64 pair = pair_at(w, t, at);
        const unsigned axes = w->options.axes ? w->options.axes : TRIBOX_AXES_ALL;
        if (oracle_answer_f64(&pair, axes) || count == 1)
            oracle_explain_f64(stderr, &pair);
    }
    fail();
}

void window_f64_check(const window_f64 *w, size_t first, size_t count, const uint64_t *expected, const uint64_t *occupied,
                      bool is_exact)
{
    uint32_t at[3];
    for (at[2] = 0; at[2] < w->at.size[2]; at[2]++)
        for (at[1] = 0; at[1] < w->at.size[1]; at[1]++)
            for (at[0] = 0; at[0] < w->at.size[0]; at[0]++) {
                const bool is_set = window_bit(w->at.size, occupied, at[0], at[1], at[2]),
                           is_in = window_bit(w->at.size, expected, at[0], at[1], at[2]);
                if (is_exact ? is_set != is_in : is_in && !is_set)
                    fail_cell(w, first, count, at, is_set);
            }
}
