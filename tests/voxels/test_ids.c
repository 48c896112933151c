/*
 * test_ids.c - the lowest number of a triangle for each cell, of every kind of triangle in every kind of grid, and in scenes that
 * are hard for doubles, against the oracle asked about each triangle alone: all kernels, in parts that come in any order, as soups
 * and meshes, in windows. By other axes and accuracies it is the lowest of those that set the bit alone.
 */
#include "cells.h"
#include "common/harness.h"
#include "common/window_bits.h"
#include "grid_kinds.h"
#include "triangle_kinds.h"

enum {
    PAIRS_A_ROUND = 50000,
    PAIRS_A_SCENE = 1000,
    CELLS_MAX = 4000,
    CELLS_F64 = 1000,
    ASKED_MAX = 8000,
    FEW = 40,
    MANY = 400,
    ID_CELLS = 20000,
    ID_NONE = -1
};

/* By z, y, x the lowest number of a triangle that is expected of each cell, or ID_NONE. */
static cells_case drawn;
static int64_t expected[ID_CELLS];
static uint64_t one[ID_CELLS];

static size_t cells_of(void) { return (size_t)drawn.at.size[0] * drawn.at.size[1] * drawn.at.size[2]; }

static bool is_set(const uint64_t *occupied, size_t cell)
{
    const size_t row = cell / drawn.at.size[0];
    return window_bit(drawn.at.size, occupied, cell % drawn.at.size[0], row % drawn.at.size[1], row / drawn.at.size[1]);
}

/* Of each triangle alone: the cells that overlap, or if the oracle is not asked those that are set. */
static void expect(bool is_by_oracle)
{
    assert_true(cells_of() <= ID_CELLS);
    for (size_t n = 0; n < cells_of(); n++)
        expected[n] = ID_NONE;
    for (size_t t = 0; t < drawn.count; t++) {
        if (is_by_oracle)
            cells_expect(&drawn, t, 1, TRIBOX_AXES_ALL, one);
        else
            cells_ask(&drawn, t, 1, one);
        for (size_t n = 0; n < cells_of(); n++)
            if (expected[n] == ID_NONE && is_set(one, n))
                expected[n] = (int64_t)t;
    }
}

/* One part or two, cut anywhere; the second may come before the first. Returns the cells that are new. */
static size_t ask_in_parts(random_source *r, uint32_t first, uint64_t *occupied, uint32_t *ids)
{
    const size_t middle = (size_t)random_int(r, (int)drawn.count + 1), cut[3] = {0, middle, drawn.count};
    const int parts = random_int_between(r, 1, 2), from = random_int(r, 2);
    size_t set = 0;
    for (int n = 0; n < parts; n++) {
        const size_t begin = cut[(n + from) % parts], end = parts == 1 ? drawn.count : cut[(n + from) % parts + 1];
        const soup_or_mesh of = cells_part(&drawn, begin, end - begin, permutations[0]);
        tribox_report report;
        assert_int_equal(
            CALL(voxelize_ids, &of, first + (uint32_t)begin, &drawn.grid, &drawn.at, &drawn.options, occupied, ids, &report),
            TRIBOX_OK);
        set += report.overlapping;
    }
    return set;
}

static void check_cells(uint32_t first, const uint64_t *occupied, const uint32_t *ids, const uint32_t *before, size_t set)
{
    size_t wanted = 0;
    for (size_t n = 0; n < cells_of(); n++) {
        const bool is_expected = expected[n] != ID_NONE;
        const uint32_t id = is_expected ? first + (uint32_t)expected[n] : before[n];
        wanted += is_expected;
        if (is_set(occupied, n) != is_expected || ids[n] != id)
            fail_msg("%s: cell %zu of window %u x %u x %u is %s with %u where %lld and %u are expected, first %u", doing, n,
                     (unsigned)drawn.at.size[0], (unsigned)drawn.at.size[1], (unsigned)drawn.at.size[2],
                     is_set(occupied, n) ? "set" : "clear", (unsigned)ids[n], (long long)expected[n], (unsigned)id,
                     (unsigned)first);
    }
    assert_int_equal(set, wanted);
}

/*
 * Asks for the triangles in parts, in any order, with numbers from anywhere, into memory that had anything and ends with a page.
 * Fails where bits, ids or the report are not as expected, or an id was written where no bit is.
 */
static void check(random_source *r)
{
    const size_t bytes = cells_of() * sizeof(uint32_t);
    const guarded g = guarded_make(bytes + 1);
    uint32_t *const ids = guarded_tail(g, bytes), *const before = malloc(bytes + 1), poison = (uint32_t)random_bits(r);
    uint64_t *const occupied = cells_make(cells_words(&drawn));
    const int kind = random_int(r, 4);
    const uint32_t last = UINT32_MAX - (uint32_t)drawn.count;
    const uint32_t first = random_int(r, 2) ? 0 : random_int(r, 2) ? last : poison % last;
    snprintf(doing, sizeof doing, "%s, form %d, accuracy %d, axes %u, kernel %s", drawn.scene, (int)drawn.form,
             (int)drawn.options.accuracy, drawn.options.axes, drawn.options.kernel);
    assert_non_null(before);
    for (size_t n = 0; n < cells_of(); n++)
        ids[n] = before[n] = kind == 0 ? 0 : kind == 1 ? UINT32_MAX : kind == 2 ? first : (uint32_t)random_bits(r);
    const size_t set = ask_in_parts(r, first, occupied, ids);
    check_cells(first, occupied, ids, before, set);
    free(occupied);
    free(before);
    guarded_free(g);
}

/* The whole, layers or any window. */
static void draw_window(random_source *r)
{
    const int kind = random_int(r, 3);
    cells_draw_window(&drawn, r);
    for (int a = 0; a < 3; a++)
        if (kind == 0 || (kind == 1 && a < 2)) {
            drawn.at.first[a] = 0;
            drawn.at.size[a] = drawn.grid.size[a];
        }
}

static void check_all(random_source *r)
{
    draw_window(r);
    expect(true);
    for (int kernel = 0; kernel < kernels; kernel++)
        for (drawn.form = drawn.is_double ? DOUBLES : SOUP; drawn.form < FORMS; drawn.form++) {
            drawn.options = (tribox_options){.kernel = names[kernel]};
            check(r);
        }
    drawn.form = SOUP;
    drawn.options.accuracy = (tribox_accuracy)random_int(r, 3);
    drawn.options.axes = (unsigned)random_int_between(r, 1, AXIS_SETS);
    drawn.options.kernel = names[random_int(r, kernels)];
    expect(false);
    check(r);
}

/* A mesh comes after the kinds of triangles; kinds of grids of doubles have any. */
CASE(test_kinds)
{
    for (size_t s = 0; s <= triangle_kind_count(); s++) {
        const triangle_kind *const kind = s < triangle_kind_count() ? triangle_kind_at(s) : NULL;
        random_source r = random_named(args.seed, kind ? kind->name : "mesh");
        for (size_t k = 0; k < grid_kind_floats() * arguments_rounds(&args, PAIRS_A_ROUND); k++) {
            draw_grid_of_kind(&r, grid_kind_at(k % grid_kind_floats()), CELLS_MAX, &drawn);
            if (kind)
                put_triangles(&r, kind, (size_t)(random_int(&r, 2) ? random_int_between(&r, 1, FEW) : MANY), ASKED_MAX, &drawn);
            else
                put_mesh(&r, &drawn);
            check_all(&r);
        }
    }
}

CASE(test_doubles)
{
    random_source r = random_named(args.seed, "doubles");
    for (size_t k = 0; k < grid_kind_count() * arguments_rounds(&args, PAIRS_A_SCENE); k++) {
        const size_t g = k % grid_kind_count();
        if (g < grid_kind_floats())
            continue;
        draw_grid_of_kind(&r, grid_kind_at(g), CELLS_F64, &drawn);
        put_triangles(&r, NULL, (size_t)random_int_between(&r, 1, random_int(&r, 2) ? 6 : 60), ASKED_MAX, &drawn);
        check_all(&r);
    }
}

PROGRAM(RUN(test_kinds), RUN(test_doubles))
