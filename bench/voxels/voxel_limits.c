/* voxel_limits.c - finds the words that each triangle sets by asking the library about it alone, and writes them. */
#include "voxel_rivals.h"

#include <math.h>
#include <stdlib.h>

/* The cells of a triangle's bounding box and one more on each side, as planes are rounded: first to last on each axis. */
typedef struct cell_box {
    size_t first[3], last[3];
} cell_box;

static size_t cell_of(const tribox_grid *grid, int a, double place)
{
    return place < 0 ? 0 : place < grid->size[a] ? (size_t)place : grid->size[a] - 1;
}

static cell_box box_of(const tribox_grid *grid, const tribox_soup *one)
{
    const float *const *const streams[3] = {one->x, one->y, one->z};
    cell_box box;
    for (int a = 0; a < 3; a++) {
        const float *const *const u = streams[a];
        const double least = fminf(fminf(*u[0], *u[1]), *u[2]), most = fmaxf(fmaxf(*u[0], *u[1]), *u[2]);
        box.first[a] = cell_of(grid, a, (least - grid->origin[a]) / grid->cell[a] - 1);
        box.last[a] = cell_of(grid, a, (most - grid->origin[a]) / grid->cell[a] + 1);
    }
    return box;
}

static bool put(voxel_words *to, size_t word, uint64_t bits)
{
    if (to->count == to->room) {
        const size_t room = to->room ? 2 * to->room : 4096;
        uint32_t *const more_words = realloc(to->word, room * sizeof *more_words);
        to->word = more_words ? more_words : to->word;
        uint64_t *const more_bits = realloc(to->bits, room * sizeof *more_bits);
        to->bits = more_bits ? more_bits : to->bits;
        if (!more_words || !more_bits)
            return false;
        to->room = room;
    }
    to->word[to->count] = (uint32_t)word;
    to->bits[to->count++] = bits;
    return true;
}

/* Takes the bits out of the words that the box crosses. */
static bool take_words(const tribox_grid *grid, const cell_box *box, uint64_t *occupied, voxel_words *to)
{
    for (size_t k = box->first[2]; k <= box->last[2]; k++)
        for (size_t j = box->first[1]; j <= box->last[1]; j++) {
            const size_t row = (k * grid->size[1] + j) * tribox_mask_words(grid->size[0]);
            for (size_t word = row + box->first[0] / 64; word <= row + box->last[0] / 64; word++) {
                if (occupied[word] && !put(to, word, occupied[word]))
                    return false;
                occupied[word] = 0;
            }
        }
    return true;
}

bool voxel_words_find(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options, uint64_t *blank,
                      voxel_words *found)
{
    for (size_t t = 0; t < soup->count; t++) {
        tribox_soup one = {.count = 1};
        for (int v = 0; v < 3; v++) {
            one.x[v] = soup->x[v] + t;
            one.y[v] = soup->y[v] + t;
            one.z[v] = soup->z[v] + t;
        }
        const cell_box box = box_of(grid, &one);
        if (tribox_voxelize(&one, grid, NULL, options, blank, NULL) || !take_words(grid, &box, blank, found))
            return false;
    }
    return true;
}

size_t voxel_words_write(const voxel_words *words, uint64_t *occupied)
{
    size_t set = 0;
    for (size_t i = 0; i < words->count; i++) {
        uint64_t *const word = &occupied[words->word[i]];
        set += (size_t)__builtin_popcountll(words->bits[i] & ~*word);
        *word |= words->bits[i];
    }
    return set;
}

void voxel_words_free(voxel_words *words)
{
    free(words->word);
    free(words->bits);
}
