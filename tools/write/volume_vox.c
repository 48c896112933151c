/* volume_vox.c - MagicaVoxel's format, one model: https://github.com/ephtracy/voxel-model, MagicaVoxel-file-format-vox.txt */
#include <stdlib.h>

#include "console/message.h"
#include "read/little.h"
#include "volume.h"

/* A colour is an index of the palette, where 1 is white by default. A chunk's header is its name and two lengths. */
enum { VERSION = 150, SIDE_MAX = 256, COLOUR = 1, CHUNK_HEADER = 12 };

int volume_check_vox(const char *path, const tribox_grid *grid)
{
    const uint32_t *n = grid->size;
    if (n[0] <= SIDE_MAX && n[1] <= SIDE_MAX && n[2] <= SIDE_MAX)
        return EXIT_CODE_OK;
    return message_failure("%s: .vox holds at most %d cells on each axis, the grid has %u x %u x %u; choose fewer cells, or write "
                           ".npy, .binvox or .raw",
                           path, SIDE_MAX, n[0], n[1], n[2]);
}

static void put(FILE *to, uint32_t number)
{
    unsigned char bytes[4];
    little_put32(bytes, number);
    fwrite(bytes, 1, sizeof bytes, to);
}

static void start_chunk(FILE *to, const char *name, uint32_t bytes, uint32_t bytes_of_children)
{
    fputs(name, to);
    put(to, bytes);
    put(to, bytes_of_children);
}

static void write_row(FILE *to, const uint64_t *row, uint32_t cells, uint32_t j, uint32_t k)
{
    for (uint32_t i = 0; i < cells; i++)
        if (voxels_bit(row, i)) {
            const unsigned char cell[4] = {(unsigned char)i, (unsigned char)j, (unsigned char)k, COLOUR};
            fwrite(cell, 1, sizeof cell, to);
        }
}

void volume_write_vox(FILE *to, const voxels *v, progress *bar)
{
    enum { SIZE_BYTES = 12 };
    const uint32_t *n = v->grid.size, cells = (uint32_t)voxels_occupied(v), cell_bytes = 4 + 4 * cells;
    fputs("VOX ", to);
    put(to, VERSION);
    start_chunk(to, "MAIN", 0, CHUNK_HEADER + SIZE_BYTES + CHUNK_HEADER + cell_bytes);
    start_chunk(to, "SIZE", SIZE_BYTES, 0);
    for (int a = 0; a < 3; a++)
        put(to, n[a]);
    start_chunk(to, "XYZI", cell_bytes, 0);
    put(to, cells);
    for (uint32_t k = 0; k < n[2] && !ferror(to); k++) {
        for (uint32_t j = 0; j < n[1]; j++)
            write_row(to, voxels_layer(v, k) + j * voxels_row_words(&v->grid), n[0], j, k);
        progress_tell(bar, (k + 1.0) / n[2]);
    }
}
