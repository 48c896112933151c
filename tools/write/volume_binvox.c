/* volume_binvox.c - the format of P. Min's binvox: https://www.patrickmin.com/binvox/binvox.html */
#include <stdlib.h>

#include "console/written_number.h"
#include "console/message.h"
#include "volume.h"

/* Of the cube that a grid is filled up to: its cells can be counted. */
enum { SIDE_MOST = 1 << 21 };

static uint32_t longest(const tribox_grid *grid)
{
    uint32_t side = grid->size[0];
    for (int a = 1; a < 3; a++)
        side = grid->size[a] > side ? grid->size[a] : side;
    return side;
}

static int check_grid(const char *path, const tribox_grid *grid)
{
    if (longest(grid) > SIDE_MOST)
        return message_failure(
            "%s: binvox fills a grid up to a cube, here of %u^3 cells, and %d^3 are the most; choose .npz or .raw", path,
            longest(grid), (int)SIDE_MOST);
    if (grid->cell[0] == grid->cell[1] && grid->cell[1] == grid->cell[2])
        return EXIT_CODE_OK;
    return message_failure("%s: binvox takes cubic cells only, these are %.9g x %.9g x %.9g; give --cell one length, or "
                           "choose .npy or .raw",
                           path, grid->cell[0], grid->cell[1], grid->cell[2]);
}

/* A run that grows and is written when its value changes. */
typedef struct run {
    FILE *to;
    uint64_t length;
    int value;
} run;

static void end_run(run *r)
{
    for (; r->length && !ferror(r->to); r->length -= r->length < 255 ? r->length : 255) {
        putc(r->value, r->to);
        putc(r->length < 255 ? (int)r->length : 255, r->to);
    }
}

static void end_run_and_flip(run *r)
{
    end_run(r);
    r->value = !r->value;
}

/* The lowest `count` bits of a word, 64 at most. */
static void add_bits(run *r, uint64_t word, uint32_t count)
{
    for (;;) {
        const uint64_t others = r->value ? ~word : word;
        const uint32_t same = others ? lowest_bit(others) : 64;
        if (same >= count)
            break;
        r->length += same;
        end_run_and_flip(r);
        word >>= same;
        count -= same;
    }
    r->length += count;
}

static void add_empty(run *r, uint64_t count)
{
    if (r->value)
        end_run_and_flip(r);
    r->length += count;
}

/* The grid is placed where the mesh was before it was shifted. */
static void write_header(FILE *to, const voxels *v, uint32_t side)
{
    char text[DECIMAL_MAX];
    fprintf(to, "#binvox 1\ndim %u %u %u\ntranslate", side, side, side);
    for (int a = 0; a < 3; a++)
        fprintf(to, " %s", decimal_of_double(v->grid.origin[a] + v->shift[a], text));
    fprintf(to, "\nscale %s\ndata\n", decimal_of_double(v->grid.cell[0] * side, text));
}

/*
 * Cells follow each other along y in the file and along x in memory. Some columns of cells, of the same words, are turned at once:
 * a line along y becomes words of their own, so that memory is read once for all of them, and runs are found a word at a time.
 */
enum { SIDE = 64 };

typedef struct columns {
    uint32_t count;     /* at once: a power of two, SIDE where memory is not short */
    size_t line, plane; /* words from a line to the next of the column, and from a column to the next */
    uint64_t *words;
} columns;

static bool columns_make(columns *c, const tribox_grid *grid)
{
    enum { APART = 8 }; /* words of a line of the cache: columns a power of two apart would take each other's place in it */
    const size_t line = (grid->size[1] + SIDE - 1) / SIDE, plane = line * grid->size[2] + APART;
    *c = (columns){.count = 2 * SIDE, .line = line, .plane = plane};
    while (!c->words && c->count > 1) {
        c->count /= 2;
        c->words = malloc(plane * c->count * sizeof *c->words);
    }
    return c->words;
}

/* Bit i of word j becomes bit j of word i: halves change places, then quarters, and so on. */
static void turn(uint64_t words[SIDE])
{
    uint64_t low = UINT32_MAX;
    for (unsigned half = SIDE / 2; half; half /= 2, low ^= low << half)
        for (unsigned i = 0; i < SIDE; i = ((i | half) + 1) & ~half) {
            const uint64_t change = (words[i] >> half ^ words[i | half]) & low;
            words[i] ^= change << half;
            words[i | half] ^= change;
        }
}

/* Columns from i on of a layer, which begins at `layer`. */
static void turn_layer(const columns *c, const tribox_grid *grid, const uint64_t *layer, uint32_t i, uint64_t *to)
{
    const size_t row_words = voxels_row_words(grid);
    const uint64_t *from = layer + i / SIDE;
    for (uint32_t j = 0; j < grid->size[1]; j += SIDE, to++) {
        uint64_t words[SIDE] = {0}, any = 0;
        for (uint32_t row = 0; row < SIDE && j + row < grid->size[1]; row++, from += row_words)
            any |= words[row] = *from;
        if (any)
            turn(words);
        for (uint32_t column = 0; column < c->count; column++)
            to[column * c->plane] = words[i % SIDE + column];
    }
}

/* A plane of the cube: lines along y, filled up with empty cells. */
static void add_plane(run *r, const columns *c, const uint64_t *words, const tribox_grid *grid, uint32_t side)
{
    for (uint32_t k = 0; k < grid->size[2]; k++, words += c->line) {
        for (uint32_t j = 0; j < grid->size[1]; j += SIDE)
            add_bits(r, words[j / SIDE], grid->size[1] - j < SIDE ? grid->size[1] - j : SIDE);
        add_empty(r, side - grid->size[1]);
    }
    add_empty(r, (uint64_t)side * (side - grid->size[2]));
}

static bool write_binvox(FILE *to, const voxels *v, progress *bar)
{
    const tribox_grid *const grid = &v->grid;
    const uint32_t side = longest(grid);
    run r = {.to = to};
    columns c;
    if (!columns_make(&c, grid))
        return false;
    write_header(to, v, side);
    for (uint32_t i = 0; i < grid->size[0] && !ferror(to); i++) {
        for (uint32_t k = 0; k < grid->size[2] && i % c.count == 0; k++)
            turn_layer(&c, grid, voxels_layer(v, k), i, c.words + k * c.line);
        add_plane(&r, &c, c.words + i % c.count * c.plane, grid, side);
        progress_tell(bar, (i + 1.0) / grid->size[0]);
    }
    add_empty(&r, (uint64_t)side * side * (side - grid->size[0]));
    end_run(&r);
    free(c.words);
    return true;
}

const volume_writer volume_binvox = {.check_grid = check_grid, .write = write_binvox};
