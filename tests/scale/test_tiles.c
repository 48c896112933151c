/*
 * test_tiles.c - the triangles listed for each tile are those that overlap its box, float and double, in whole grids and shares;
 * lists of a few triangles at a time, put into one, are those of all at once; and those of the cells of a window are those of tiles
 * of one cell.
 */
#include "tile_case.h"

#include <float.h>
#include <math.h>

#include "common/harness.h"
#include "tiles/tiles.h"

enum { PAIRS = 100000, ROUNDS = 400, TILES_MAX = 3000, PARTS = 5 };

static tile_case drawn, in_cells;

static const uint32_t tiles[] = {1, 2, 3, 4, 8, 128, 0};

/* EXACT lists a tile's triangles; others list these, and of those that the box normals leave any. */
static void check_tile(const tile_case *c, size_t tile, const uint32_t *list, size_t count)
{
    const unsigned axes = c->of.options.axes ? c->of.options.axes : TRIBOX_AXES_ALL;
    const tribox_options exact = {.axes = axes, .kernel = "scalar"}, wide = {.axes = axes & TRIBOX_AXES_BOX, .kernel = "scalar"};
    const bool is_exact = c->of.options.accuracy == TRIBOX_EXACT;
    const size_t triangles = c->of.count;
    uint64_t least[CELLS_TRIANGLES / 64], most[CELLS_TRIANGLES / 64], listed[CELLS_TRIANGLES / 64] = {0};
    tile_case_overlap(c, tile, &exact, least);
    tile_case_overlap(c, tile, is_exact || !wide.axes ? &exact : &wide, most);
    for (size_t i = 0; i < count; i++) {
        assert_true(list[i] < triangles && (!i || list[i - 1] < list[i]));
        listed[list[i] / 64] |= UINT64_C(1) << list[i] % 64;
    }
    for (size_t i = 0; i < triangles; i++)
        if ((bit_of(least, i) && !bit_of(listed, i)) || (bit_of(listed, i) && !bit_of(most, i) && (is_exact || wide.axes)))
            fail_msg("%s: triangle %zu is %s tile %zu", doing, i, bit_of(listed, i) ? "in" : "missing in", tile);
}

static void check_share(const tile_case *c, size_t from, size_t to)
{
    const tile_lists g = tile_case_lists(c, from, to);
    for (size_t t = from; t < to; t++) {
        assert_true(g.starts[t - from] <= g.starts[t - from + 1]);
        check_tile(c, t, g.list + g.starts[t - from], g.starts[t - from + 1] - g.starts[t - from]);
    }
    tile_lists_free(g);
}

/* From a tile to another tile: in a row, of rows, of layers, or any. */
static void draw_share(random_source *r, const tile_case *c, size_t *from, size_t *to)
{
    const size_t count = tile_case_tiles(c), row = (c->of.grid.size[0] + c->tile - 1) / c->tile,
                 layer = row * ((c->of.grid.size[1] + c->tile - 1) / c->tile);
    const size_t steps[] = {1, row, layer}, step = steps[random_int(r, 3)];
    const size_t most[] = {1, row, count};
    *from = random_below(r, count) / step * step;
    const size_t left = (count - *from) / step, wanted = most[random_int(r, 3)] / step + 1;
    *to = *from + step * (1 + random_below(r, left < wanted ? left : wanted));
}

/* Some of the triangles, and the places of each part, in memory that ends where it has to. */
typedef struct part {
    size_t first, count;
    guarded pages;
    size_t *places, *counted;
} part;

/* Parts in a row, empty ones too, which begin and end anywhere. */
static void draw_parts(random_source *r, size_t count, part *parts)
{
    size_t at = 0;
    for (int n = 0; n < PARTS; n++) {
        const size_t left = count - at;
        parts[n] = (part){.first = at, .count = n == PARTS - 1 ? left : random_below(r, left + 1)};
        at += parts[n].count;
    }
}

static void count_part(const tile_case *c, size_t from, size_t to, part *p)
{
    const size_t bytes = (to - from) * sizeof *p->places;
    p->pages = guarded_make(bytes);
    p->places = guarded_tail(p->pages, bytes);
    assert_non_null(p->counted = malloc(bytes + 1));
    memset(p->places, 0xa5, bytes);
    assert_int_equal(tile_case_part(c, p->first, p->count, from, to, p->places, NULL), TRIBOX_OK);
    memcpy(p->counted, p->places, bytes);
}

/* In each tile the parts follow each other. */
static void place_parts(part *parts, size_t count, const size_t *starts)
{
    for (size_t t = 0; t < count; t++) {
        size_t place = starts[t];
        for (int n = 0; n < PARTS; n++) {
            parts[n].places[t] = place;
            place += parts[n].counted[t];
        }
        if (place != starts[t + 1])
            fail_msg("%s: of the %zu triangles of tile %zu of the share, parts have %zu", doing, starts[t + 1] - starts[t], t,
                     place - starts[t]);
    }
}

/* The last part first: places alone tell where each goes. */
static void check_parts(random_source *r, const tile_case *c, size_t from, size_t to)
{
    part parts[PARTS];
    const tile_lists whole = tile_case_lists(c, from, to);
    const size_t length = whole.starts[to - from];
    const guarded pages = guarded_make(length * sizeof(uint32_t));
    uint32_t *const list = guarded_tail(pages, length * sizeof *list);
    draw_parts(r, c->of.count, parts);
    for (int n = 0; n < PARTS; n++)
        count_part(c, from, to, &parts[n]);
    place_parts(parts, to - from, whole.starts);
    memset(list, 0xa5, length * sizeof *list);
    for (int n = PARTS; n-- > 0;)
        assert_int_equal(tile_case_part(c, parts[n].first, parts[n].count, from, to, parts[n].places, list), TRIBOX_OK);
    if (memcmp(list, whole.list, length * sizeof *list) != 0)
        fail_msg("%s: parts do not make up the list of tiles %zu to %zu", doing, from, to);
    for (size_t t = 0; t < to - from; t++)
        assert_int_equal(parts[PARTS - 1].places[t], whole.starts[t + 1]);
    for (int n = 0; n < PARTS; n++) {
        free(parts[n].counted);
        guarded_free(parts[n].pages);
    }
    guarded_free(pages);
    tile_lists_free(whole);
}

static size_t cells_of(const uint32_t size[3]) { return (size_t)size[0] * size[1] * size[2]; }

static tribox_status list_cells(const void *window, size_t *starts, uint32_t *numbers)
{
    const soup_or_mesh of = cells_all(&in_cells.of);
    return CALL(cell_lists, &of, &in_cells.of.grid, window, &in_cells.of.options, starts, numbers);
}

/* The lists of the cells of a window, or of all, are those that tiles of one cell have. */
static void check_window(const tribox_window *window, const tile_lists *whole)
{
    const uint32_t *const grid = in_cells.of.grid.size, *const size = window ? window->size : grid;
    const size_t cells = cells_of(size);
    const tile_lists found = lists_asked(cells, list_cells, window);
    for (size_t at = 0; at < cells; at++) {
        const size_t i = at % size[0], j = at / size[0] % size[1], k = at / size[0] / size[1];
        const size_t count = found.starts[at + 1] - found.starts[at];
        const size_t cell =
            window ? ((window->first[2] + k) * grid[1] + window->first[1] + j) * grid[0] + window->first[0] + i : at;
        if (count != whole->starts[cell + 1] - whole->starts[cell])
            fail_msg("%s: cell %zu of a window has %zu triangles, as a tile %zu", doing, cell, count,
                     whole->starts[cell + 1] - whole->starts[cell]);
        assert_memory_equal(found.list + found.starts[at], whole->list + whole->starts[cell], count * sizeof *found.list);
    }
    tile_lists_free(found);
}

static void check_cells(random_source *r)
{
    in_cells = drawn;
    in_cells.tile = 1;
    in_cells.of.options.accuracy = TRIBOX_EXACT;
    const tile_lists whole = tile_case_lists(&in_cells, 0, tile_case_tiles(&in_cells));
    check_window(NULL, &whole);
    for (int n = 0; n < 3; n++) {
        tribox_window window;
        cells_draw_window(r, &in_cells.of.at, in_cells.of.grid.size, &window);
        window.size[random_int(r, 3)] *= random_int(r, 13) > 0; /* also one without cells */
        check_window(&window, &whole);
    }
    tile_lists_free(whole);
}

CASE(test_lists)
{
    random_source r = random_named(args.seed, "tiles");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        tile_case_draw(&r, tiles[round % (sizeof tiles / sizeof tiles[0])], &drawn);
        tile_case_tell(&drawn, doing, sizeof doing);
        const size_t count = tile_case_tiles(&drawn);
        for (int n = 0; n < 4; n++) {
            size_t from = 0, to = count;
            if (n)
                draw_share(&r, &drawn, &from, &to);
            to = to - from < TILES_MAX ? to : from + TILES_MAX;
            check_share(&drawn, from, to);
            check_parts(&r, &drawn, from, to);
        }
        check_cells(&r);
    }
}

/* All tiles of few cells a side at once, which may be asked as cells of a coarser grid; and of three, whose planes may differ. */
CASE(test_small_tiles)
{
    random_source r = random_named(args.seed, "small tiles");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        tile_case_draw(&r, (uint32_t)random_int_between(&r, 2, 4), &drawn);
        drawn.of.options.accuracy = TRIBOX_EXACT;
        tile_case_tell(&drawn, doing, sizeof doing);
        if (tile_case_tiles(&drawn) <= TILES_MAX)
            check_share(&drawn, 0, tile_case_tiles(&drawn));
    }
}

/* Grids of cells of length 1 with so many tiles that no call can look at a layer of them, or a row, each time. */
static const struct many_tiles {
    bool is_double;
    tribox_grid grid;
    uint32_t tile;
} many_tiles[] = {
    {false, {{0}, {1, 1, 1}, {8000, 8000, 8000}}, 8}, /* told apart in float */
    {false, {{0}, {1, 1, 1}, {65536, 65536, 65536}}, 8},      {true, {{0}, {1, 1, 1}, {8000, 8000, 8000}}, 8},
    {true, {{0}, {1, 1, 1}, {2147483648, 5, 1073741824}}, 8}, {true, {{0}, {1, 1, 1}, {5, 2147483648, 2147483648}}, 8},
};

/* A triangle across most of the grid, and a tile that it may overlap, at an end of a row or a layer at times. */
static size_t draw_across(random_source *r, const struct many_tiles *many, double u[3][3])
{
    const double s = random_double(r, 0, 1), t = random_double(r, 0, 1 - s);
    size_t tile = 0;
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++)
            u[v][a] = (float)(random_double(r, -0.2, 1.2) * many->grid.size[a]);
    for (int a = 2; a >= 0; a--) {
        const double place = s * u[0][a] + t * u[1][a] + (1 - s - t) * u[2][a], last = many->grid.size[a] - 1.0;
        const double cell = random_int(r, 4) ? fmin(fmax(place, 0), last) : random_int(r, 2) ? 0 : last;
        tile = tile * ((many->grid.size[a] + many->tile - 1) / many->tile) + (size_t)cell / many->tile;
    }
    return tile;
}

static tribox_status count_share(const struct many_tiles *many, const double u[3][3], size_t from, size_t to,
                                 const tribox_options *options, size_t *starts)
{
    const tribox_tiles share = {many->tile, from, to - from};
    float number[9];
    for (int n = 0; n < 9; n++)
        number[n] = (float)u[n % 3][n / 3];
    const soup_or_mesh of = {soup_of_rows(number, 1, 1), mesh_of_corners(u, 1, 8), many->is_double};
    return CALL(tile_lists, &of, &many->grid, &share, options, starts, NULL);
}

/* Shares of a few tiles, which take no longer than they have to: all of them hours, if a layer or a row were looked at. */
CASE(test_few_of_many)
{
    enum { SHARES = 5000 };
    random_source r = random_named(args.seed, "few of many tiles");
    for (size_t round = 0; round < SHARES / (arguments_are_short(&args) ? 10 : 1); round++) {
        const struct many_tiles *const many = &many_tiles[round % (sizeof many_tiles / sizeof many_tiles[0])];
        const size_t count = tribox_tile_count(many->grid.size, many->tile);
        const tribox_options options = {.axes = random_int(&r, 2) ? TRIBOX_AXES_BOX : TRIBOX_AXES_ALL};
        double u[3][3];
        size_t starts[6], tile = draw_across(&r, many, u);
        if (count == SIZE_MAX)
            continue;
        const size_t before = (size_t)random_int(&r, 3), after = 1 + (size_t)random_int(&r, 3);
        const size_t from = tile < before ? 0 : tile - before, to = count - tile < after ? count : tile + after;
        assert_int_equal(count_share(many, (const double(*)[3])u, from, to, &options, starts), TRIBOX_OK);
        const tribox_mesh mesh = {.positions = u, .vertices = 3, .count = 1, .position_bytes = 8};
        for (size_t t = from; t < to; t++) {
            const tribox_box box = box_of_tile(&many->grid, many->tile, t);
            uint64_t mask;
            assert_int_equal(tribox_mesh_overlap(&mesh, &box, &options, &mask, NULL), TRIBOX_OK);
            if (starts[t + 1 - from] - starts[t - from] != mask)
                fail_msg("round %zu: the triangle is %s tile %zu", round, mask ? "missing in" : "in", t);
        }
    }
}

/* More triangles than a kernel is asked about at once, one in each tile of a long row; the last of them spans all the tiles. */
CASE(test_long_row)
{
    enum { TILES = 1400 };
    static float streams[9][TILES];
    static double corners[TILES][9];
    static size_t starts[TILES + 1];
    static uint32_t list[2 * TILES];
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {TILES, 1, 1}};
    const tribox_tiles all = {1, 0, TILES};
    for (int i = 0; i < TILES; i++)
        for (int n = 0; n < 9; n++) {
            corners[i][n] = n % 3 ? 0.1 * n : i == TILES - 1 && n == 0 ? 0.5 : i + 0.25 + 0.05 * n;
            streams[n % 3 * 3 + n / 3][i] = (float)corners[i][n];
        }
    for (const char *const *kernel = (const char *[]){"scalar", tribox_kernel_name(NULL), NULL}; *kernel; kernel++)
        for (int is_double = 0; is_double < 2; is_double++) {
            const soup_or_mesh of = {soup_of_rows(streams[0], TILES, TILES), mesh_of_corners(corners, TILES, 8), is_double};
            const tribox_options options = {.kernel = *kernel};
            assert_int_equal(CALL(tile_lists, &of, &grid, &all, &options, starts, NULL), TRIBOX_OK);
            assert_int_equal(starts[TILES], 2 * TILES - 1);
            assert_int_equal(CALL(tile_lists, &of, &grid, &all, &options, starts, list), TRIBOX_OK);
            for (uint32_t t = 0; t < TILES; t++) {
                assert_int_equal(list[starts[t]], t);
                assert_int_equal(list[starts[t + 1] - 1], TILES - 1);
            }
        }
}

/* Where a number less the origin overflows, the first guess at its cell is as far off as there are cells. */
CASE(test_guess_far_off)
{
    static const double at[9] = {1e298, 0, 0, 1e298, 1, 0, 1e298, 0, 1};
    static size_t starts[1025];
    const tribox_mesh mesh = {.positions = at, .vertices = 3, .count = 1, .position_bytes = 8};
    const tribox_grid grid = {{-DBL_MAX, 0, 0}, {0x1.00000000fffffp+993, 1, 1}, {UINT32_MAX, 1, 1}};
    assert_int_equal(tribox_mesh_tile_lists(&mesh, &grid, &(tribox_tiles){1 << 22, 0, 1024}, NULL, starts, NULL), TRIBOX_OK);
    for (size_t t = 0; t < 1024; t++)
        assert_int_equal(starts[t + 1], t >= 511);
}

CASE(test_numbers_of_tiles)
{
    const uint32_t size[3] = {100, 7, 33}, most[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX}, flat[3] = {5, 0, 5};
    assert_int_equal(tribox_tile_count(size, 1), 100 * 7 * 33);
    assert_int_equal(tribox_tile_count(size, 8), 13 * 1 * 5);
    assert_int_equal(tribox_tile_count(size, 100), 1);
    assert_int_equal(tribox_tile_count(size, UINT32_MAX), 1);
    assert_int_equal(tribox_tile_count(size, 0), 0);
    assert_int_equal(tribox_tile_count(flat, 3), 0);
    assert_true(tribox_tile_count(most, 1) == SIZE_MAX);
    assert_true(tribox_tile_count(most, 1 << 11) == (sizeof(size_t) > 4 ? (uint64_t)1 << 63 : SIZE_MAX));
    assert_int_equal(tribox_tile_count(most, UINT32_MAX), 1);
    assert_int_equal(tribox_tile_count(most, UINT32_MAX - 1), 8);
}

/* A window far from the first cell of a grid whose cells no number of tiles counts, where planes are rounded. */
CASE(test_far)
{
    random_source r = random_named(args.seed, "far cells");
    const tribox_grid grid = {{-3e8, 0.1, 7}, {0.3, 0.7, 1.0 / 3}, {UINT32_MAX, UINT32_MAX, UINT32_MAX}};
    for (size_t round = 0; round < 200 / (arguments_are_short(&args) ? 10 : 1); round++) {
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

PROGRAM(RUN(test_lists), RUN(test_small_tiles), RUN(test_few_of_many), RUN(test_long_row), RUN(test_guess_far_off),
        RUN(test_numbers_of_tiles), RUN(test_far), RUN(test_sums))
