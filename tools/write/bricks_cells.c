/* bricks_cells.c - the coordinates of cells as an array of NumPy's, three numbers a cell. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdio.h>

#include "brick_writer.h"
#include "console/message.h"
#include "lowest_bit.h"
#include "npy_header.h"
#include "read/little.h"

enum { CELLS = 512, CELL_BYTES = 12 };

static void write_header(const brick_out *out)
{
    unsigned char header[NPY_HEADER];
    char shape[32];
    snprintf(shape, sizeof shape, "(%" PRIu64 ", 3)", out->occupied);
    npy_header(header, "<i4", shape);
    fwrite(header, 1, sizeof header, out->to);
}

static int open_cells(brick_out *out)
{
    write_header(out);
    return EXIT_CODE_OK;
}

static int put_cells(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    unsigned char cells[CELLS * CELL_BYTES], *to = cells;
    for (uint32_t k = 0; k < 8; k++)
        for (uint64_t word = bits[k]; word; word &= word - 1, to += CELL_BYTES) {
            const uint32_t bit = lowest_bit(word);
            little_put32(to, 8 * at[0] + bit % 8);
            little_put32(to + 4, 8 * at[1] + bit / 8);
            little_put32(to + 8, 8 * at[2] + k);
        }
    fwrite(cells, 1, (size_t)(to - cells), out->to);
    out->occupied += (uint64_t)(to - cells) / CELL_BYTES;
    return EXIT_CODE_OK;
}

/* The count is known at last. */
static int end_cells(brick_out *out, progress *bar)
{
    (void)bar;
    if (fseeko(out->to, 0, SEEK_SET))
        return message_failure("%s: cannot go back to its first bytes", out->file->path);
    write_header(out);
    return EXIT_CODE_OK;
}

static void drop_cells(brick_out *out) { (void)out; }

const brick_writer bricks_cells = {.goes_back = true, .open = open_cells, .put = put_cells, .end = end_cells, .drop = drop_cells};
