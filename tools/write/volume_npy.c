/* volume_npy.c - NumPy's own format, version 1.0: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html */
#include <stdlib.h>
#include <string.h>

#include "volume.h"

/* The length of magic, version, length and text together; a multiple of 64, as the format demands. */
enum { HEADER = 128, BEFORE_TEXT = 10, CHUNK = 4096 };

static void write_header(FILE *to, const tribox_grid_f64 *grid)
{
    char header[HEADER];
    memset(header, ' ', sizeof header);
    memcpy(header, "\x93NUMPY\x01\x00", 8);
    header[8] = HEADER - BEFORE_TEXT;
    header[9] = 0;
    const int length =
        snprintf(header + BEFORE_TEXT, HEADER - BEFORE_TEXT, "{'descr': '|b1', 'fortran_order': False, 'shape': (%u, %u, %u), }",
                 grid->size[2], grid->size[1], grid->size[0]);
    header[BEFORE_TEXT + length] = ' ';
    header[HEADER - 1] = '\n';
    fwrite(header, 1, sizeof header, to);
}

static void write_row(FILE *to, const uint64_t *row, uint32_t cells)
{
    unsigned char chunk[CHUNK];
    for (uint32_t i = 0; i < cells;) {
        const uint32_t end = cells - i < CHUNK ? cells : i + CHUNK, start = i;
        for (; i < end; i++)
            chunk[i - start] = voxels_bit(row, i);
        fwrite(chunk, 1, end - start, to);
    }
}

void volume_write_npy(FILE *to, const voxels *v, progress *bar)
{
    const size_t row_words = voxels_row_words(&v->grid);
    write_header(to, &v->grid);
    for (uint32_t k = 0; k < v->grid.size[2]; k++) {
        const uint64_t *layer = voxels_layer(v, k);
        for (uint32_t j = 0; j < v->grid.size[1] && !ferror(to); j++)
            write_row(to, layer + j * row_words, v->grid.size[0]);
        if (ferror(to))
            return;
        progress_tell(bar, (k + 1.0) / v->grid.size[2]);
    }
}
