/* test_cell_lists.c - the triangles listed for each cell of a window are those that overlap it, and those of the whole grid. */
#include "tile_case.h"

#include "common/harness.h"
#include "tiles/tiles.h"

enum { ROUNDS = 400, ASKED = 60, FAR_ROUNDS = 200 };

static tile_case drawn;

static tribox_status list(const tile_case *c, const tribox_window *window, size_t *starts, uint32_t *numbers)
{
    const soup_or_mesh of = cells_all(&c->of);
    return CALL(cell_lists, &of, &c->of.grid, window, &c->of.options, starts, numbers);
}

static size_t cells_of(const uint32_t size[3]) { return (size_t)size[0] * size[1] * size[2]; }

/* Lists of a window, in memory that ends where it has to. */
typedef struct cell_lists {
    guarded starts_pages, list_pages;
    size_t *starts;
    uint32_t *list;
} cell_lists;

static cell_lists make_lists(const tile_case *c, const tribox_window *window, size_t cells)
{
    cell_lists l;
    const size_t bytes = (cells + 1) * sizeof *l.starts;
    l.starts_pages = guarded_make(bytes);
    l.starts = guarded_tail(l.starts_pages, bytes);
    memset(l.starts, 0xa5, bytes);
    assert_int_equal(list(c, window, l.starts, NULL), TRIBOX_OK);
    const size_t length = l.starts[cells];
    l.list_pages = guarded_make(length ? length * sizeof *l.list : 1);
    l.list = guarded_tail(l.list_pages, length * sizeof *l.list);
    assert_int_equal(list(c, window, l.starts, l.list), TRIBOX_OK);
    assert_int_equal(l.starts[cells], length);
    return l;
}

static void free_lists(cell_lists l)
{
    guarded_free(l.starts_pages);
    guarded_free(l.list_pages);
}

/* Any window, also one without cells, or of the last cell. */
static tribox_window draw_window(random_source *r, const uint32_t size[3])
{
    tribox_window window;
    for (int a = 0; a < 3; a++) {
        window.first[a] = (uint32_t)random_below(r, size[a]);
        window.size[a] = random_int(r, 3) ? (uint32_t)random_below(r, size[a] - window.first[a]) + 1 : size[a] - window.first[a];
        window.size[a] = random_int(r, 40) ? window.size[a] : 0;
    }
    return window;
}

/* The number of cell c of a window in the grid. */
static size_t cell_in_grid(const tribox_window *w, const uint32_t size[3], size_t c)
{
    const size_t i = c % w->size[0], j = c / w->size[0] % w->size[1], k = c / w->size[0] / w->size[1];
    return ((w->first[2] + k) * size[1] + w->first[1] + j) * size[0] + w->first[0] + i;
}

/* By the scalar kernel's answer for the box of a cell. */
static void check_cell(const tile_case *c, size_t cell, const uint32_t *numbers, size_t count)
{
    const tribox_options exact = {.axes = c->of.options.axes, .kernel = "scalar"};
    uint64_t mask[CELLS_TRIANGLES / 64];
    size_t found = 0;
    tile_case_overlap(c, cell, &exact, mask);
    for (size_t i = 0; i < c->of.count; i++)
        if (bit_of(mask, i) && (found >= count || numbers[found++] != i))
            fail_msg("%s: triangle %zu is missing in cell %zu", doing, i, cell);
    if (found != count)
        fail_msg("%s: cell %zu has %zu triangles and not %zu", doing, cell, count, found);
}

/* Some cells are asked about one by one; all have what the whole has. */
static void check_window(random_source *r, const tile_case *c, const tribox_window *window, const cell_lists *whole)
{
    const size_t cells = cells_of(window->size);
    const cell_lists l = make_lists(c, window, cells);
    for (size_t at = 0; at < cells; at++) {
        const size_t cell = cell_in_grid(window, c->of.grid.size, at), count = l.starts[at + 1] - l.starts[at];
        if (count != whole->starts[cell + 1] - whole->starts[cell])
            fail_msg("%s: cell %zu of a window has %zu triangles, of the grid %zu", doing, cell, count,
                     whole->starts[cell + 1] - whole->starts[cell]);
        assert_memory_equal(l.list + l.starts[at], whole->list + whole->starts[cell], count * sizeof *l.list);
        if (random_below(r, cells) < ASKED)
            check_cell(c, cell, l.list + l.starts[at], count);
    }
    free_lists(l);
}

/* The cells that have triangles are those that are voxelized. */
static void check_set(const tile_case *c, const cell_lists *whole)
{
    static uint64_t occupied[CASE_WORDS];
    const uint32_t *const size = c->of.grid.size;
    const tribox_options exact = {.axes = c->of.options.axes, .kernel = "scalar"};
    const size_t row = 64 * ((size[0] + 63) / 64);
    tile_case_dense(c, &exact, occupied);
    for (size_t cell = 0; cell < cells_of(size); cell++)
        if (bit_of(occupied, cell / size[0] * row + cell % size[0]) != (whole->starts[cell] < whole->starts[cell + 1]))
            fail_msg("%s: cell %zu is set or has triangles, and not both", doing, cell);
}

/* Lists of a share of the cells, as tiles of one cell: of all together this call may be asked itself. */
static void check_share(const tile_case *c, const cell_lists *whole, size_t from, size_t to)
{
    const tile_lists share = tile_case_lists(c, from, to);
    const size_t *const starts = whole->starts + from;
    for (size_t t = 0; t <= to - from; t++)
        assert_int_equal(share.starts[t], starts[t] - starts[0]);
    assert_memory_equal(share.list, whole->list + starts[0], share.starts[to - from] * sizeof *share.list);
    tile_lists_free(share);
}

CASE(test_windows)
{
    random_source r = random_named(args.seed, "lists by cell");
    for (size_t round = 0; round < arguments_rounds(&args, ROUNDS); round++) {
        tile_case_draw(&r, 1, &drawn);
        drawn.of.options.accuracy = TRIBOX_EXACT;
        tile_case_tell(&drawn, doing, sizeof doing);
        const size_t cells = cells_of(drawn.of.grid.size);
        const cell_lists whole = make_lists(&drawn, NULL, cells);
        check_share(&drawn, &whole, 0, cells / 2);
        check_share(&drawn, &whole, cells / 2, cells);
        check_set(&drawn, &whole);
        for (int n = 0; n < 3; n++) {
            const tribox_window window = draw_window(&r, drawn.of.grid.size);
            check_window(&r, &drawn, &window, &whole);
        }
        free_lists(whole);
    }
}

/* A window far from the first cell of a grid whose cells no number of tiles counts, where planes are rounded. */
CASE(test_far)
{
    random_source r = random_named(args.seed, "far cells");
    const tribox_grid grid = {{-3e8, 0.1, 7}, {0.3, 0.7, 1.0 / 3}, {UINT32_MAX, UINT32_MAX, UINT32_MAX}};
    for (size_t round = 0; round < FAR_ROUNDS / (arguments_are_short(&args) ? 10 : 1); round++) {
        tribox_window window;
        double u[4][9];
        size_t starts[4 * 5 * 3 + 1], at = 0;
        uint32_t numbers[4 * 60];
        for (int a = 0; a < 3; a++) {
            window.first[a] = (uint32_t)random_below(&r, UINT32_MAX - 10);
            window.size[a] = (const uint32_t[]){4, 5, 3}[a];
            for (int n = 0; n < 12; n++) {
                const uint32_t cell = window.first[a] + (uint32_t)random_int(&r, 5);
                const double on = tribox_grid_cell(&grid, a ? 0 : cell, a == 1 ? cell : 0, a == 2 ? cell : 0).lo[a];
                u[n / 3][3 * (n % 3) + a] = random_int(&r, 2) ? on : on + random_double(&r, -1, 1) * grid.cell[a];
            }
        }
        const tribox_mesh mesh = {.positions = u, .vertices = 12, .count = 4, .position_bytes = 8};
        assert_int_equal(tribox_mesh_cell_lists(&mesh, &grid, &window, NULL, starts, NULL), TRIBOX_OK);
        assert_int_equal(tribox_mesh_cell_lists(&mesh, &grid, &window, NULL, starts, numbers), TRIBOX_OK);
        for (uint32_t c = 0; c < 60; c++) {
            const tribox_box box =
                tribox_grid_cell(&grid, window.first[0] + c % 4, window.first[1] + c / 4 % 5, window.first[2] + c / 20);
            uint64_t mask;
            assert_int_equal(tribox_mesh_overlap(&mesh, &box, &(tribox_options){.kernel = "scalar"}, &mask, NULL), TRIBOX_OK);
            for (uint32_t i = 0; i < 4; i++)
                if (bit_of(&mask, i))
                    assert_true(at < starts[c + 1] && numbers[at++] == i);
            assert_int_equal(at, starts[c + 1]);
        }
    }
}

/* As many triangles as there are addresses for, and one more. */
CASE(test_sums)
{
    for (size_t more = 0; more < 2; more++) {
        size_t counts[] = {9, SIZE_MAX / 8, SIZE_MAX / 8 + 1 + more, 0};
        assert_int_equal(tribox_sum_counts(counts, 3), !more);
    }
}

PROGRAM(RUN(test_windows), RUN(test_far), RUN(test_sums))
