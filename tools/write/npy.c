/* npy.c - NumPy's own format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html */
#define _POSIX_C_SOURCE 200809L
#include "zip.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "console/message.h"
#include "read/little.h"
#include "volume.h"

/* Magic, version, length and text together are a multiple of 64, as the format demands. */
enum { BEFORE_TEXT = 10 };

/* shape: as Python writes it, "(3, 4)". */
static void fill_header(unsigned char header[NPY_HEADER], const char *type, const char *shape)
{
    char *const text = (char *)header + BEFORE_TEXT;
    memcpy(header, "\x93NUMPY\x01\x00", 8);
    header[8] = NPY_HEADER - BEFORE_TEXT;
    header[9] = 0;
    memset(text, ' ', NPY_HEADER - BEFORE_TEXT);
    const int length =
        snprintf(text, NPY_HEADER - BEFORE_TEXT, "{'descr': '%s', 'fortran_order': False, 'shape': %s, }", type, shape);
    text[length] = ' ';
    header[NPY_HEADER - 1] = '\n';
}

void npy_header(unsigned char header[NPY_HEADER], const npy_array *array, uint64_t rows)
{
    char shape[48];
    if (array->columns)
        snprintf(shape, sizeof shape, "(%" PRIu64 ", %u)", rows, array->columns);
    else
        snprintf(shape, sizeof shape, "(%" PRIu64 ",)", rows);
    fill_header(header, array->type, shape);
}

/* A byte per cell: bool, or a label; or an id of int32. */
static void write_dense_header(FILE *to, const voxels *v)
{
    unsigned char header[NPY_HEADER];
    char shape[64];
    snprintf(shape, sizeof shape, "(%u, %u, %u)", v->grid.size[2], v->grid.size[1], v->grid.size[0]);
    fill_header(header, v->ids ? "<i4" : v->inside ? "|u1" : "|b1", shape);
    fwrite(header, 1, sizeof header, to);
}

const volume_writer volume_npy = {.write_all = dense_write, .frame = &(const volume_frame){.before = write_dense_header}};

/* The coordinates of cells, three numbers each, of which it is known at last how many there are. */
static int open_cells(brick_out *out)
{
    static const npy_array cells = {.type = "<i4", .columns = 3};
    unsigned char header[NPY_HEADER];
    npy_header(header, &cells, out->occupied);
    fwrite(header, 1, sizeof header, out->to);
    return EXIT_CODE_OK;
}

static int put_cells(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    uint32_t cells[512][3], count = 0;
    for (uint32_t k = 0; k < 8; k++)
        for (uint64_t word = bits[k]; word; word &= word - 1, count++) {
            cells[count][0] = 8 * at[0] + lowest_bit(word) % 8;
            cells[count][1] = 8 * at[1] + lowest_bit(word) / 8;
            cells[count][2] = 8 * at[2] + k;
        }
    little_turn(cells, 3 * count, sizeof **cells);
    fwrite(cells, sizeof *cells, count, out->to);
    out->occupied += count;
    return EXIT_CODE_OK;
}

static int end_cells(brick_out *out, progress *bar)
{
    (void)bar;
    if (fseeko(out->to, 0, SEEK_SET))
        return message_failure("%s: cannot go back to its first bytes", out->file->path);
    return open_cells(out);
}

const volume_writer volume_cells = {.goes_back = true, .open = open_cells, .put = put_cells, .end = end_cells};
