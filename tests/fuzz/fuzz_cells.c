/*
 * fuzz_cells.c - triangles in any layout and a small grid: cells of the whole, of layers and of a window, tiles, bricks, ids, lists
 * of cells, on every kernel; and what is inside, both ways.
 */
#include <math.h>
#include <string.h>

#include "scale/crossing_oracle.h"
#include "things.h"

enum {
    TRIANGLES_MAX = 6,
    WORDS_MAX = 3 * 17 * 17,
    CELLS_MAX = 129 * 17 * 17,
    WALLS = 16,
    FLOAT_BITS = 151 /* of means of planes, which are sums of multiples of floats */
};

typedef struct fuzz_case {
    things t;
    tribox_grid grid;
    tribox_options options;
    size_t words, cells;
    uint32_t cut; /* the layers in two parts: those below it, and the others */
    tribox_window window;
    unsigned before_byte, wall[WALLS];
    const uint64_t *before;  /* what is set already */
    uint64_t *expected;      /* besides what is set already */
    uint8_t hits[CELLS_MAX]; /* the triangles of each cell, as bits */
    uint32_t tile;
    uint64_t taken[WORDS_MAX];
    size_t taken_cells, bricks, most;
} fuzz_case;

/* Rows about a word, a brick and a tile; small grids where every cell is asked, which takes its time. */
static tribox_grid draw_grid(input *in, bool is_small)
{
    static const uint32_t rows[] = {1, 2, 3, 5, 8, 17, 7, 9, 16, 63, 64, 65, 127, 128, 129}, others[] = {1, 2, 3, 7, 8, 9, 17, 0};
    tribox_grid grid;
    input_numbers(in, grid.origin, 3);
    input_numbers(in, grid.cell, 3);
    const unsigned row = input_byte(in), kinds = is_small ? 6 : 15; /* what is left of it makes the grid one of doubles */
    grid.size[0] = rows[row % kinds];
    move_up(grid.origin, 3, row / kinds % 4);
    move_up(grid.cell, 3, row / kinds / 4);
    for (int a = 1; a < 3; a++)
        grid.size[a] = others[input_below(in, is_small ? 3 : 8)];
    for (int a = 0; a < 3; a++) {
        grid.cell[a] = fabs(grid.cell[a]);
        const double places[2] = {grid.origin[a] + grid.cell[a] / 2, plane_of(&grid, a, grid.size[a])};
        for (int k = 0; k < 2; k++)
            input_remember(in, in->is_wide ? places[k] : (double)(float)places[k]);
    }
    return grid;
}

static bool is_sound(const tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        if (!grid->size[a] || !isfinite(grid->origin[a]) || !isfinite(grid->cell[a]) || !(grid->cell[a] > 0))
            return false;
        for (uint32_t p = 0; p < grid->size[a]; p++)
            if (!(plane_of(grid, a, p) < plane_of(grid, a, p + 1)) || !isfinite(plane_of(grid, a, p + 1)))
                return false;
    }
    return true;
}

static size_t place_of(const fuzz_case *q, uint32_t i, uint32_t j, uint32_t k)
{
    return ((size_t)k * q->grid.size[1] + j) * q->grid.size[0] + i;
}

/* The bits of a word that are cells: past the end of a row there are none. */
static uint64_t cells_of_word(const tribox_grid *grid, size_t w)
{
    const uint32_t rest = grid->size[0] % 64;
    return rest && (w + 1) % tribox_mask_words(grid->size[0]) == 0 ? ~(~UINT64_C(0) << rest) : ~UINT64_C(0);
}

/* What EXACT has to set: every cell asked for the triangles that it has. */
static void find_hits(fuzz_case *q)
{
    const uint32_t *const size = q->grid.size;
    const tribox_options o = {.axes = q->options.axes};
    q->expected = clear_mask(64 * q->words);
    for (uint32_t k = 0; k < size[2]; k++)
        for (uint32_t j = 0; j < size[1]; j++)
            for (uint32_t i = 0; i < size[0]; i++) {
                const tribox_box cell = tribox_grid_cell(&q->grid, i, j, k);
                const uint32_t at[3] = {i, j, k};
                uint64_t mask;
                for (int a = 0; a < 3; a++)
                    ensure(cell.lo[a] == plane_of(&q->grid, a, at[a]) && cell.hi[a] == plane_of(&q->grid, a, at[a] + 1),
                           "tribox_grid_cell is not by the planes");
                ensure_status(0, things_overlap(&q->t, &(tribox_region){.box = &cell}, &o, &mask, NULL));
                q->hits[place_of(q, i, j, k)] = (uint8_t)mask;
                if (mask)
                    window_put(size, q->expected, i, j, k, true);
            }
}

static uint32_t lowest(unsigned hits)
{
    uint32_t i = 0;
    while (hits && !(hits >> i & 1))
        i++;
    return hits ? i : UINT32_MAX;
}

/* What is set, and what was before, of a window or all: no cell that had to be set is missing, and none is there that must not. */
static void check_window(const fuzz_case *q, const tribox_window *w, const tribox_options *o, const uint64_t *set, bool has_before)
{
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++) {
                const uint32_t at[3] = {w->first[0] + i, w->first[1] + j, w->first[2] + k}, *const size = q->grid.size;
                const bool is = window_bit(w->size, set, i, j, k);
                const bool had = has_before && window_bit(size, q->before, at[0], at[1], at[2]);
                const bool wanted = had || window_bit(size, q->expected, at[0], at[1], at[2]);
                ensure(is == wanted || (is ? o->accuracy != TRIBOX_EXACT : o->accuracy == TRIBOX_FAST && !had),
                       "cell %u %u %u of a window from %u %u %u on is %d", i, j, k, w->first[0], w->first[1], w->first[2], is);
            }
}

/* One window; the cells that are reported are those that were not there before. Returns what is set. */
static uint64_t *check_voxelize(const fuzz_case *q, const tribox_window *window, const tribox_options *o, const uint64_t *before)
{
    const size_t bits = 64 * tribox_window_words(window->size);
    uint64_t *const set = clear_mask(bits);
    tribox_report report;
    if (before && bits)
        memcpy(set, before, bits / 8);
    const size_t had = mask_population(set, bits);
    ensure_status(0, CALL(voxelize, &q->t, &q->grid, window, o, set, &report));
    ensure(report.overlapping == mask_population(set, bits) - had, "%zu cells reported as newly set", report.overlapping);
    for (size_t w = 0; w < bits / 64; w++)
        ensure(!(set[w] & ~cells_of_word(&(tribox_grid){.size = {window->size[0]}}, w)), "word %zu has bits past the row", w);
    check_window(q, window, o, set, before);
    return set;
}

/* The whole, in two parts, and a window. */
static void check_windows(const fuzz_case *q, const tribox_options *o)
{
    const uint32_t *const size = q->grid.size, x = size[0], y = size[1], z = size[2];
    const size_t below = q->words / z * q->cut;
    const tribox_window all = {{0}, {x, y, z}}, lower = {{0}, {x, y, q->cut}}, upper = {{0, 0, q->cut}, {x, y, z - q->cut}};
    const uint64_t *const whole = check_voxelize(q, &all, o, q->before);
    ensure(is_same_mask(whole, check_voxelize(q, &lower, o, q->before), 64 * below) &&
               is_same_mask(whole + below, check_voxelize(q, &upper, o, q->before + below), 64 * (q->words - below)),
           "layers are not as in the whole");
    check_voxelize(q, &q->window, o, NULL);
}

static void check_cell_lists(const fuzz_case *q, const tribox_options *o)
{
    size_t *const starts = tight_memory((q->cells + 1) * sizeof *starts, 0);
    uint32_t *list = NULL;
    for (int pass = 0; pass < 2; pass++) {
        ensure_status(0, CALL(cell_lists, &q->t, &q->grid, NULL, o, starts, list));
        list = pass ? list : tight_memory(starts[q->cells] * sizeof *list, 0);
    }
    for (size_t c = 0; c < q->cells; c++) {
        unsigned listed = 0;
        for (size_t k = starts[c]; k < starts[c + 1]; k++)
            listed |= 1u << list[k];
        ensure(listed == q->hits[c], "the list of cell %zu has %#x, not %#x", c, listed, q->hits[c]);
    }
}

/* The triangles in two calls, the later ones first. */
static void check_ids(const fuzz_case *q, const tribox_options *o)
{
    const size_t half = q->t.count / 2;
    uint64_t *const occupied = clear_mask(64 * q->words);
    uint32_t *const ids = tight_memory(q->cells * sizeof *ids, 0);
    for (int p = 1; p >= 0; p--) {
        const things t = things_part(&q->t, p ? half : 0, p ? q->t.count - half : half);
        const uint32_t first = p ? (uint32_t)half : 0;
        ensure_status(0, CALL(voxelize_ids, &t, first, &q->grid, NULL, o, occupied, ids, NULL));
    }
    ensure(is_same_mask(occupied, q->expected, 64 * q->words), "with ids there are other cells");
    for (size_t c = 0; c < q->cells; c++) {
        const uint32_t wanted = lowest(q->hits[c]);
        ensure(ids[c] == (wanted == UINT32_MAX ? POISON * 0x1010101u : wanted), "cell %zu has id %u, not %u", c, ids[c], wanted);
    }
}

static int take(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    fuzz_case *const q = data;
    const size_t before = q->taken_cells;
    for (uint32_t n = 0; n < 512; n++) {
        const uint32_t i = 8 * at[0] + n % 8, j = 8 * at[1] + n / 8 % 8, k = 8 * at[2] + n / 64;
        if (!(bits[n / 64] >> n % 64 & 1))
            continue;
        ensure(i < q->grid.size[0] && j < q->grid.size[1] && k < q->grid.size[2], "cell %u %u %u of a brick is outside", i, j, k);
        ensure(!window_bit(q->grid.size, q->taken, i, j, k), "cell %u %u %u comes twice", i, j, k);
        window_put(q->grid.size, q->taken, i, j, k, true);
        q->taken_cells++;
    }
    ensure(q->taken_cells > before, "a brick is empty");
    return ++q->bricks >= q->most;
}

static int take_ids(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    const fuzz_case *const q = data;
    for (uint32_t n = 0; n < 512; n++) {
        const uint32_t i = 8 * at[0] + n % 8, j = 8 * at[1] + n / 8 % 8, k = 8 * at[2] + n / 64;
        const bool is_in = i < q->grid.size[0] && j < q->grid.size[1] && k < q->grid.size[2];
        ensure(ids[n] == (is_in ? lowest(q->hits[place_of(q, i, j, k)]) : UINT32_MAX), "a brick has %u for cell %u %u %u", ids[n],
               i, j, k);
    }
    return take(data, at, bits);
}

static void check_list(const fuzz_case *q, size_t tile, const uint32_t *list, size_t count, bool is_exact)
{
    const tribox_box box = box_of_tile(&q->grid, q->tile, tile);
    const tribox_options o = {.axes = q->options.axes, .kernel = "scalar"};
    uint64_t mask = 0, listed = 0;
    ensure_status(0, things_overlap(&q->t, &(tribox_region){.box = &box}, &o, &mask, NULL));
    for (size_t i = 0; i < count; i++) {
        ensure(list[i] < q->t.count && (!i || list[i - 1] < list[i]), "the list of tile %zu is out of order", tile);
        listed |= UINT64_C(1) << list[i];
    }
    ensure(!(mask & ~listed) && (!is_exact || mask == listed), "tile %zu lists %#llx, not %#llx", tile, (unsigned long long)listed,
           (unsigned long long)mask);
}

static tribox_status ask_bricks(fuzz_case *q, const tribox_tiles *tiles, const size_t *starts, const uint32_t *list,
                                const tribox_options *o, bool has_ids, tribox_report *report)
{
    void *const scratch = tight_memory(has_ids ? tribox_bricks_ids_bytes(q->tile) : tribox_bricks_bytes(q->tile), 0);
    const tribox_sink sink = {take, q};
    const tribox_ids_sink ids = {take_ids, q};
    if (has_ids)
        return CALL(bricks_ids, &q->t, &q->grid, tiles, starts, list, o, scratch, &ids, report);
    return CALL(bricks, &q->t, &q->grid, tiles, starts, list, o, scratch, &sink, report);
}

static void check_bricks(fuzz_case *q, const tribox_options *o, bool has_ids)
{
    const size_t tiles = tribox_tile_count(q->grid.size, q->tile);
    size_t *const starts = tight_memory((tiles + 1) * sizeof *starts, 0);
    uint32_t *list = NULL;
    tribox_report report;
    const tribox_tiles all = {q->tile, 0, tiles};
    for (int pass = 0; pass < 2; pass++) {
        ensure_status(0, CALL(tile_lists, &q->t, &q->grid, &all, o, starts, list));
        list = pass ? list : tight_memory(starts[tiles] * sizeof *list, 0);
    }
    for (size_t t = 0; t < tiles; t++)
        check_list(q, t, list + starts[t], starts[t + 1] - starts[t], o->accuracy == TRIBOX_EXACT);
    memset(q->taken, 0, sizeof q->taken);
    q->taken_cells = q->bricks = 0;
    const tribox_status status = ask_bricks(q, &all, starts, list, o, has_ids, &report);
    ensure(status == (q->bricks < q->most ? TRIBOX_OK : TRIBOX_STOPPED), "status %d after %zu bricks", (int)status, q->bricks);
    ensure(report.overlapping == q->taken_cells, "%zu cells reported of %zu", report.overlapping, q->taken_cells);
    for (size_t w = 0; w < q->words && o->accuracy != TRIBOX_FAST; w++) {
        const uint64_t extra = q->taken[w] & ~q->expected[w], lost = q->expected[w] & ~q->taken[w];
        ensure((!extra || o->accuracy != TRIBOX_EXACT) && (!lost || status == TRIBOX_STOPPED),
               "bricks: word %zu lacks %#llx, has %#llx too many", w, (unsigned long long)lost, (unsigned long long)extra);
    }
}

static void check(const void *about, const tribox_options *o)
{
    fuzz_case *const q = (fuzz_case *)(uintptr_t)about; /* bricks are taken into it */
    check_windows(q, o);
    check_bricks(q, o, false);
    if (o->accuracy == TRIBOX_EXACT) {
        check_cell_lists(q, o);
        check_ids(q, o);
        check_bricks(q, o, true);
    }
}

/* Of a grid, a mesh or layers that are refused nothing is written, not even one word. */
static void check_refusal(const fuzz_case *q, unsigned wrong, uint32_t first, uint32_t layers)
{
    uint64_t *const occupied = tight_mask(64);
    const tribox_window window = {{0, 0, first}, {q->grid.size[0], q->grid.size[1], layers}};
    ensure_status(wrong, CALL(voxelize, &q->t, &q->grid, &window, &q->options, occupied, NULL));
    ensure_poisoned(occupied, sizeof *occupied);
}

static crossing_case at;
static bool is_inside[ORACLE_CELLS], is_odd[ORACLE_CELLS];

/* Floats about planes of floats: the oracle's integers are no longer. */
static bool is_for_oracle(const fuzz_case *q)
{
    bool is = q->cells <= ORACLE_CELLS;
    for (int a = 0; a < 3; a++)
        is = is && (double)(float)q->grid.origin[a] == q->grid.origin[a] && (double)(float)q->grid.cell[a] == q->grid.cell[a];
    for (int k = 0; k < 9 * (int)q->t.drawn; k++) {
        const double x = q->t.u[k / 9][k / 3 % 3][k % 3];
        is = is && (!isfinite(x) || (double)(float)x == x);
    }
    return is;
}

static void check_parity(const fuzz_case *q, const uint64_t *walls)
{
    uint64_t *const solid = tight_mask(64 * q->words);
    void *const scratch = tight_memory(tribox_fill_bytes(q->grid.size), 1);
    size_t inside = 0, odd_rows = 0, expected_inside = 0, expected_odd = 0;
    at.count = (int)q->t.count;
    at.bits = FLOAT_BITS;
    memcpy(at.size, q->grid.size, sizeof at.size);
    for (size_t t = 0; t < q->t.count; t++)
        memcpy(at.u[t], things_triangle(&q->t, t), sizeof at.u[t]);
    for (int a = 0; a < 3; a++)
        for (uint32_t n = 0; n < at.size[a]; n++)
            at.middle[a][n] = (plane_of(&q->grid, a, n) + plane_of(&q->grid, a, n + 1)) / 2;
    ensure_status(0, CALL(fill_parity, &q->t, &q->grid, walls, scratch, solid, &inside, &odd_rows));
    crossing_oracle(&at, is_inside, is_odd);
    for (uint32_t row = 0; row < at.size[1] * at.size[2]; row++) {
        expected_odd += is_odd[row];
        for (uint32_t i = 0; i < at.size[0]; i++) {
            const bool is_wall = window_bit(at.size, walls, i, row, 0), is_filled = !is_wall && is_inside[row * at.size[0] + i];
            expected_inside += is_filled;
            ensure(window_bit(at.size, solid, i, row, 0) == (is_wall || is_filled), "parity: cell %u of row %u", i, row);
        }
    }
    for (size_t w = 0; w < q->words; w++)
        ensure(!(solid[w] & ~cells_of_word(&q->grid, w)), "parity: word %zu has bits past the row", w);
    ensure(inside == expected_inside && odd_rows == expected_odd, "%zu inside, %zu odd rows", inside, odd_rows);
}

/* Reached cells take free ones beside them until none is left: on the border of the grid all is beside the outside. */
static void spread(const fuzz_case *q, const uint64_t *walls, bool *is_reached)
{
    const uint32_t *const size = q->grid.size;
    for (bool is_new = true; is_new;) {
        is_new = false;
        for (size_t n = 0; n < q->cells; n++) {
            const uint32_t row = (uint32_t)(n / size[0]), place[3] = {(uint32_t)(n % size[0]), row % size[1], row / size[1]};
            size_t step = 1;
            bool is_beside = false;
            for (int a = 0; a < 3; step *= size[a++])
                is_beside = is_beside || !place[a] || place[a] + 1 == size[a] || is_reached[n - step] || is_reached[n + step];
            if (is_beside && !is_reached[n] && !window_bit(size, walls, place[0], row, 0))
                is_reached[n] = is_new = true;
        }
    }
}

static void check_outside(const fuzz_case *q, const uint64_t *walls)
{
    static bool is_reached[CELLS_MAX];
    uint64_t *const solid = tight_mask(64 * q->words);
    size_t inside = 0, expected = 0;
    memset(is_reached, 0, sizeof is_reached);
    spread(q, walls, is_reached);
    ensure_status(0, tribox_fill_outside(q->grid.size, walls, tight_memory(tribox_fill_bytes(q->grid.size), 3), solid, &inside));
    for (size_t n = 0; n < q->cells; n++) {
        const size_t i = n % q->grid.size[0], row = n / q->grid.size[0];
        expected += !is_reached[n] && !window_bit(q->grid.size, walls, i, row, 0);
        ensure(window_bit(q->grid.size, solid, i, row, 0) == !is_reached[n], "outside: cell %zu", n);
    }
    for (size_t w = 0; w < q->words; w++)
        ensure(!(solid[w] & ~cells_of_word(&q->grid, w)), "outside: word %zu has bits past the row", w);
    ensure(inside == expected, "outside: %zu inside, not %zu", inside, expected);
}

static void check_all(fuzz_case *q)
{
    uint64_t *const before = tight_mask(64 * q->words), *const walls = tight_mask(64 * q->words);
    for (size_t w = 0; w < q->words; w++) {
        before[w] = q->before_byte * UINT64_C(0x0100000000040001) & cells_of_word(&q->grid, w);
        walls[w] = q->wall[w % WALLS] * UINT64_C(0x0102040810204081) * (q->wall[(w + 5) % WALLS] | 1) & cells_of_word(&q->grid, w);
    }
    q->before = before;
    check_refusal(q, 1u << TRIBOX_BAD_ARGUMENT, q->cut, q->grid.size[2] - q->cut + 1);
    find_hits(q);
    ask_everywhere(q->options, check, q);
    if (is_for_oracle(q))
        check_parity(q, walls);
    check_outside(q, walls);
}

static void draw(input *in, fuzz_case *q)
{
    q->options = input_options(in);
    const unsigned kind = input_byte(in);
    in->is_wide = kind >= 128;
    q->grid = draw_grid(in, q->options.axes && !(q->options.axes & TRIBOX_AXES_BOX));
    q->cut = q->grid.size[2] ? input_below(in, q->grid.size[2] + 1) : 0;
    q->before_byte = input_byte(in);
    for (int n = 0; n < 3; n++) {
        q->window.first[n] = input_below(in, q->grid.size[n] + 1);
        q->window.size[n] = input_below(in, q->grid.size[n] - q->window.first[n] + 1);
    }
    q->tile = 8 * (1 + input_below(in, 4));
    q->most = input_below(in, 4) ? SIZE_MAX : 1 + input_below(in, 8);
    for (int n = 0; n < WALLS; n++)
        q->wall[n] = input_byte(in);
    things_draw(in, kind % KINDS, 1 + input_below(in, TRIANGLES_MAX), NULL, &q->t);
    q->words = tribox_window_words(q->grid.size);
    q->cells = (size_t)q->grid.size[0] * q->grid.size[1] * q->grid.size[2];
    const unsigned wrong = q->t.wrong | (is_sound(&q->grid) ? 0 : 1u << TRIBOX_BAD_GRID);
    if (wrong)
        check_refusal(q, wrong, 0, 0);
    else
        check_all(q);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static fuzz_case q;
    input in = input_of(data, size);
    draw(&in, &q);
    tight_memory_free_all();
    return 0;
}
