/* fuzz_bricks.c - tiles, bricks and ids: a soup and a small grid, on every kernel. */
#include <math.h>
#include <string.h>

#include "answers.h"
#include "ensure.h"
#include "target.h"
#include "tight_memory.h"

enum { TRIANGLES_MAX = 6, WORDS_MAX = 3 * 20 * 20, CELLS_MAX = 129 * 20 * 20 };

typedef struct fuzz_case {
    tribox_grid grid;
    tribox_soup soup;
    tribox_options options;
    uint32_t tile;
    uint64_t expected[WORDS_MAX], taken[WORDS_MAX];
    uint32_t lowest[CELLS_MAX]; /* triangle of each cell; UINT32_MAX for none */
    size_t cells, bricks, most;
} fuzz_case;

/* About a brick, a tile and a word; small where every cell is asked, which takes its time. */
static tribox_grid draw_grid(input *in, bool is_small)
{
    static const uint32_t rows[] = {1, 7, 8, 9, 16, 63, 65, 129}, others[] = {1, 2, 7, 8, 9, 16, 17, 20};
    tribox_grid grid;
    input_doubles(in, grid.origin);
    input_doubles(in, grid.cell);
    const unsigned row = input_byte(in); /* what is left of it makes the grid one of doubles */
    grid.size[0] = rows[row % 8];
    move_up(grid.origin, 3, row / 8 % 4);
    move_up(grid.cell, 3, row / 32);
    grid.size[1] = others[input_below(in, is_small ? 2 : 8)];
    grid.size[2] = others[input_below(in, is_small ? 5 : 8)];
    for (int a = 0; a < 3; a++) {
        grid.cell[a] = fabs(grid.cell[a]);
        input_remember(in, (float)(grid.origin[a] + 8 * grid.cell[a]));
    }
    return grid;
}

static int take(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    fuzz_case *const q = data;
    const size_t before = q->cells;
    for (uint32_t n = 0; n < 512; n++) {
        const uint32_t i = 8 * at[0] + n % 8, j = 8 * at[1] + n / 8 % 8, k = 8 * at[2] + n / 64;
        if (!(bits[n / 64] >> n % 64 & 1))
            continue;
        ensure(i < q->grid.size[0] && j < q->grid.size[1] && k < q->grid.size[2], "cell %u %u %u of a brick is outside", i, j, k);
        uint64_t *const word = &q->taken[((size_t)k * q->grid.size[1] + j) * tribox_mask_words(q->grid.size[0]) + i / 64];
        ensure(!(*word >> i % 64 & 1), "cell %u %u %u comes twice", i, j, k);
        *word |= UINT64_C(1) << i % 64;
        q->cells++;
    }
    ensure(q->cells > before, "a brick is empty");
    return ++q->bricks >= q->most;
}

static size_t place_of(const fuzz_case *q, uint32_t i, uint32_t j, uint32_t k)
{
    return ((size_t)k * q->grid.size[1] + j) * q->grid.size[0] + i;
}

static int take_ids(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    const fuzz_case *const q = data;
    for (uint32_t n = 0; n < 512; n++) {
        const uint32_t i = 8 * at[0] + n % 8, j = 8 * at[1] + n / 8 % 8, k = 8 * at[2] + n / 64;
        const bool is_in = i < q->grid.size[0] && j < q->grid.size[1] && k < q->grid.size[2];
        ensure(ids[n] == (is_in ? q->lowest[place_of(q, i, j, k)] : UINT32_MAX), "a brick has %u for cell %u %u %u", ids[n], i, j,
               k);
    }
    return take(data, at, bits);
}

static void find_lowest(fuzz_case *q, const tribox_options *o)
{
    const size_t cells = place_of(q, 0, 0, q->grid.size[2]);
    size_t *const starts = tight_memory((cells + 1) * sizeof *starts, 0);
    status_fits("tribox_cell_lists", 0, tribox_cell_lists(&q->soup, &q->grid, NULL, o, starts, NULL));
    uint32_t *const list = tight_memory(starts[cells] * sizeof *list, 0);
    status_fits("tribox_cell_lists", 0, tribox_cell_lists(&q->soup, &q->grid, NULL, o, starts, list));
    for (size_t c = 0; c < cells; c++)
        q->lowest[c] = starts[c] < starts[c + 1] ? list[starts[c]] : UINT32_MAX;
}

/* The soup in two calls, the later triangles first. */
static void check_ids(const fuzz_case *q, const tribox_options *o)
{
    const size_t cells = place_of(q, 0, 0, q->grid.size[2]), words = tribox_window_words(q->grid.size), half = q->soup.count / 2;
    uint64_t *const occupied = tight_mask(64 * words);
    uint32_t *const ids = tight_memory(cells * sizeof *ids, 0);
    tribox_soup part[2] = {q->soup, q->soup};
    memset(occupied, 0, words * sizeof *occupied);
    part[0].count = half;
    part[1].count -= half;
    for (int n = 0; n < 9; n++)
        (n < 3 ? part[1].x : n < 6 ? part[1].y : part[1].z)[n % 3] += half;
    for (int p = 1; p >= 0; p--)
        status_fits("tribox_voxelize_ids", 0,
                    tribox_voxelize_ids(&part[p], p ? (uint32_t)half : 0, &q->grid, NULL, o, occupied, ids, NULL));
    ensure(!memcmp(occupied, q->expected, words * sizeof *occupied), "with ids there are other cells: axes %u, kernel %s", o->axes,
           o->kernel);
    for (size_t c = 0; c < cells; c++)
        ensure(ids[c] == q->lowest[c] || (q->lowest[c] == UINT32_MAX && is_poisoned(&ids[c], sizeof ids[c])),
               "cell %zu has id %u, not %u: axes %u, kernel %s", c, ids[c], q->lowest[c], o->axes, o->kernel);
}

/* The box of the tile. */
static tribox_box box_of(const fuzz_case *q, size_t tile)
{
    tribox_box box;
    uint32_t low[3], high[3];
    for (int a = 0; a < 3; a++) {
        const uint32_t size = q->grid.size[a], along = (size + q->tile - 1) / q->tile;
        low[a] = (uint32_t)(tile % along) * q->tile;
        high[a] = (low[a] + q->tile < size ? low[a] + q->tile : size) - 1;
        tile /= along;
    }
    const tribox_box first = tribox_grid_cell(&q->grid, low[0], low[1], low[2]),
                     last = tribox_grid_cell(&q->grid, high[0], high[1], high[2]);
    memcpy(box.lo, first.lo, sizeof box.lo);
    memcpy(box.hi, last.hi, sizeof box.hi);
    return box;
}

static void check_list(const fuzz_case *q, size_t tile, const uint32_t *list, size_t count, bool is_exact)
{
    const tribox_box box = box_of(q, tile);
    const tribox_options o = {.axes = q->options.axes, .kernel = "scalar"};
    uint64_t mask = 0, listed = 0;
    status_fits("tribox_overlap", 0, tribox_overlap(&q->soup, &box, &o, &mask, NULL));
    for (size_t i = 0; i < count; i++) {
        ensure(list[i] < q->soup.count && (!i || list[i - 1] < list[i]), "the list of tile %zu is out of order", tile);
        listed |= UINT64_C(1) << list[i];
    }
    ensure(!(mask & ~listed) && (!is_exact || mask == listed), "tile %zu lists %#llx, not %#llx", tile, (unsigned long long)listed,
           (unsigned long long)mask);
}

static void check_bricks(fuzz_case *q, const tribox_options *o, bool has_ids)
{
    const size_t tiles = tribox_tile_count(q->grid.size, q->tile), bytes = sizeof(size_t);
    size_t *const starts = tight_memory((tiles + 1) * bytes, 0);
    tribox_report report;
    const tribox_tiles all = {q->tile, 0, tiles};
    status_fits("tribox_tile_lists", 0, tribox_tile_lists(&q->soup, &q->grid, &all, o, starts, NULL));
    uint32_t *const list = tight_memory(starts[tiles] * sizeof *list, 0);
    status_fits("tribox_tile_lists", 0, tribox_tile_lists(&q->soup, &q->grid, &all, o, starts, list));
    for (size_t t = 0; t < tiles; t++)
        check_list(q, t, list + starts[t], starts[t + 1] - starts[t], o->accuracy == TRIBOX_EXACT);
    void *const scratch = tight_memory(has_ids ? tribox_bricks_ids_bytes(q->tile) : tribox_bricks_bytes(q->tile), 0);
    memset(q->taken, 0, sizeof q->taken);
    q->cells = q->bricks = 0;
    const tribox_status status =
        has_ids ? tribox_bricks_ids(&q->soup, &q->grid, &all, starts, list, o, scratch, &(tribox_ids_sink){take_ids, q}, &report)
                : tribox_bricks(&q->soup, &q->grid, &all, starts, list, o, scratch, &(tribox_sink){take, q}, &report);
    ensure(status == (q->bricks < q->most ? TRIBOX_OK : TRIBOX_STOPPED), "status %d after %zu bricks", (int)status, q->bricks);
    ensure(report.overlapping == q->cells, "%zu cells reported of %zu", report.overlapping, q->cells);
    for (size_t w = 0; w < WORDS_MAX && o->accuracy != TRIBOX_FAST; w++) {
        const uint64_t extra = q->taken[w] & ~q->expected[w], lost = q->expected[w] & ~q->taken[w];
        ensure((!extra || o->accuracy != TRIBOX_EXACT) && (!lost || status == TRIBOX_STOPPED),
               "accuracy %d, axes %u, kernel %s: word %zu lacks %#llx, has %#llx too many", (int)o->accuracy, o->axes, o->kernel, w,
               (unsigned long long)lost, (unsigned long long)extra);
    }
}

static void check_answers(fuzz_case *q)
{
    tribox_options o = {.axes = q->options.axes, .kernel = "scalar"};
    memset(q->expected, 0, sizeof q->expected);
    if (tribox_voxelize(&q->soup, &q->grid, NULL, &o, q->expected, NULL) != TRIBOX_OK)
        return; /* a grid that is refused */
    find_lowest(q, &o);
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++) {
        o.kernel = *kernel;
        o.accuracy = TRIBOX_EXACT;
        check_ids(q, &o);
        check_bricks(q, &o, true);
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            o.accuracy = (tribox_accuracy)accuracy;
            check_bricks(q, &o, false);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static fuzz_case q;
    input in = input_of(data, size);
    asked a = {.how = input_options(&in)};
    q.grid = draw_grid(&in, a.how.options.axes && !(a.how.options.axes & TRIBOX_AXES_BOX));
    q.options = a.how.options;
    q.tile = 8 * (1 + input_below(&in, 4));
    q.most = input_below(&in, 4) ? SIZE_MAX : 1 + input_below(&in, 8);
    do {
        float u[3][3];
        input_triangle(&in, u);
        memcpy(a.pair[a.drawn++].u, u, sizeof u);
    } while (!input_is_over(&in) && a.drawn < TRIANGLES_MAX);
    a.count = a.drawn;
    q.soup = asked_soup(&a, 0);
    if (!a.how.wrong)
        check_answers(&q);
    tight_memory_free_all();
    return 0;
}
