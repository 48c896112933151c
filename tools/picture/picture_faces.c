/* picture_faces.c - goes through the layers of voxels, each between its neighbours. */
#include "picture_faces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells along the longest side, and faces, beyond which cells are joined. */
enum { SIDE_MOST = 1536, FACES_MOST = 12 << 20 };

typedef struct scan {
    const voxels *v;
    uint32_t factor; /* how many cells along each axis become one */
    tribox_grid grid;
    size_t row_words, layer_words;
    uint64_t *layers; /* three, and one without cells */
} scan;

static tribox_grid joined(const tribox_grid *grid, uint32_t factor)
{
    tribox_grid g = *grid;
    for (int a = 0; a < 3; a++)
        g.size[a] = (g.size[a] - 1) / factor + 1;
    return g;
}

static uint32_t least_factor(const tribox_grid *grid)
{
    uint32_t longest = 0;
    for (int a = 0; a < 3; a++)
        longest = grid->size[a] > longest ? grid->size[a] : longest;
    return (longest - 1) / SIDE_MOST + 1;
}

static uint64_t scan_words(const tribox_grid *grid) { return 4 * (uint64_t)voxels_layer_words(grid); }

uint64_t picture_faces_memory(const tribox_grid *grid)
{
    const tribox_grid g = joined(grid, least_factor(grid));
    const uint64_t faces = 6 * (uint64_t)g.size[0] * g.size[1] * g.size[2];
    return (faces < FACES_MOST ? faces : FACES_MOST) * sizeof(picture_face) + scan_words(&g) * sizeof(uint64_t);
}

/* Layer k of the joined cells; one without cells below and above the grid. */
static uint64_t *layer_of(const scan *s, int64_t k)
{
    return s->layers + (k < 0 || k >= s->grid.size[2] ? 3 : (size_t)k % 3) * s->layer_words;
}

static void join_row(const uint64_t *row, uint32_t cells, uint32_t factor, uint64_t *to)
{
    for (uint32_t i = 0; i < cells; i++)
        if (voxels_bit(row, i))
            to[i / factor / 64] |= UINT64_C(1) << i / factor % 64;
}

static void load_layer(const scan *s, uint32_t k)
{
    const tribox_grid *fine = &s->v->grid;
    const size_t row_words = voxels_row_words(fine);
    uint64_t *layer = layer_of(s, k);
    memset(layer, 0, s->layer_words * sizeof *layer);
    for (uint32_t n = k * s->factor; n < (k + 1) * s->factor && n < fine->size[2]; n++) {
        const uint64_t *row = voxels_layer(s->v, n);
        if (s->factor == 1)
            memcpy(layer, row, s->layer_words * sizeof *layer);
        for (uint32_t j = 0; s->factor > 1 && j < fine->size[1]; j++, row += row_words)
            if (voxels_count(row, row_words))
                join_row(row, fine->size[0], s->factor, layer + j / s->factor * s->row_words);
    }
}

/* Word w of the row, moved so that each bit stands where its lower (0) or upper (1) neighbour does. */
static uint64_t beside(const uint64_t *row, size_t words, size_t w, int side)
{
    return side ? row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0) : row[w] << 1 | (w ? row[w - 1] >> 63 : 0);
}

/* The cells of word w of a row whose face on this side is free. */
static uint64_t free_sides(const scan *s, int axis, int side, uint32_t w, uint32_t j, uint32_t k)
{
    static const uint64_t none = 0;
    const size_t at = (size_t)j * s->row_words + w;
    const uint64_t *here = layer_of(s, k) + at;
    if (axis == 0)
        return *here & ~beside(here - w, s->row_words, w, side);
    const bool is_last = side ? j + 1 == s->grid.size[1] : j == 0;
    const uint64_t *next = axis == 2 ? layer_of(s, (int64_t)k + 2 * side - 1) + at
                           : is_last ? &none
                           : side    ? here + s->row_words
                                     : here - s->row_words;
    return *here & ~*next;
}

static void take_cells(picture_faces *f, int axis, int side, uint64_t cells, const uint32_t at[3])
{
    for (; cells; cells &= cells - 1) {
        const uint64_t below = (cells & -cells) - 1;
        picture_face *face = &f->list[axis][side][f->count[axis][side]++];
        for (int a = 0; a < 3; a++)
            face->cell[a] = (uint16_t)at[a];
        face->cell[0] = (uint16_t)(at[0] + voxels_count(&below, 1));
    }
}

/* Counts the faces, or takes them where there are lists. */
static void scan_faces(const scan *s, picture_faces *f)
{
    memset(f->count, 0, sizeof f->count);
    load_layer(s, 0);
    for (uint32_t k = 0; k < s->grid.size[2]; k++) {
        if (k + 1 < s->grid.size[2])
            load_layer(s, k + 1);
        for (uint32_t j = 0; j < s->grid.size[1]; j++)
            for (uint32_t w = 0; w < s->row_words; w++)
                for (int n = 0; layer_of(s, k)[j * s->row_words + w] && n < 6; n++) {
                    const uint64_t cells = free_sides(s, n / 2, n % 2, w, j, k);
                    if (f->all)
                        take_cells(f, n / 2, n % 2, cells, (const uint32_t[3]){64 * w, j, k});
                    else
                        f->count[n / 2][n % 2] += voxels_count(&cells, 1);
                }
    }
}

static size_t split_lists(picture_faces *f)
{
    size_t faces = 0;
    for (int n = 0; n < 6; n++) {
        f->list[n / 2][n % 2] = f->all ? f->all + faces : NULL;
        faces += f->count[n / 2][n % 2];
    }
    return faces;
}

/* The cells farthest out on an axis are the ones whose faces are. */
static void find_bounds(picture_faces *f)
{
    for (int a = 0; a < 3; a++) {
        f->lo[a] = f->count[a][0] ? SIDE_MOST : 0;
        f->hi[a] = 0;
        for (size_t i = 0; i < f->count[a][0]; i++)
            f->lo[a] = f->list[a][0][i].cell[a] < f->lo[a] ? f->list[a][0][i].cell[a] : f->lo[a];
        for (size_t i = 0; i < f->count[a][1]; i++)
            f->hi[a] = f->list[a][1][i].cell[a] >= f->hi[a] ? f->list[a][1][i].cell[a] + 1 : f->hi[a];
    }
}

bool picture_faces_make(const voxels *v, picture_faces *f)
{
    scan s = {.v = v, .factor = least_factor(&v->grid)};
    const double *cell = v->grid.cell, longest = fmax(cell[0], fmax(cell[1], cell[2]));
    *f = (picture_faces){.cell = {(float)(cell[0] / longest), (float)(cell[1] / longest), (float)(cell[2] / longest)}};
    s.grid = joined(&v->grid, s.factor);
    s.layers = calloc(scan_words(&s.grid), sizeof *s.layers);
    if (!s.layers)
        return false;
    for (size_t faces = FACES_MOST + 1; faces > FACES_MOST; s.factor += faces > FACES_MOST) {
        s.grid = joined(&v->grid, s.factor);
        s.row_words = voxels_row_words(&s.grid);
        s.layer_words = voxels_layer_words(&s.grid);
        memset(s.layers + 3 * s.layer_words, 0, s.layer_words * sizeof *s.layers);
        scan_faces(&s, f);
        faces = split_lists(f);
        f->all = faces <= FACES_MOST ? malloc((faces + 1) * sizeof *f->all) : NULL;
    }
    if (f->all) {
        split_lists(f);
        scan_faces(&s, f);
        find_bounds(f);
        f->factor = s.factor;
    }
    free(s.layers);
    return f->all;
}

void picture_faces_free(picture_faces *f) { free(f->all); }
