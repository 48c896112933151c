/* voxels.h - the cells of a grid as bits in memory, and bricks of 8 x 8 x 8 cells out of them, and into them. */
#ifndef VOXELS_H
#define VOXELS_H

#include <stdbool.h>

#include "console/progress.h"
#include "tribox.h"

typedef struct voxels {
    tribox_grid grid;
    double shift[3];                    /* what was subtracted from the mesh */
    const uint64_t *words;              /* of all cells as tribox_voxelize writes them; NULL where they are put apart */
    const uint64_t *inside;             /* which of them are inside, for labels; NULL: cells have none */
    const struct cell_colours *colours; /* of all set cells; NULL: they have none */
    const int32_t *ids;                 /* of all cells, -1 where none is set; NULL without */
} voxels;

/* The words of layer k: rows of voxels_row_words, one for each y. */
const uint64_t *voxels_layer(const voxels *v, uint32_t k);

/* The label of a set cell, by a row of those inside. */
enum { VOXELS_SURFACE = 1, VOXELS_INSIDE = 2 };

static inline bool voxels_bit(const uint64_t *row, uint32_t i) { return row[i / 64] >> i % 64 & 1; }

/* Where the lowest set bit of a word that is not 0 is, with any compiler. */
static inline uint32_t lowest_bit(uint64_t word)
{
#if defined(__GNUC__)
    return (uint32_t)__builtin_ctzll(word);
#else
    uint32_t n = 0;
    for (uint32_t step = 32; step; step /= 2)
        if (!(word << (64 - step) >> (64 - step))) {
            word >>= step;
            n += step;
        }
    return n;
#endif
}

/* Bit i of word j becomes bit j of word i. */
void voxels_transpose(uint64_t words[64]);

/* How many bits are set in `count` words. */
uint64_t voxels_count(const uint64_t *words, size_t count);

/* How many cells are set. */
uint64_t voxels_occupied(const voxels *v);

/* The words of a row, and of a layer, of the grid. */
size_t voxels_row_words(const tribox_grid *grid);
size_t voxels_layer_words(const tribox_grid *grid);

bool voxels_are_shifted(const voxels *v);

/* In what two grids, and what was subtracted from their meshes, are not the same: "grid" or "shift"; NULL for nothing. */
const char *voxels_difference(const voxels *one, const voxels *other);

/* Whether the library voxelizes into a grid in this way. */
bool voxels_are_served(const tribox_grid *grid, const tribox_options *options);

/* Refuses a grid of more words than one call takes. instead: what to do. Returns an exit_code. */
int voxels_check_words(const tribox_grid *grid, const char *instead);

/* Refuses what does not fit into memory before any of it is taken. instead: as above. Returns an exit_code. */
int voxels_check_memory(const tribox_grid *grid, uint64_t bytes, const char *instead);

/* Takes a brick as a tribox_sink does, but returns an exit_code. */
typedef int brick_taker(void *data, const uint32_t at[3], const uint64_t bits[8]);

/*
 * Hands over each brick of the voxels that has a set cell, until one is not taken: by z, then y, then x, and with tiles tile after
 * tile, as tribox_bricks does. tile: cells along a side, a multiple of 64; 0: no tiles. Returns an exit_code.
 */
int bricks_cut(const voxels *v, uint32_t tile, brick_taker *take, void *data, progress *bar);

/* The cells of a brick that are inside, of voxels with labels. */
void bricks_inside(const voxels *v, const uint32_t at[3], uint64_t inside[8]);

/* Sets the cells of a brick that lies in a grid of this size, in its words. */
void bricks_lay(const uint32_t size[3], uint64_t *words, const uint32_t at[3], const uint64_t bits[8]);

#endif
