/* test_fill_thin.c - thin surfaces by integers, triangle by triangle; and that none leaks. */
#include <math.h>

#include "common/harness.h"
#include "common/window_bits.h"
#include "fill_case.h"

enum { PAIRS = 100000, ROUNDS = 40, CELLS = 2 * ORACLE_CELLS };

static fill_case drawn;
static bool expected[ORACLE_CELLS], is_inside[ORACLE_CELLS], is_odd[ORACLE_CELLS];

static size_t cell_of(const uint32_t size[3], const size_t at[3]) { return (at[2] * size[1] + at[1]) * size[0] + at[0]; }

/*
 * The lines along an axis, one triangle at a time, which crosses each once at the most: between which planes, the lowest moved
 * down?
 */
static void expect_along(const fill_case *c, int along)
{
    static crossing_case one, mirrored;
    static bool is_past[CELLS], is_odd_row[CELLS], is_below[CELLS];
    one.bits = c->at.bits;
    one.count = 1;
    for (int a = 0; a < 3; a++) {
        const int from = (along + a) % 3;
        one.size[a] = c->at.size[from] + !a;
        memcpy(one.middle[a], c->at.middle[from], sizeof one.middle[a]);
    }
    for (uint32_t p = 0; p < one.size[0]; p++)
        one.middle[0][p] = fma(p, c->grid.cell[along], c->grid.origin[along]);
    memcpy(&mirrored, &one, sizeof mirrored);
    mirrored.size[0] = 1;
    mirrored.middle[0][0] = -one.middle[0][0];
    for (int t = 0; t < c->at.count; t++) {
        for (int n = 0; n < 9; n++) {
            one.u[0][n / 3][n % 3] = c->at.u[t][n / 3][(along + n % 3) % 3];
            mirrored.u[0][n / 3][n % 3] = n % 3 ? one.u[0][n / 3][n % 3] : -one.u[0][n / 3][0];
        }
        crossing_oracle(&one, is_past, is_odd_row);
        crossing_oracle(&mirrored, is_below, is_odd_row);
        for (size_t row = 0; row < (size_t)one.size[1] * one.size[2]; row++)
            for (uint32_t i = 0; i + 1 < one.size[0]; i++) {
                size_t at[3];
                at[along] = i;
                at[(along + 1) % 3] = row % one.size[1];
                at[(along + 2) % 3] = row / one.size[1];
                const bool is_up_to = is_past[row * one.size[0] + i + 1]; /* in a mirror it is past the lowest plane, moved down */
                expected[cell_of(c->at.size, at)] |= is_up_to && (i ? !is_past[row * one.size[0] + i] : is_below[row]);
            }
    }
}

/* Cells of a window between pages that cannot be touched, which begin with `before`, a word for all. */
static void ask(const fill_case *c, const tribox_window *window, const tribox_options *options, uint64_t before, uint64_t *words,
                size_t *set)
{
    const size_t bytes = tribox_window_words(window ? window->size : c->grid.size) * sizeof *words;
    const guarded pages = guarded_make(bytes ? bytes : 1);
    uint64_t *const occupied = guarded_tail(pages, bytes);
    tribox_report report = {9, 9};
    memset(occupied, (int)before, bytes);
    const fill_mesh mesh = fill_mesh_make(c);
    assert_int_equal(CALL(voxelize_thin, &mesh.of, &c->grid, window, options, occupied, &report), TRIBOX_OK);
    assert_int_equal(report.undecided, 0);
    memcpy(words, occupied, bytes);
    *set = report.overlapping;
    fill_mesh_free(mesh);
    guarded_free(pages);
}

/* Each cell of the window, none past the last of a row, and their number. */
static void check_cells(const fill_case *c, const tribox_window *w, const uint64_t *words, size_t set)
{
    const uint32_t end = (w->size[0] + 63) / 64 * 64;
    size_t count = 0;
    for (size_t row = 0; row < (size_t)w->size[1] * w->size[2]; row++)
        for (uint32_t i = 0; i < end; i++) {
            const size_t at[3] = {i, row % w->size[1], row / w->size[1]};
            const size_t of_grid[3] = {w->first[0] + at[0], w->first[1] + at[1], w->first[2] + at[2]};
            const bool is_set = window_bit(w->size, words, at[0], at[1], at[2]), is_cell = i < w->size[0];
            count += is_set;
            if (is_set != (is_cell && expected[cell_of(c->at.size, of_grid)]))
                fail_msg("%s: cell %zu, %zu, %zu is %s", doing, of_grid[0], of_grid[1], of_grid[2], is_set ? "set" : "clear");
            if (is_set && !window_bit(c->at.size, c->occupied, of_grid[0], of_grid[1], of_grid[2]))
                fail_msg("%s: no triangle overlaps cell %zu, %zu, %zu", doing, of_grid[0], of_grid[1], of_grid[2]);
        }
    if (set != count)
        fail_msg("%s: %zu cells are said to be set, and %zu are", doing, set, count);
}

static tribox_window draw_window(random_source *r, const fill_case *c)
{
    tribox_window w;
    for (int a = 0; a < 3; a++) {
        w.first[a] = (uint32_t)random_below(r, c->at.size[a] + 1);
        w.size[a] = (uint32_t)random_below(r, c->at.size[a] - w.first[a] + 1);
    }
    return w;
}

static void draw_case(random_source *r, size_t round)
{
    fill_case_draw(r, round % fill_case_scenes(), &drawn);
    snprintf(doing, sizeof doing, "round %zu: %s, %d triangles, %s%s", round, drawn.scene, drawn.at.count, drawn.body,
             drawn.is_closed ? "" : ", open");
    memset(expected, 0, sizeof expected);
    for (int along = 0; along < 3; along++)
        expect_along(&drawn, along);
}

CASE(test_cells)
{
    static uint64_t words[CASE_WORDS_MAX];
    size_t set;
    random_source r = random_named(args.seed, "fill thin");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS) / (arguments_are_short(&args) ? 2 : 1); round++) {
        draw_case(&r, round);
        const tribox_window whole = {{0, 0, 0}, {drawn.at.size[0], drawn.at.size[1], drawn.at.size[2]}};
        const tribox_window part = draw_window(&r, &drawn);
        for (size_t k = 0; tribox_kernel_list(k); k++) {
            ask(&drawn, NULL, &(tribox_options){.kernel = tribox_kernel_list(k)}, 0, words, &set);
            check_cells(&drawn, &whole, words, set);
        }
        if (drawn.is_closed) {
            crossing_oracle(&drawn.at, is_inside, is_odd);
            fill_case_check_leaks(&drawn, words, is_inside);
        }
        ask(&drawn, &part, NULL, 0, words, &set);
        check_cells(&drawn, &part, words, set);
        fill_case_shuffle(&r, &drawn);
        ask(&drawn, &whole, NULL, 0, words, &set);
        check_cells(&drawn, &whole, words, set);
        ask(&drawn, &whole, NULL, 0xff, words, &set);
        assert_int_equal(set, 0);
    }
}

/* Tetrahedra with corners on planes that are neighbouring doubles, so that middles are planes. */
CASE(test_neighbouring_planes)
{
    static const uint32_t corners[] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
    const tribox_grid grid = {{1, 1, 1}, {0x1p-52, 0x1p-52, 0x1p-52}, {3, 3, 3}};
    random_source r = random_named(args.seed, "fill thin neighbours");
    memcpy(drawn.at.size, grid.size, sizeof grid.size);
    drawn.is_within = true;
    for (int round = 0; round < 3000; round++) {
        uint64_t thin[9] = {0}, inside[9], scratch[3];
        double at[4][3];
        for (int n = 0; n < 12; n++)
            at[n / 3][n % 3] = 1 + random_int(&r, 4) * 0x1p-52;
        const tribox_mesh mesh = {
            .positions = at, .vertices = 4, .indices = corners, .index_bytes = 4, .count = 4, .position_bytes = 8};
        assert_int_equal(tribox_mesh_fill_parity(&mesh, &grid, thin, scratch, inside, NULL, NULL), TRIBOX_OK);
        assert_int_equal(tribox_mesh_voxelize_thin(&mesh, &grid, NULL, NULL, thin, NULL), TRIBOX_OK);
        for (size_t n = 0; n < 27; n++)
            is_inside[n] = inside[n / 3] >> n % 3 & 1;
        snprintf(doing, sizeof doing, "tetrahedron %d", round);
        fill_case_check_leaks(&drawn, thin, is_inside);
    }
}

/* The faces of a box on planes: one layer of cells each, the lower ones without and the upper ones within. */
CASE(test_box)
{
    static const float low = 2, high = 7;
    float number[9][12];
    static const int corners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (int t = 0; t < 12; t++)
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++)
                number[3 * a + v][t] = corners[t / 2][!v ? 0 : v + t % 2] >> a & 1 ? high : low;
    const tribox_soup soup = soup_of_rows(number[0], 12, 12);
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {9, 9, 9}}, around = {{2, 2, 2}, {1, 1, 1}, {5, 5, 5}};
    uint64_t thin[81] = {0}, full[81] = {0};
    tribox_report report, of_full;
    assert_int_equal(tribox_voxelize_thin(&soup, &grid, NULL, NULL, thin, &report), TRIBOX_OK);
    assert_int_equal(tribox_voxelize(&soup, &grid, NULL, NULL, full, &of_full), TRIBOX_OK);
    assert_int_equal(report.overlapping, 3 * 5 * 5 + (5 * 5 * 5 - 4 * 4 * 4));
    assert_int_equal(of_full.overlapping, 7 * 7 * 7 - 3 * 3 * 3);
    memset(thin, 0, sizeof thin); /* what lies in planes of the grid's border is in the cells within */
    assert_int_equal(tribox_voxelize_thin(&soup, &around, NULL, NULL, thin, &report), TRIBOX_OK);
    assert_int_equal(report.overlapping, 5 * 5 * 5 - 3 * 3 * 3);
}

PROGRAM(RUN(test_cells), RUN(test_neighbouring_planes), RUN(test_box))
