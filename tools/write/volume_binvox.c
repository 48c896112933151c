/* volume_binvox.c - the format of P. Min's binvox: https://www.patrickmin.com/binvox/binvox.html */
#include <stdlib.h>

#include "console/message.h"
#include "console/written_number.h"
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
    char text[DECIMAL_MAX], place[3 * DECIMAL_MAX];
    const double *const at = v->grid.origin, *const by = v->shift;
    fprintf(to, "#binvox 1\ndim %u %u %u\ntranslate %s\nscale %s\ndata\n", side, side, side,
            decimals_of((const double[]){at[0] + by[0], at[1] + by[1], at[2] + by[2]}, ' ', place),
            decimal_of_double(v->grid.cell[0] * side, text));
}

/*
 * Cells follow each other along y in the file and along x in memory. The columns of a word are turned at once: a line along y
 * becomes words of its own, so that memory is read once for all of them, and runs are found a word at a time.
 */
enum { SIDE = 64 };

typedef struct columns {
    size_t line, plane; /* words from a line to the next of the column, and from a column to the next */
    uint64_t *words;    /* of SIDE columns */
} columns;

/* Columns of a word of each row of a layer; `from` is that of the first. */
static void turn_layer(const columns *c, const tribox_grid *grid, const uint64_t *from, uint64_t *to)
{
    const size_t row_words = voxels_row_words(grid);
    for (uint32_t j = 0; j < grid->size[1]; j += SIDE, to++) {
        uint64_t words[SIDE] = {0}, any = 0;
        for (uint32_t row = 0; row < SIDE && j + row < grid->size[1]; row++, from += row_words)
            any |= words[row] = *from;
        if (any)
            voxels_transpose(words);
        for (uint32_t column = 0; column < SIDE; column++)
            to[column * c->plane] = words[column];
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

static int write_binvox(brick_out *out, progress *bar)
{
    FILE *const to = out->to;
    const voxels *const v = &out->cells;
    const tribox_grid *const grid = &v->grid;
    const uint32_t side = longest(grid);
    run r = {.to = to};
    enum { APART = 8 }; /* words of a line of the cache: columns a power of two apart would take each other's place in it */
    const size_t line = (grid->size[1] + SIDE - 1) / SIDE, plane = line * grid->size[2] + APART;
    const columns c = {line, plane, malloc(SIDE * plane * sizeof *c.words)};
    if (!c.words)
        return file_out_failure(out->file);
    write_header(to, v, side);
    for (uint32_t i = 0; i < grid->size[0] && !ferror(to); i++) {
        for (uint32_t k = 0; k < grid->size[2] && i % SIDE == 0; k++)
            turn_layer(&c, grid, voxels_layer(v, k) + i / SIDE, c.words + k * c.line);
        add_plane(&r, &c, c.words + i % SIDE * c.plane, grid, side);
        progress_tell(bar, (i + 1.0) / grid->size[0]);
    }
    add_empty(&r, (uint64_t)side * side * (side - grid->size[0]));
    end_run(&r);
    free(c.words);
    return EXIT_CODE_OK;
}

const volume_writer volume_binvox = {.check_grid = check_grid, .write_all = write_binvox};
