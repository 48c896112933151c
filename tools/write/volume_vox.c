/* volume_vox.c - MagicaVoxel's format, one model: https://github.com/ephtracy/voxel-model, MagicaVoxel-file-format-vox.txt */
#include <stdlib.h>

#include "colours/colours.h"
#include "console/message.h"
#include "volume.h"

/* A colour is an index of the palette, where 1 is white by default. A chunk's header is its name and two lengths. */
enum { VERSION = 150, SIDE_MAX = 256, COLOUR = 1, CHUNK_HEADER = 12, SIZE_BYTES = 12, COLOURS = 256, PALETTE_BYTES = 4 * COLOURS };

static int check_grid(const char *path, const tribox_grid *grid)
{
    const uint32_t *n = grid->size;
    if (n[0] <= SIDE_MAX && n[1] <= SIDE_MAX && n[2] <= SIDE_MAX)
        return EXIT_CODE_OK;
    return message_failure("%s: .vox holds at most %d cells on each axis, the grid has %u x %u x %u; choose fewer cells, or write "
                           ".npy, .binvox or .raw",
                           path, SIDE_MAX, n[0], n[1], n[2]);
}

static void start_chunk(FILE *to, const char *name, uint32_t bytes, uint32_t bytes_of_children)
{
    fputs(name, to);
    volume_put_numbers(to, (const uint32_t[]){bytes, bytes_of_children}, 2);
}

/* The label is the colour where cells have none of their own. */
static unsigned char colour_of(const voxels *v, const uint64_t *inside, const uint32_t cell[3])
{
    const cell_colours *const c = v->colours;
    const int label = inside && voxels_bit(inside, cell[0]) ? VOXELS_INSIDE : VOXELS_SURFACE;
    return (unsigned char)(c ? COLOUR + palette_find(&c->palette, cell_colours_at(c, cell)) : label);
}

static void write_row(FILE *to, const voxels *v, uint32_t j, uint32_t k)
{
    const uint64_t *const row = voxels_layer(v, k) + j * voxels_row_words(&v->grid);
    const uint64_t *const inside = v->inside ? v->inside + (row - v->words) : NULL;
    for (uint32_t i = 0; i < v->grid.size[0]; i++)
        if (voxels_bit(row, i)) {
            const unsigned char colour = colour_of(v, inside, (const uint32_t[3]){i, j, k});
            const unsigned char cell[4] = {(unsigned char)i, (unsigned char)j, (unsigned char)k, colour};
            fwrite(cell, 1, sizeof cell, to);
        }
}

/* Colour n + 1 of a cell is number n here. rest: how opaque colours of no cell are, by which readers tell labels from colours. */
static void write_palette(FILE *to, const rgb *of, int count, unsigned char rest)
{
    start_chunk(to, "RGBA", PALETTE_BYTES, 0);
    for (int n = 0; n < COLOURS; n++) {
        const rgb colour = n < count ? of[n] : (rgb){{0, 0, 0}};
        fwrite((const unsigned char[4]){colour.at[0], colour.at[1], colour.at[2], n < count ? UINT8_MAX : rest}, 1, 4, to);
    }
}

static int write_vox(brick_out *out, progress *bar)
{
    static const rgb labels[] = {[VOXELS_SURFACE - 1] = {{255, 255, 255}}, [VOXELS_INSIDE - 1] = {{255, 128, 0}}};
    FILE *const to = out->to;
    const voxels *const v = &out->cells;
    const uint32_t *n = v->grid.size, cells = (uint32_t)voxels_occupied(v), cell_bytes = 4 + 4 * cells;
    const bool has_labels = v->inside;
    const uint32_t palette_bytes = v->colours || has_labels ? CHUNK_HEADER + PALETTE_BYTES : 0;
    fputs("VOX ", to);
    volume_put_numbers(to, &(const uint32_t){VERSION}, 1);
    start_chunk(to, "MAIN", 0, CHUNK_HEADER + SIZE_BYTES + CHUNK_HEADER + cell_bytes + palette_bytes);
    start_chunk(to, "SIZE", SIZE_BYTES, 0);
    volume_put_numbers(to, n, 3);
    start_chunk(to, "XYZI", cell_bytes, 0);
    volume_put_numbers(to, &cells, 1);
    for (uint32_t k = 0; k < n[2] && !ferror(to); k++) {
        for (uint32_t j = 0; j < n[1]; j++)
            write_row(to, v, j, k);
        progress_tell(bar, (k + 1.0) / n[2]);
    }
    if (v->colours)
        write_palette(to, v->colours->palette.of, v->colours->palette.count, UINT8_MAX);
    else if (has_labels)
        write_palette(to, labels, 2, 0);
    return EXIT_CODE_OK;
}

const volume_writer volume_vox = {.check_grid = check_grid, .write_all = write_vox};
