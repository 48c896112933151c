/*
 * bricks.c - voxelizes a soup into a grid that no memory holds, tile by tile; prints a few of the bricks, and how many there are.
 *
 *     cc -std=c11 -O2 bricks.c $(pkg-config --cflags --libs tribox) -o bricks && ./bricks
 */
#include <stdio.h>
#include <stdlib.h>
#include <tribox.h>

enum { TRIANGLES = 8, TILE = 128, SIDE = 8192 };

/* An octahedron: x[v][i] is the x of vertex v of triangle i. */
static float x[3][TRIANGLES], y[3][TRIANGLES], z[3][TRIANGLES];
static const tribox_soup soup = {{x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {z[0], z[1], z[2]}, TRIANGLES};

/* As bits 64 GiB; the surface touches one cell in four thousand. */
static const tribox_grid grid = {.origin = {-1, -1, -1}, .cell = {0x1p-12, 0x1p-12, 0x1p-12}, .size = {SIDE, SIDE, SIDE}};

static void make_soup(void)
{
    for (int i = 0; i < TRIANGLES; i++) {
        x[0][i] = i & 1 ? 0.9f : -0.9f;
        y[1][i] = i & 2 ? 0.9f : -0.9f;
        z[2][i] = i & 4 ? 0.9f : -0.9f;
    }
}

/* Gets every brick that is not empty: 8 x 8 x 8 cells, a bit each. This one would be the place to write or to send them. */
static int take(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    size_t *const bricks = data;
    if (++*bricks <= 3) {
        printf("brick %zu, from cell (%u, %u, %u) on, its highest layer:\n", *bricks, 8 * at[0], 8 * at[1], 8 * at[2]);
        for (int j = 0; j < 8; j++) {
            for (int i = 0; i < 8; i++)
                putchar(bits[7] >> (8 * j + i) & 1 ? '#' : '.');
            putchar('\n');
        }
    }
    return 0; /* go on */
}

/* What there is memory for, or the end. */
static void *allocate(size_t bytes)
{
    void *const memory = malloc(bytes + 1);
    if (memory)
        return memory;
    fputs("out of memory\n", stderr);
    exit(EXIT_FAILURE);
}

int main(void)
{
    const size_t count = tribox_tile_count(grid.size, TILE);
    const tribox_tiles tiles = {TILE, 0, count}; /* all at once; a thread, or a machine, would take its share of them */
    size_t *const starts = allocate((count + 1) * sizeof *starts), bricks = 0;
    void *const scratch = allocate(tribox_bricks_bytes(TILE));
    const tribox_sink sink = {take, &bricks};
    tribox_report report = {0, 0};
    make_soup();

    /* Which triangles each tile has to look at: counted, then listed. */
    tribox_status status = tribox_tile_lists(&soup, &grid, &tiles, NULL, starts, NULL);
    uint32_t *const list = allocate((status ? 0 : starts[count]) * sizeof *list);
    if (!status)
        status = tribox_tile_lists(&soup, &grid, &tiles, NULL, starts, list);

    if (!status)
        status = tribox_bricks(&soup, &grid, &tiles, starts, list, NULL, scratch, &sink, &report);
    if (status)
        fprintf(stderr, "%s\n", tribox_status_text(status));
    else
        printf("%zu cells in %zu bricks, of %zu tiles\n", report.overlapping, bricks, count);
    free(list);
    free(starts);
    free(scratch);
    return status ? EXIT_FAILURE : EXIT_SUCCESS;
}
