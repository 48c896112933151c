/* volume_vox.c - MagicaVoxel's format: https://github.com/ephtracy/voxel-model, MagicaVoxel-file-format-vox.txt and -extension.txt */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "read/little.h"
#include "console/message.h"
#include "volume.h"

/* A model has 256 cells a side at most; a colour is an index of the palette, where 1 is white by default. */
enum { SIDE = 256, COLOUR = 1, CHUNK_HEADER = 12 };

/* The bytes of a model's two chunks, SIZE and XYZI, and at most those of its nodes in the scene graph. */
enum { MODEL_BYTES = CHUNK_HEADER + 12 + CHUNK_HEADER + 4, NODE_BYTES = 160 };

static uint32_t models_along(const tribox_grid *grid, int a) { return (grid->size[a] + SIDE - 1) / SIDE; }

static uint64_t models_of(const tribox_grid *grid)
{
    return (uint64_t)models_along(grid, 0) * models_along(grid, 1) * models_along(grid, 2);
}

int volume_check_vox(const char *path, const tribox_grid *grid, uint64_t occupied)
{
    const uint64_t models = models_of(grid);
    if (models < INT32_MAX / NODE_BYTES && 4 * occupied + models * (MODEL_BYTES + NODE_BYTES) < INT32_MAX)
        return EXIT_CODE_OK;
    return message_failure("%s: a .vox file ends at 2 GiB, which %" PRIu64 " occupied cells exceed; choose fewer cells, or .npy, "
                           ".binvox or .raw",
                           path, occupied);
}

/* Some cells of the grid: from lo, size on each axis. */
typedef struct model {
    uint32_t lo[3], size[3];
} model;

static model model_at(const tribox_grid *grid, uint64_t index)
{
    model m;
    for (int a = 0; a < 3; a++) {
        m.lo[a] = (uint32_t)(index % models_along(grid, a)) * SIDE;
        m.size[a] = grid->size[a] - m.lo[a] < SIDE ? grid->size[a] - m.lo[a] : SIDE;
        index /= models_along(grid, a);
    }
    return m;
}

/* lo[0] is a multiple of 64, so that a model owns whole words; bits past the end of a row are zero. */
static size_t words_of(const model *m) { return (m->size[0] + 63) / 64; }

static const uint64_t *row_of(const voxels *v, const model *m, uint32_t j, uint32_t k)
{
    return voxels_layer(v, m->lo[2] + k) + (m->lo[1] + j) * tribox_grid_row_words(&v->grid) + m->lo[0] / 64;
}

static uint64_t cells_of(const voxels *v, const model *m)
{
    uint64_t cells = 0;
    for (uint32_t k = 0; k < m->size[2]; k++)
        for (uint32_t j = 0; j < m->size[1]; j++)
            cells += voxels_count(row_of(v, m, j, k), words_of(m));
    return cells;
}

static void put(FILE *to, uint32_t number)
{
    unsigned char bytes[4];
    little_put32(bytes, number);
    fwrite(bytes, 1, sizeof bytes, to);
}

static void put_string(FILE *to, const char *text)
{
    put(to, (uint32_t)strlen(text));
    fputs(text, to);
}

static void start_chunk(FILE *to, const char *id, uint64_t bytes)
{
    fputs(id, to);
    put(to, (uint32_t)bytes);
    put(to, 0);
}

static void write_cells(FILE *to, const voxels *v, const model *m)
{
    for (uint32_t k = 0; k < m->size[2] && !ferror(to); k++)
        for (uint32_t j = 0; j < m->size[1]; j++) {
            const uint64_t *row = row_of(v, m, j, k);
            for (uint32_t i = 0; i < m->size[0]; i++)
                if (voxels_bit(row, i)) {
                    const unsigned char cell[4] = {(unsigned char)i, (unsigned char)j, (unsigned char)k, COLOUR};
                    fwrite(cell, 1, sizeof cell, to);
                }
        }
}

static void write_model(FILE *to, const voxels *v, const model *m)
{
    const uint64_t cells = cells_of(v, m);
    start_chunk(to, "SIZE", 12);
    for (int a = 0; a < 3; a++)
        put(to, m->size[a]);
    start_chunk(to, "XYZI", 4 + 4 * cells);
    put(to, (uint32_t)cells);
    write_cells(to, v, m);
}

/* A node that places its child; text: where, or NULL for the root. */
static void write_transform(FILE *to, uint32_t node, uint32_t child, const char *text)
{
    start_chunk(to, "nTRN", 28 + (text ? 4 + 2 + 4 + strlen(text) : 0));
    put(to, node);
    put(to, 0); /* attributes: none */
    put(to, child);
    put(to, UINT32_MAX);            /* reserved: -1 */
    put(to, text ? 0 : UINT32_MAX); /* layer */
    put(to, 1);                     /* frames */
    put(to, text ? 1 : 0);          /* entries of the frame */
    if (text) {
        put_string(to, "_t");
        put_string(to, text);
    }
}

static void write_shape(FILE *to, uint32_t node, uint32_t index)
{
    start_chunk(to, "nSHP", 20);
    put(to, node);
    put(to, 0); /* attributes */
    put(to, 1); /* models */
    put(to, index);
    put(to, 0); /* attributes of the model */
}

/* The translation of a model places its cell size / 2, rounded down; the middle cell of the grid comes to 0 0 0. */
static void write_place(FILE *to, const tribox_grid *grid, uint32_t index)
{
    const model m = model_at(grid, index);
    char text[40];
    long at[3];
    for (int a = 0; a < 3; a++)
        at[a] = (long)(m.lo[a] + m.size[a] / 2) - (long)(grid->size[a] / 2);
    snprintf(text, sizeof text, "%ld %ld %ld", at[0], at[1], at[2]);
    write_transform(to, 2 + 2 * index, 3 + 2 * index, text);
    write_shape(to, 3 + 2 * index, index);
}

static void write_scene(FILE *to, const tribox_grid *grid, uint32_t models)
{
    write_transform(to, 0, 1, NULL);
    start_chunk(to, "nGRP", 12 + 4 * (uint64_t)models);
    put(to, 1);
    put(to, 0); /* attributes */
    put(to, models);
    for (uint32_t m = 0; m < models; m++)
        put(to, 2 + 2 * m);
    for (uint32_t m = 0; m < models; m++)
        write_place(to, grid, m);
}

/* The bytes of all chunks are written into that of MAIN last, when they are known. */
static void complete_main(FILE *to)
{
    enum { BEFORE_CHUNKS = 8 + CHUNK_HEADER };
    const long end = ftell(to);
    if (end < 0 || fseek(to, BEFORE_CHUNKS - 4, SEEK_SET))
        return;
    put(to, (uint32_t)(end - BEFORE_CHUNKS));
    fseek(to, 0, SEEK_END);
}

void volume_write_vox(FILE *to, const voxels *v, progress *bar)
{
    const uint32_t models = (uint32_t)models_of(&v->grid);
    fputs("VOX ", to);
    put(to, 150);
    start_chunk(to, "MAIN", 0);
    for (uint32_t index = 0; index < models && !ferror(to); index++) {
        const model m = model_at(&v->grid, index);
        write_model(to, v, &m);
        progress_tell(bar, (index + 1.0) / models);
    }
    if (models > 1)
        write_scene(to, &v->grid, models);
    complete_main(to);
}
