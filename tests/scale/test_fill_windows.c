/* test_fill_windows.c - parity of windows is that of the whole, by integers, and needs no triangle beside the window. */
#include <math.h>

#include "common/harness.h"
#include "fill_case.h"
#include "tribox_threads.h"

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

static bool bit(const uint64_t *row, uint32_t i) { return row[i / 64] >> i % 64 & 1; }

/* The cells of the surface in the window, with bits of any kind past them. */
static void take_surface(random_source *r, const fill_case *c, const tribox_window *w, uint64_t *to)
{
    const size_t row_words = (w->size[0] + 63) / 64, grid_words = (c->at.size[0] + 63) / 64;
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++) {
            const uint64_t *const from = c->occupied + ((w->first[2] + k) * c->at.size[1] + w->first[1] + j) * grid_words;
            uint64_t *const row = to + (k * w->size[1] + j) * row_words;
            memset(row, random_int(r, 2) ? 0xff : 0, row_words * sizeof *row);
            for (uint32_t i = 0; i < w->size[0]; i++)
                row[i / 64] = (row[i / 64] & ~(UINT64_C(1) << i % 64)) | (uint64_t)bit(from, w->first[0] + i) << i % 64;
        }
}

static void check_window(random_source *r, const fill_case *c, const tribox_window *w)
{
    const size_t words = tribox_window_words(w->size), bytes = words * sizeof(uint64_t), scratch_bytes = tribox_fill_bytes(w->size);
    const guarded walls = guarded_make(bytes), solid = guarded_make(bytes), scratch = guarded_make(scratch_bytes);
    uint64_t *const occupied = guarded_tail(walls, bytes), *const filled = guarded_tail(solid, bytes);
    size_t inside = SIZE_MAX, odd_rows = SIZE_MAX, all_inside = 0, all_odd = 0;
    take_surface(r, c, w, occupied);
    guarded_read_only(walls, true);
    memset(solid.first, 0xa5, solid.size);
    memset(scratch.first, 0x5a, scratch.size);
    cut_mesh(c, w, &cut);
    const fill_mesh mesh = fill_mesh_make(random_int(r, 2) ? &cut : c);
    void *const room = guarded_tail(scratch, scratch_bytes);
    assert_int_equal(c->is_double
                         ? tribox_mesh_fill_parity_window(&mesh.mesh, &c->grid, w, occupied, room, filled, &inside, &odd_rows)
                         : tribox_fill_parity_window(&mesh.soup, &c->grid, w, occupied, room, filled, &inside, &odd_rows),
                     TRIBOX_OK);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++) {
            const size_t whole_row = (w->first[2] + k) * c->at.size[1] + w->first[1] + j, row = k * w->size[1] + j;
            all_odd += is_odd[whole_row];
            for (uint32_t i = 0; i < (w->size[0] + 63) / 64 * 64; i++) {
                const size_t word = row * ((w->size[0] + 63) / 64);
                const bool is_cell = i < w->size[0], is_wall = is_cell && bit(occupied + word, i);
                const bool is = is_cell && !is_wall && is_inside[whole_row * c->at.size[0] + w->first[0] + i];
                all_inside += is;
                if (bit(filled + word, i) != (is || is_wall))
                    fail_msg("%s: cell %u of row %zu of the window is %s", doing, i, row, is ? "not filled" : "filled");
            }
        }
    if (inside != all_inside || odd_rows != all_odd)
        fail_msg("%s: %zu inside and %zu odd rows, not %zu and %zu", doing, all_inside, all_odd, inside, odd_rows);
    fill_mesh_free(mesh);
    guarded_free(walls);
    guarded_free(solid);
    guarded_free(scratch);
}

CASE(test_windows)
{
    random_source r = random_named(args.seed, "fill windows");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS) / (arguments_are_short(&args) ? 10 : 1); round++) {
        fill_case_draw(&r, round % fill_case_scenes(), &drawn);
        crossing_oracle(&drawn.at, is_inside, is_odd);
        for (int n = 0; n < WINDOWS; n++) {
            const tribox_window w = draw_window(&r, &drawn, n % 2);
            snprintf(doing, sizeof doing, "round %zu: %s, %d triangles, %s, window %u, %u, %u of %u x %u x %u", round, drawn.scene,
                     drawn.at.count, drawn.body, w.first[0], w.first[1], w.first[2], w.size[0], w.size[1], w.size[2]);
            check_window(&r, &drawn, &w);
        }
    }
}

/* Of a grid beyond one call, far behind a triangle whose rows it has. */
CASE(test_limits)
{
    const float corner[9] = {2, 2, 2, 0, 4, 0, 0, 0, 4};
    const tribox_soup soup = {
        {corner, corner + 1, corner + 2}, {corner + 3, corner + 4, corner + 5}, {corner + 6, corner + 7, corner + 8}, 1};
    const tribox_grid vast = {{0, 0, 0}, {1, 1, 1}, {1 << 20, 1 << 20, 1 << 20}};
    const tribox_window some = {{1 << 19, 1, 1}, {64, 1, 2}};
    uint64_t occupied[2] = {0}, solid[2];
    unsigned char scratch[64];
    size_t inside;
    assert_int_equal(tribox_fill_parity_window(&soup, &vast, &some, occupied, scratch, solid, &inside, NULL), TRIBOX_OK);
    assert_true(inside + 64 * (size_t) !(solid[1] & 1) == 128 && solid[0] == ~UINT64_C(0));
}

PROGRAM(RUN(test_windows), RUN(test_limits))
