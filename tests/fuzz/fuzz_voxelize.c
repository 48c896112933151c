/* fuzz_voxelize.c - tribox_voxelize, of a whole grid, of layers and of a window: a soup and a small grid. */
#include <math.h>
#include <string.h>

#include "answers.h"
#include "ensure.h"
#include "tight_memory.h"
#include "target.h"

enum { TRIANGLES_MAX = 6 };

typedef struct fuzz_case {
    tribox_grid grid;
    tribox_soup soup;
    tribox_options options;
    size_t words;
    uint32_t cut; /* the layers in two parts: those below it, and the others */
    tribox_window window;
    const uint64_t *before; /* what is set already */
} fuzz_case;

/* By the definition in tribox.h. */
static double plane(const tribox_grid *grid, int a, uint32_t p) { return fma(p, grid->cell[a], grid->origin[a]); }

/* Rows about a word, and short ones. */
static tribox_grid draw_grid(input *in, bool has_short_rows)
{
    static const uint32_t rows[] = {1, 2, 3, 5, 8, 17, 63, 64, 65, 127, 128, 129};
    tribox_grid grid;
    input_doubles(in, grid.origin);
    input_doubles(in, grid.cell);
    const unsigned row = input_byte(in), kinds = has_short_rows ? 6 : sizeof rows / sizeof rows[0];
    grid.size[0] = rows[row % kinds]; /* what is left of it makes the grid one of doubles */
    move_up(grid.origin, 3, row / kinds % 4);
    move_up(grid.cell, 3, row / kinds / 4);
    grid.size[1] = input_below(in, 4);
    grid.size[2] = input_below(in, 4);
    for (int a = 0; a < 3; a++) {
        grid.cell[a] = fabs(grid.cell[a]);
        input_remember(in, (float)plane(&grid, a, grid.size[a]));
    }
    return grid;
}

static bool is_sound(const tribox_grid *grid)
{
    for (int a = 0; a < 3; a++) {
        if (!grid->size[a] || !isfinite(grid->origin[a]) || !isfinite(grid->cell[a]) || !(grid->cell[a] > 0))
            return false;
        for (uint32_t p = 0; p < grid->size[a]; p++)
            if (!(plane(grid, a, p) < plane(grid, a, p + 1)) || !isfinite(plane(grid, a, p + 1)))
                return false;
    }
    return true;
}

/* The bits of a word that are cells: past the end of a row there are none. */
static uint64_t cells_of_word(const tribox_grid *grid, size_t w)
{
    const uint32_t rest = grid->size[0] % 64;
    return rest && (w + 1) % tribox_mask_words(grid->size[0]) == 0 ? ~(~UINT64_C(0) << rest) : ~UINT64_C(0);
}

/* What EXACT has to set: every cell asked for the triangles that it has. */
static uint64_t *cells_of_each(const fuzz_case *q)
{
    const tribox_grid *const grid = &q->grid;
    uint64_t *const occupied = tight_mask(64 * q->words);
    tribox_options o = q->options;
    o.kernel = NULL;
    memcpy(occupied, q->before, q->words * sizeof *occupied);
    for (uint32_t k = 0; k < grid->size[2]; k++)
        for (uint32_t j = 0; j < grid->size[1]; j++)
            for (uint32_t i = 0; i < grid->size[0]; i++) {
                const tribox_box cell = tribox_grid_cell(grid, i, j, k);
                const uint32_t at[3] = {i, j, k};
                tribox_report report;
                for (int a = 0; a < 3; a++)
                    ensure(cell.lo[a] == plane(grid, a, at[a]) && cell.hi[a] == plane(grid, a, at[a] + 1),
                           "tribox_grid_cell is not by the planes");
                status_fits("tribox_overlap", 0, tribox_overlap(&q->soup, &cell, &o, NULL, &report));
                occupied[((size_t)k * grid->size[1] + j) * tribox_mask_words(grid->size[0]) + i / 64] |=
                    (uint64_t)(report.overlapping > 0) << i % 64;
            }
    return occupied;
}

static size_t population(const uint64_t *words, size_t count) { return mask_population("tribox_voxelize", words, 64 * count); }

static tribox_window layers_of(const fuzz_case *q, uint32_t first, uint32_t layers)
{
    return (tribox_window){{0, 0, first}, {q->grid.size[0], q->grid.size[1], layers}};
}

/* The whole, and in two parts. Returns what is set. */
static uint64_t *voxelize(const fuzz_case *q, const tribox_options *o)
{
    const size_t bytes = q->words * sizeof(uint64_t), below = q->words / q->grid.size[2] * q->cut;
    uint64_t *const whole = tight_mask(64 * q->words);
    uint64_t *const part[2] = {tight_mask(64 * below), tight_mask(64 * (q->words - below))};
    tribox_report report, parts[2];
    memcpy(whole, q->before, bytes);
    memcpy(part[0], q->before, below * sizeof *whole);
    memcpy(part[1], q->before + below, bytes - below * sizeof *whole);
    status_fits("tribox_voxelize", 0, tribox_voxelize(&q->soup, &q->grid, NULL, o, whole, &report));
    const tribox_window lower = layers_of(q, 0, q->cut), upper = layers_of(q, q->cut, q->grid.size[2] - q->cut);
    status_fits("tribox_voxelize", 0, tribox_voxelize(&q->soup, &q->grid, &lower, o, part[0], &parts[0]));
    status_fits("tribox_voxelize", 0, tribox_voxelize(&q->soup, &q->grid, &upper, o, part[1], &parts[1]));
    ensure(!memcmp(whole, part[0], below * sizeof *whole) && !memcmp(whole + below, part[1], bytes - below * sizeof *whole),
           "layers are not as in the whole: accuracy %d, axes %u, kernel %s", (int)o->accuracy, o->axes, o->kernel);
    ensure(report.overlapping == population(whole, q->words) - population(q->before, q->words), "%zu cells reported as newly set",
           report.overlapping);
    ensure(parts[0].overlapping + parts[1].overlapping == report.overlapping, "the reports of the parts do not add up");
    return whole;
}

/* The bit of a cell, in rows of that many words. */
static bool cell_bit(const uint64_t *words, size_t row_words, uint32_t rows, uint32_t i, uint32_t j, uint32_t k)
{
    return mask_bit(words, 64 * row_words * ((size_t)k * rows + j) + i);
}

/* A window has what EXACT sets in the whole, besides what was there before. */
static void check_window(const fuzz_case *q, const tribox_options *o, const uint64_t *expected)
{
    const uint32_t *const first = q->window.first, *const size = q->window.size;
    const size_t row_words = ((size_t)size[0] + 63) / 64, words = row_words * size[1] * size[2];
    uint64_t *const occupied = tight_mask(64 * words);
    tribox_report report;
    memset(occupied, 0, words * sizeof *occupied);
    status_fits("tribox_voxelize", 0, tribox_voxelize(&q->soup, &q->grid, &q->window, o, occupied, &report));
    ensure(report.overlapping == population(occupied, words), "%zu cells reported of a window", report.overlapping);
    for (uint32_t k = 0; k < size[2]; k++)
        for (uint32_t j = 0; j < size[1]; j++)
            for (uint32_t i = 0; i < size[0]; i++) {
                const size_t whole = tribox_mask_words(q->grid.size[0]);
                const uint32_t rows = q->grid.size[1], at[3] = {first[0] + i, first[1] + j, first[2] + k};
                const bool is = cell_bit(occupied, row_words, size[1], i, j, k);
                const bool wanted = cell_bit(expected, whole, rows, at[0], at[1], at[2]);
                ensure(is == wanted || (is && o->accuracy != TRIBOX_EXACT) || o->accuracy == TRIBOX_FAST ||
                           cell_bit(q->before, whole, rows, at[0], at[1], at[2]),
                       "cell %u %u %u of a window from %u %u %u on: accuracy %d, axes %u, kernel %s", i, j, k, first[0], first[1],
                       first[2], (int)o->accuracy, o->axes, o->kernel);
            }
}

static void check_answers(const fuzz_case *q)
{
    const uint64_t *const expected = cells_of_each(q);
    tribox_options o = q->options;
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            o.kernel = *kernel;
            o.accuracy = (tribox_accuracy)accuracy;
            const uint64_t *const set = voxelize(q, &o);
            check_window(q, &o, expected);
            for (size_t w = 0; w < q->words; w++) {
                const uint64_t lost = accuracy == TRIBOX_FAST ? 0 : expected[w] & ~set[w];
                const uint64_t extra = set[w] & ~(accuracy == TRIBOX_EXACT ? expected[w] : cells_of_word(&q->grid, w));
                ensure(!lost && !extra && !(q->before[w] & ~set[w]),
                       "accuracy %d, axes %u, kernel %s: word %zu lacks %#llx, has %#llx too many", accuracy, o.axes, o.kernel, w,
                       (unsigned long long)lost, (unsigned long long)extra);
            }
        }
}

/* Of a grid, options or layers that are refused nothing is written, not even one word. */
static void check_refusal(const fuzz_case *q, unsigned wrong, uint32_t first, uint32_t layers)
{
    tribox_report report;
    uint64_t *const occupied = tight_mask(64);
    memset(&report, POISON, sizeof report);
    const tribox_window window = layers_of(q, first, layers);
    const tribox_status status = tribox_voxelize(&q->soup, &q->grid, &window, &q->options, occupied, &report);
    status_fits("tribox_voxelize", wrong, status);
    ensure(is_poisoned(occupied, sizeof *occupied) && is_poisoned(&report, sizeof report),
           "tribox_voxelize writes although it refuses");
}

/* A few cells. */
static const uint64_t *set_before(unsigned choice, const tribox_grid *grid, size_t words)
{
    uint64_t *const before = tight_mask(64 * words);
    for (size_t w = 0; w < words; w++)
        before[w] = choice * UINT64_C(0x0100000000040001) & cells_of_word(grid, w);
    return before;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    asked a = {.how = input_options(&in)};
    const bool asks_every_cell = a.how.options.axes && !(a.how.options.axes & TRIBOX_AXES_BOX); /* which takes its time */
    fuzz_case q = {.grid = draw_grid(&in, asks_every_cell), .options = a.how.options};
    q.cut = q.grid.size[2] ? input_below(&in, q.grid.size[2] + 1) : 0;
    const unsigned before = input_byte(&in);
    for (int n = 0; n < 3; n++) {
        q.window.first[n] = input_below(&in, q.grid.size[n] + 1);
        q.window.size[n] = input_below(&in, q.grid.size[n] - q.window.first[n] + 1);
    }
    float u[TRIANGLES_MAX][3][3];
    do {
        input_triangle(&in, u[a.drawn]);
        memcpy(a.pair[a.drawn].u, u[a.drawn], sizeof u[0]);
        a.drawn++;
    } while (!input_is_over(&in) && a.drawn < TRIANGLES_MAX);
    a.count = a.drawn;
    q.soup = asked_soup(&a, 0);

    const unsigned wrong = a.how.wrong | (is_sound(&q.grid) ? 0 : 1u << TRIBOX_BAD_GRID);
    if (wrong)
        check_refusal(&q, wrong, 0, 0);
    else {
        q.words = tribox_window_words(q.grid.size);
        q.before = set_before(before, &q.grid, q.words);
        check_refusal(&q, 1u << TRIBOX_BAD_ARGUMENT, q.cut, q.grid.size[2] - q.cut + 1);
        check_answers(&q);
    }
    tight_memory_free_all();
    return 0;
}
