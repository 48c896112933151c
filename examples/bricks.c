/*
 * bricks.c - a surface tile by tile, without a bit for every cell of its grid: as a hash of its bricks, and as spans of cells along
 * its height, as terrain and navigation keep them. Prints how many there are, and the time that the dense way takes.
 *
 *     cc -std=c11 -O2 bricks.c $(pkg-config --cflags --libs tribox) -o bricks && ./bricks
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <tribox.h>

enum { TRIANGLES = 8, TILE = 128, SIDE = 1024, ROOM = 1 << 17 };

/*
 * An octahedron: x[v][i] is the x of vertex v of triangle i. Streams change places for nothing, as the axes of a tribox_mesh
 * do: the height comes first, so that spans are runs of bits.
 */
static float x[3][TRIANGLES], y[3][TRIANGLES], z[3][TRIANGLES];
static const tribox_soup soup = {{z[0], z[1], z[2]}, {y[0], y[1], y[2]}, {x[0], x[1], x[2]}, TRIANGLES};
static const tribox_grid grid = {.origin = {-1, -1, -1}, .cell = {0x1p-9, 0x1p-9, 0x1p-9}, .size = {SIDE, SIDE, SIDE}};
static const tribox_tiles tiles = {TILE, 0, (SIDE / TILE) * (SIDE / TILE) * (SIDE / TILE)}; /* all: a thread would take a share */

static void make_soup(void)
{
    for (int i = 0; i < TRIANGLES; i++) {
        x[0][i] = i & 1 ? 0.9f : -0.9f;
        y[1][i] = i & 2 ? 0.9f : -0.9f;
        z[2][i] = i & 4 ? 0.9f : -0.9f;
    }
}

/* What there is memory for, all zero, or the end. */
static void *allocate(size_t count, size_t bytes)
{
    void *const memory = calloc(count + 1, bytes);
    if (memory)
        return memory;
    fputs("out of memory\n", stderr);
    exit(EXIT_FAILURE);
}

static void check(tribox_status status)
{
    if (status)
        fprintf(stderr, "%s\n", tribox_status_text(status)), exit(EXIT_FAILURE);
}

static double milliseconds(clock_t since) { return 1e3 * (double)(clock() - since) / CLOCKS_PER_SEC; }

/* A hash of the bricks that are not empty. */
typedef struct brick {
    uint32_t at[3], is_there;
    uint64_t bits[8];
} brick;

static brick *find(brick *hash, const uint32_t at[3])
{
    size_t n = (at[0] * 73856093u ^ at[1] * 19349663u ^ at[2] * 83492791u) % ROOM;
    while (hash[n].is_there && memcmp(hash[n].at, at, sizeof hash[n].at) != 0)
        n = (n + 1) % ROOM;
    return &hash[n];
}

static int keep(void *hash, const uint32_t at[3], const uint64_t bits[8])
{
    brick *const b = find(hash, at);
    b->is_there = 1;
    memcpy(b->at, at, sizeof b->at);
    memcpy(b->bits, bits, sizeof b->bits);
    return 0; /* go on */
}

static int is_set(brick *hash, uint32_t i, uint32_t j, uint32_t k)
{
    return find(hash, (const uint32_t[]){i / 8, j / 8, k / 8})->bits[k % 8] >> (i % 8 + 8 * (j % 8)) & 1;
}

/* Spans, each above the one before it in its column, of which the last is known: number 0 is none. */
typedef struct spans {
    struct span {
        uint32_t from, end, below;
    } * span;
    uint32_t *top, count;
} spans;

static void add(spans *s, uint32_t height, uint32_t column)
{
    uint32_t *const top = &s->top[column];
    if (*top && s->span[*top].end == height) {
        s->span[*top].end++;
    } else {
        s->span[++s->count] = (struct span){height, height + 1, *top};
        *top = s->count;
    }
}

/* Tiles, and the bricks of each, come with their heights rising in every column. */
static int stack(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    for (uint32_t n = 0; n < 64; n++)
        for (uint32_t i = 0, column = (uint32_t)(bits[n / 8] >> n % 8 * 8 & 255); column >> i; i++)
            if (column >> i & 1)
                add(data, 8 * at[0] + i, (8 * at[2] + n / 8) * SIDE + 8 * at[1] + n % 8);
    return 0;
}

/* By bricks: lists of the triangles of each tile, counted, then written, and their cells. */
static size_t voxelize(int (*take)(void *, const uint32_t *, const uint64_t *), void *data)
{
    size_t *const starts = allocate(tiles.count, sizeof *starts);
    void *const scratch = allocate(tribox_bricks_bytes(TILE), 1);
    tribox_report report;
    check(tribox_tile_lists(&soup, &grid, &tiles, NULL, starts, NULL));
    uint32_t *const list = allocate(starts[tiles.count], sizeof *list);
    check(tribox_tile_lists(&soup, &grid, &tiles, NULL, starts, list));
    check(tribox_bricks(&soup, &grid, &tiles, starts, list, NULL, scratch, &(tribox_sink){take, data}, &report));
    free(list);
    free(scratch);
    free(starts);
    return report.overlapping;
}

int main(void)
{
    spans s = {allocate(4 * SIDE * SIDE, sizeof *s.span), allocate(SIDE * SIDE, sizeof *s.top), 0}, t = s;
    brick *const hash = allocate(ROOM, sizeof *hash);
    make_soup();
    clock_t start = clock();
    size_t cells = voxelize(keep, hash), bricks = 0;
    printf("a hash of bricks: %.1f ms, ", milliseconds(start));
    for (size_t n = 0; n < ROOM; n++)
        bricks += hash[n].is_there;
    printf("%zu cells in %zu bricks; at the middle %d, at a vertex %d\n", cells, bricks, is_set(hash, 512, 512, 512),
           is_set(hash, 972, 512, 512));
    start = clock();
    voxelize(stack, &s);
    printf("spans: %.1f ms, %u of them\n", milliseconds(start), s.count);

    /* The dense way: a bit for each cell, and the numbers of those that are set. */
    start = clock();
    uint64_t *const bits = allocate(tribox_window_words(grid.size), sizeof *bits);
    check(tribox_voxelize(&soup, &grid, NULL, NULL, bits, NULL));
    printf("dense: %.1f ms for the bits, ", milliseconds(start));
    cells = tribox_window_cells(bits, grid.size, NULL);
    uint32_t(*const cell)[3] = allocate(cells, sizeof *cell);
    tribox_window_cells(bits, grid.size, cell);
    memset(s.top, 0, SIDE * SIDE * sizeof *s.top);
    for (size_t n = 0; n < cells; n++)
        add(&t, cell[n][0], cell[n][2] * SIDE + cell[n][1]);
    printf("%.1f with %u spans\n", milliseconds(start), t.count);
    free(cell);
    free(bits);
    free(hash);
    free(s.span);
    free(s.top);
    return 0;
}
