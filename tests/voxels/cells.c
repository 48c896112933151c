#include "cells.h"

#include <float.h>
#include <math.h>

#include "cell_oracle.h"
#include "common/contact.h"
#include "common/guard.h"
#include "common/harness.h"
#include "common/laid_mesh.h"
#include "common/window_bits.h"

static const double band_of_cell = 0x1p-7, band_of_distance = 0x1p-40, band_of_planes = 4;

void cells_open(cells_case *c) { c->at = (tribox_window){{0, 0, 0}, {c->grid.size[0], c->grid.size[1], c->grid.size[2]}}; }

void cells_draw_window(random_source *r, const tribox_window *in, const uint32_t most[3], tribox_window *w)
{
    static const uint32_t lengths[] = {1, 2, 63, 64, 65, 130};
    for (int a = 0; a < 3; a++) {
        const uint32_t limit = most[a] < in->size[a] ? most[a] : in->size[a], beside = lengths[random_int(r, 6)];
        const bool is_beside = a == 0 && beside <= limit && random_int(r, 2);
        w->size[a] = is_beside ? beside : (uint32_t)random_below(r, limit) + 1;
        const uint32_t last = in->size[a] - w->size[a], anywhere = (uint32_t)random_below(r, (size_t)last + 1);
        const int way = random_int(r, 4);
        w->first[a] = in->first[a] + (way == 0 ? 0 : way == 1 ? last : anywhere);
        if (way == 2 && (anywhere | 63) + 2 <= last)
            w->first[a] = in->first[a] + (anywhere | 63) + (uint32_t)random_int(r, 3);
    }
}

size_t cells_words(const cells_case *c) { return tribox_window_words(c->at.size); }

double cells_place(const cells_case *c, int a, double p)
{
    const double place = plane_of(&c->grid, a, p);
    return !c->is_double ? (double)nearest_float(place) : fabs(place) <= DBL_MAX ? place : copysign(DBL_MAX, place);
}

tribox_box cells_box(const cells_case *c, const uint32_t at[3])
{
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = plane_of(&c->grid, a, (double)c->at.first[a] + at[a]);
        box.hi[a] = plane_of(&c->grid, a, (double)c->at.first[a] + at[a] + 1);
    }
    return box;
}

void cells_put(cells_case *c, double u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            c->stream[3 * a + j][c->count] = (float)u[j][a];
            c->u[c->count][j][a] = c->is_double ? u[j][a] : (double)(float)u[j][a];
        }
    c->count += c->count < CELLS_TRIANGLES - 1;
}

/* Meshes are laid out anew each time, in any way, into the same memory. */
static soup_or_mesh part_in_form(const cells_case *c, cells_form in, size_t first, size_t count)
{
    static laid_fences fences;
    static random_source r;
    const bool is_wide = c->is_double || in == DOUBLES;
    soup_or_mesh of = {.soup = soup_of_rows(c->stream[0] + first, CELLS_TRIANGLES, count), .is_mesh = is_wide || in != SOUP};
    if (!of.is_mesh)
        return of;
    if (!fences.positions.first)
        fences = laid_fences_make(args.seed);
    mesh_form form = mesh_form_draw(&r, !is_wide);
    form.position_bytes = !is_wide && form.position_bytes == 8 ? 4 : form.position_bytes;
    of.mesh = laid_mesh_of(&r, &form, c->u + first, count, permutations[0], fences);
    return of;
}

soup_or_mesh cells_part(const cells_case *c, size_t first, size_t count) { return part_in_form(c, c->form, first, count); }
soup_or_mesh cells_all(const cells_case *c) { return cells_part(c, 0, c->count); }

uint64_t *cells_make(size_t words)
{
    uint64_t *const occupied = calloc(words ? words : 1, sizeof *occupied);
    assert_non_null(occupied);
    return occupied;
}

/* Cells of the window, from `first` to before `end`. */
typedef struct block {
    uint32_t first[3], end[3];
} block;

/* Those of an axis that the triangle's bounding box touches, each plane looked at, and one more on each side. */
static bool touch(const cells_case *c, size_t t, int a, block *b)
{
    const double(*const u)[3] = c->u[t];
    const double least = fmin(fmin(u[0][a], u[1][a]), u[2][a]), most = fmax(fmax(u[0][a], u[1][a]), u[2][a]);
    double above = plane_of(&c->grid, a, c->at.first[a]);
    b->first[a] = c->at.size[a];
    b->end[a] = 0;
    for (uint32_t n = 0; n < c->at.size[a]; n++) {
        const double below = above;
        above = plane_of(&c->grid, a, (double)c->at.first[a] + n + 1);
        if (below > most || above < least)
            continue;
        b->first[a] = n < b->first[a] ? n : b->first[a];
        b->end[a] = n + 1;
    }
    if (!b->end[a])
        return false;
    b->first[a] -= b->first[a] > 0;
    b->end[a] += b->end[a] < c->at.size[a];
    return true;
}

static bool block_of(const cells_case *c, size_t t, unsigned axes, block *b)
{
    *b = (block){.end = {c->at.size[0], c->at.size[1], c->at.size[2]}};
    return are_finite(&c->u[t][0][0], 9) &&
           (!(axes & TRIBOX_AXES_BOX) || (touch(c, t, 0, b) && touch(c, t, 1, b) && touch(c, t, 2, b)));
}

size_t cells_cost(const cells_case *c, size_t t, unsigned axes)
{
    block b;
    return block_of(c, t, axes, &b) ? (size_t)(b.end[0] - b.first[0]) * (b.end[1] - b.first[1]) * (b.end[2] - b.first[2]) : 0;
}

size_t cells_expect(const cells_case *c, size_t first, size_t count, unsigned axes, uint64_t *occupied)
{
    size_t asked = 0;
    memset(occupied, 0, cells_words(c) * sizeof *occupied);
    for (size_t t = first; t < first + count; t++) {
        block b;
        uint32_t at[3];
        if (!block_of(c, t, axes, &b))
            continue;
        const cell_oracle triangle = cell_oracle_make(c->u[t]);
        for (at[2] = b.first[2]; at[2] < b.end[2]; at[2]++)
            for (at[1] = b.first[1]; at[1] < b.end[1]; at[1]++)
                for (at[0] = b.first[0]; at[0] < b.end[0]; at[0]++) {
                    const tribox_box box = cells_box(c, at);
                    if (window_bit(c->at.size, occupied, at[0], at[1], at[2]))
                        continue;
                    asked++;
                    if (cell_oracle_overlaps(&triangle, &box, axes))
                        window_put(c->at.size, occupied, at[0], at[1], at[2], true);
                }
    }
    return asked;
}

void cells_cut(const cells_case *c, const tribox_window *from, const uint64_t *all, uint64_t *occupied)
{
    const tribox_window *const w = &c->at;
    const uint32_t at[3] = {w->first[0] - from->first[0], w->first[1] - from->first[1], w->first[2] - from->first[2]};
    memset(occupied, 0, cells_words(c) * sizeof *occupied);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++)
                window_put(w->size, occupied, i, j, k, window_bit(from->size, all, at[0] + i, at[1] + j, at[2] + k));
}

static void tell(const cells_case *c, size_t first, size_t count)
{
    int length = snprintf(doing, sizeof doing, "%s, triangles %zu + %zu of %zu, form %d, %s, axes %u, kernel %s, cells", c->scene,
                          first, count, c->count, (int)c->form, accuracy_name(c->options.accuracy), c->options.axes,
                          c->options.kernel ? c->options.kernel : "of the library's choice");
    for (int a = 0; a < 3 && length < (int)sizeof doing; a++)
        length += snprintf(doing + length, sizeof doing - (size_t)length, " %u + %u of %u", (unsigned)c->at.first[a],
                           (unsigned)c->at.size[a], (unsigned)c->grid.size[a]);
}

/* The bits of a word that are no cells. */
static uint64_t past_row(const cells_case *c, size_t word)
{
    const uint32_t rest = c->at.size[0] % 64;
    return rest && (word + 1) % window_row(c->at.size) == 0 ? ~UINT64_C(0) << rest : 0;
}

/*
 * Against the page before and the page after in turn, often without a report, and of the whole grid without a window. Pages are
 * kept, so that few words cost little.
 */
static size_t add(const cells_case *c, cells_form in, size_t first, size_t count, uint64_t *occupied)
{
    static guarded pages;
    static unsigned turn;
    const soup_or_mesh of = part_in_form(c, in, first, count);
    const size_t words = cells_words(c), bytes = words * sizeof *occupied;
    tribox_report report = {SIZE_MAX, SIZE_MAX};
    uint64_t *to = guarded_room(&pages, bytes);
    to = ++turn % 2 ? to : (void *)pages.first;
    memcpy(to, occupied, bytes);
    tell(c, first, count);
    const bool is_whole = turn % 3 && !memcmp(c->at.first, (uint32_t[3]){0}, sizeof c->at.first) &&
                          !memcmp(c->at.size, c->grid.size, sizeof c->at.size);
    assert_int_equal(CALL(voxelize, &of, &c->grid, is_whole ? NULL : &c->at, &c->options, to, turn % 5 > 1 ? &report : NULL),
                     TRIBOX_OK);
    for (size_t w = 0; w < words; w++)
        if ((occupied[w] & ~to[w]) | (to[w] & ~occupied[w] & past_row(c, w)))
            fail_msg("%s: word %zu was %#llx and is %#llx", doing, w, (unsigned long long)occupied[w], (unsigned long long)to[w]);
    const size_t set = bits_set(to, words) - bits_set(occupied, words);
    if (turn % 5 > 1)
        assert_int_equal(report.overlapping, set);
    memcpy(occupied, to, bytes);
    return set;
}

/* A mesh of the same floats has the same bits at every accuracy, and EXACT one of doubles. */
size_t cells_add(const cells_case *c, size_t first, size_t count, uint64_t *occupied)
{
    enum { WORDS_MAX = 20000 };
    static uint64_t before[WORDS_MAX], same[WORDS_MAX];
    const size_t words = cells_words(c), bytes = words * sizeof *occupied;
    if (c->is_double || c->form != SOUP || words > WORDS_MAX)
        return add(c, c->form, first, count, occupied);
    memcpy(before, occupied, bytes);
    const size_t set = add(c, SOUP, first, count, occupied);
    for (cells_form in = MESH; in <= (c->options.accuracy ? MESH : DOUBLES); in++) {
        memcpy(same, before, bytes);
        add(c, in, first, count, same);
        if (memcmp(same, occupied, bytes))
            fail_msg("%s: form %d has other bits than the soup", doing, (int)in);
    }
    return set;
}

void cells_ask(const cells_case *c, size_t first, size_t count, uint64_t *occupied)
{
    memset(occupied, 0, cells_words(c) * sizeof *occupied);
    cells_add(c, first, count, occupied);
}

static unsigned axes_of(const cells_case *c) { return c->options.axes ? c->options.axes : TRIBOX_AXES_ALL; }

static void fail_cell(const cells_case *c, size_t first, size_t count, const uint32_t at[3], bool answer, const char *why)
{
    const tribox_box box = cells_box(c, at);
    tell(c, first, count);
    fprintf(stderr, "tribox_voxelize %s cell %u %u %u of the window: %s\n  %s, seed %llu\n", answer ? "sets" : "does not set",
            (unsigned)at[0], (unsigned)at[1], (unsigned)at[2], why, doing, (unsigned long long)args.seed);
    for (int a = 0; a < 3; a++)
        fprintf(stderr, "  %c   origin %a, cell %a\n", "xyz"[a], c -> grid.origin[a], c->grid.cell[a]);
    for (size_t t = first; t < first + count; t++) {
        const cell_oracle triangle = cell_oracle_make(c->u[t]);
        const bool is_one = are_finite(&c->u[t][0][0], 9) && cell_oracle_overlaps(&triangle, &box, axes_of(c));
        if (is_one || count == 1)
            cell_oracle_explain(stderr, &triangle, &box);
    }
    fail_msg("a cell of scene %s is wrong", c->scene);
}

/* The next cell whose bits differ, from *word on; false if there is none. */
static bool next_difference(const cells_case *c, const uint64_t *a, const uint64_t *b, size_t *word, uint64_t *seen, uint32_t at[3])
{
    for (; *word < cells_words(c); ++*word, *seen = 0) {
        const uint64_t rest = (a[*word] ^ b[*word]) & ~*seen;
        if (!rest)
            continue;
        const size_t row = *word / window_row(c->at.size);
        const int bit = __builtin_ctzll(rest);
        *seen |= UINT64_C(1) << bit;
        at[0] = (uint32_t)(*word % window_row(c->at.size) * 64) + (uint32_t)bit;
        at[1] = (uint32_t)(row % c->at.size[1]);
        at[2] = (uint32_t)(row / c->at.size[1]);
        return true;
    }
    return false;
}

void cells_check(const cells_case *c, size_t first, size_t count, const uint64_t *expected, const uint64_t *occupied)
{
    size_t word = 0;
    uint64_t seen = 0;
    uint32_t at[3];
    while ((c->is_double || c->options.accuracy != TRIBOX_FAST) && next_difference(c, expected, occupied, &word, &seen, at)) {
        const bool is_set = window_bit(c->at.size, occupied, at[0], at[1], at[2]);
        if (!is_set || c->options.accuracy == TRIBOX_EXACT)
            fail_cell(c, first, count, at, is_set, "the oracle says otherwise");
    }
}

/* At least the spacing of floats at a number. */
static double spacing_at(double number) { return 0x1p-23 * number + 0x1p-149; }

static void set_band(const cells_case *c, const tribox_box *box, size_t t, double band[3])
{
    for (int a = 0; a < 3; a++) {
        const double farthest = fmax(fabs(plane_of(&c->grid, a, 0)), fabs(plane_of(&c->grid, a, c->grid.size[a])));
        double distance = 0;
        for (int j = 0; j < 3; j++)
            distance = fmax(distance, fmax(fabs(c->u[t][j][a] - box->lo[a]), fabs(c->u[t][j][a] - box->hi[a])));
        band[a] = band_of_cell * (box->hi[a] - box->lo[a]) + band_of_distance * distance + band_of_planes * spacing_at(farthest);
    }
}

/* Whether some triangle excuses that the cell is set, or all that overlap it that it is not. */
static bool is_excused(const cells_case *c, const uint32_t at[3], bool answer)
{
    const tribox_box box = cells_box(c, at);
    for (size_t t = 0; t < c->count; t++) {
        double band[3];
        if (!are_finite(&c->u[t][0][0], 9))
            continue;
        set_band(c, &box, t, band);
        const cell_oracle triangle = cell_oracle_make(c->u[t]);
        if (!answer && !cell_oracle_overlaps(&triangle, &box, axes_of(c)))
            continue;
        if (cell_oracle_errs_within(&triangle, &box, axes_of(c), band, answer) == answer)
            return answer;
    }
    return !answer;
}

void cells_check_band(const cells_case *c, const uint64_t *exact, const uint64_t *occupied, tally *count)
{
    size_t word = 0;
    uint64_t seen = 0;
    uint32_t at[3];
    count->asked += bits_set(exact, cells_words(c));
    while (next_difference(c, exact, occupied, &word, &seen, at)) {
        const bool is_missed = window_bit(c->at.size, exact, at[0], at[1], at[2]);
        count->missed += is_missed;
        count->extra += !is_missed;
        if (is_missed && c->options.accuracy == TRIBOX_CONSERVATIVE)
            fail_cell(c, 0, c->count, at, false, "CONSERVATIVE never misses");
        if (!is_excused(c, at, !is_missed))
            fail_cell(c, 0, c->count, at, !is_missed, "that is farther from contact than the stated band");
    }
}
