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

/* A run that grows cell by cell and is written when its value changes. */
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

static void add_cells(run *r, int value, uint64_t count)
{
    if (value != r->value)
        end_run(r);
    r->value = value;
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

/* One line along y, filled up with empty cells. */
static void add_line(run *r, const uint64_t *layer, const tribox_grid *grid, uint32_t i, uint32_t side)
{
    const size_t row_words = voxels_row_words(grid);
    const uint64_t *word = layer + i / 64;
    for (uint32_t j = 0; j < grid->size[1]; j++, word += row_words)
        add_cells(r, *word >> i % 64 & 1, 1);
    add_cells(r, 0, side - grid->size[1]);
}

static void write_binvox(FILE *to, const voxels *v, progress *bar)
{
    const uint32_t side = longest(&v->grid);
    run r = {.to = to};
    write_header(to, v, side);
    for (uint32_t i = 0; i < v->grid.size[0] && !ferror(to); i++) {
        for (uint32_t k = 0; k < v->grid.size[2]; k++)
            add_line(&r, voxels_layer(v, k), &v->grid, i, side);
        add_cells(&r, 0, (uint64_t)side * (side - v->grid.size[2]));
        progress_tell(bar, (i + 1.0) / v->grid.size[0]);
    }
    add_cells(&r, 0, (uint64_t)side * side * (side - v->grid.size[0]));
    end_run(&r);
}

const volume_writer volume_binvox = {.check_grid = check_grid, .write = write_binvox};
