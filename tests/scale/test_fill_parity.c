/*
 * test_fill_parity.c - what is filled are the cells whose middles have an odd number of crossings below them, by integers: of whole
 * grids, and of windows, which need no triangle beside them.
 */
#include <math.h>

#include "common/harness.h"
#include "common/window_bits.h"
#include "fill_case.h"

enum { PAIRS = 100000, ROUNDS = 150, WINDOWS = 6 };

static fill_case drawn, cut;
static bool is_inside[ORACLE_CELLS], is_odd[ORACLE_CELLS];

static tribox_window draw_window(random_source *r, const fill_case *c, bool is_of_rows)
{
    tribox_window w;
    for (int a = 0; a < 3; a++) {
        w.first[a] = (uint32_t)random_int(r, (int)c->at.size[a]);
        w.size[a] = (uint32_t)random_int_between(r, 1, (int)(c->at.size[a] - w.first[a]));
    }
    if (is_of_rows) {
        w.first[0] = 0;
        w.size[0] = c->at.size[0];
    }
    return w;
}

static double plane(const fill_case *c, int a, uint32_t p) { return fma(p, c->grid.cell[a], c->grid.origin[a]); }

/* Leaves out what cannot cross the rows of the window. */
static void cut_mesh(const fill_case *from, const tribox_window *w, fill_case *to)
{
    *to = *from;
    to->at.count = 0;
    for (int t = 0; t < from->at.count; t++) {
        bool is_beside = false;
        for (int a = 1; a < 3; a++) {
            const double u[3] = {from->at.u[t][0][a], from->at.u[t][1][a], from->at.u[t][2][a]};
            is_beside = is_beside || fmax(fmax(u[0], u[1]), u[2]) < plane(from, a, w->first[a]) ||
                        fmin(fmin(u[0], u[1]), u[2]) > plane(from, a, w->first[a] + w->size[a]);
        }
        if (!is_beside)
            memcpy(to->at.u[to->at.count++], from->at.u[t], sizeof from->at.u[t]);
    }
}

/* The cells of the surface in the window, or none, with bits of any kind past them. */
static void take_surface(random_source *r, const fill_case *c, const tribox_window *w, bool has_walls, uint64_t *to)
{
    const uint32_t *const at = w->first;
    memset(to, random_int(r, 2) ? 0xff : 0, tribox_window_words(w->size) * sizeof *to);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++)
                window_put(w->size, to, i, j, k, has_walls && window_bit(c->at.size, c->occupied, at[0] + i, at[1] + j, at[2] + k));
}

static void check_cells(const fill_case *c, const tribox_window *w, const uint64_t *walls, const uint64_t *filled, size_t inside,
                        size_t odd_rows)
{
    size_t all_inside = 0, all_odd = 0;
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++) {
            const size_t row = (w->first[2] + k) * c->at.size[1] + w->first[1] + j;
            all_odd += is_odd[row];
            for (uint32_t i = 0; i < 64 * window_row(w->size); i++) {
                const bool is_cell = i < w->size[0], is_wall = is_cell && window_bit(w->size, walls, i, j, k);
                const bool is = is_cell && !is_wall && is_inside[row * c->at.size[0] + w->first[0] + i];
                all_inside += is;
                if (window_bit(w->size, filled, i, j, k) != (is || is_wall))
                    fail_msg("%s: cell %u of row %zu is %s", doing, i, row, is ? "not filled" : "filled");
            }
        }
    if (inside != all_inside || odd_rows != all_odd)
        fail_msg("%s: %zu inside and %zu odd rows, not %zu and %zu", doing, all_inside, all_odd, inside, odd_rows);
}

/* Between pages that cannot be touched: a window, or the whole as one or without one. */
static void check_window(random_source *r, const fill_case *c, const tribox_window *w, bool is_whole, bool has_walls)
{
    const size_t bytes = tribox_window_words(w->size) * sizeof(uint64_t), scratch_bytes = tribox_fill_bytes(w->size);
    const guarded walls = guarded_make(bytes), solid = guarded_make(bytes), scratch = guarded_make(scratch_bytes);
    uint64_t *const occupied = guarded_tail(walls, bytes), *const filled = guarded_tail(solid, bytes);
    void *const room = guarded_tail(scratch, scratch_bytes);
    size_t inside = SIZE_MAX, odd_rows = SIZE_MAX;
    take_surface(r, c, w, has_walls, occupied);
    guarded_read_only(walls, true);
    memset(solid.first, 0xa5, solid.size);
    memset(scratch.first, 0x5a, scratch.size);
    cut_mesh(c, w, &cut);
    const fill_mesh mesh = fill_mesh_make(random_int(r, 2) ? &cut : c);
    assert_int_equal(is_whole ? CALL(fill_parity, &mesh.of, &c->grid, occupied, room, filled, &inside, &odd_rows)
                              : CALL(fill_parity_window, &mesh.of, &c->grid, w, occupied, room, filled, &inside, &odd_rows),
                     TRIBOX_OK);
    check_cells(c, w, occupied, filled, inside, odd_rows);
    if (is_whole && c->is_closed)
        assert_int_equal(odd_rows, 0);
    fill_mesh_free(mesh);
    guarded_free(walls);
    guarded_free(solid);
    guarded_free(scratch);
}

CASE(test_crossings)
{
    random_source r = random_named(args.seed, "fill parity");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS) / (arguments_are_short(&args) ? 10 : 1); round++) {
        fill_case_draw(&r, round % fill_case_scenes(), &drawn);
        crossing_oracle(&drawn.at, is_inside, is_odd);
        if (drawn.is_closed)
            fill_case_check_leaks(&drawn, drawn.occupied, is_inside);
        const tribox_window whole = {{0, 0, 0}, {drawn.at.size[0], drawn.at.size[1], drawn.at.size[2]}};
        for (int n = -2; n < WINDOWS; n++) {
            const tribox_window w = n < 0 ? whole : draw_window(&r, &drawn, n % 2);
            snprintf(doing, sizeof doing, "round %zu: %s, %d triangles, %s%s, window %u, %u, %u of %u x %u x %u", round,
                     drawn.scene, drawn.at.count, drawn.body, drawn.is_closed ? "" : ", open", w.first[0], w.first[1], w.first[2],
                     w.size[0], w.size[1], w.size[2]);
            if (n == -1)
                fill_case_shuffle(&r, &drawn);
            check_window(&r, &drawn, &w, n < 0, n != -1);
        }
    }
}

/* Of a grid beyond one call, far behind a triangle whose rows it has. */
CASE(test_limits)
{
    const float corner[9] = {2, 2, 2, 0, 4, 0, 0, 0, 4};
    const tribox_soup soup = soup_of_rows(corner, 1, 1);
    const tribox_grid vast = {{0, 0, 0}, {1, 1, 1}, {1 << 20, 1 << 20, 1 << 20}};
    const tribox_window some = {{1 << 19, 1, 1}, {64, 1, 2}};
    uint64_t occupied[2] = {0}, solid[2];
    unsigned char scratch[64];
    size_t inside;
    assert_int_equal(tribox_fill_parity_window(&soup, &vast, &some, occupied, scratch, solid, &inside, NULL), TRIBOX_OK);
    assert_true(inside + 64 * (size_t) !(solid[1] & 1) == 128 && solid[0] == ~UINT64_C(0));
}

PROGRAM(RUN(test_crossings), RUN(test_limits))
