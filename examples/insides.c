/*
 * insides.c - fills a closed mesh and an open one, by either way; prints a cut through each.
 *
 *     cc -std=c11 -O2 insides.c $(pkg-config --cflags --libs tribox) -o insides && ./insides
 */
#define _DEFAULT_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <tribox.h>

#include "large_pages.h"

enum { SIDES = 8 };

/* An octahedron: x[v][i] is the x of vertex v of triangle i. */
static float x[3][SIDES], y[3][SIDES], z[3][SIDES];
static const tribox_grid grid = {.origin = {-12, -12, -12}, .cell = {1, 1, 1}, .size = {36, 24, 24}};

static void make_octahedron(void)
{
    const float radius = 10.25f;
    for (int i = 0; i < SIDES; i++) {
        x[0][i] = i & 1 ? radius : -radius;
        y[1][i] = i & 2 ? radius : -radius;
        z[2][i] = i & 4 ? radius : -radius;
    }
}

static void print_cut(const uint64_t *occupied, const uint64_t *solid)
{
    const uint32_t k = 14, words = (uint32_t)tribox_mask_words(grid.size[0]);
    for (uint32_t j = 0; j < grid.size[1]; j++) {
        const size_t row = (k * grid.size[1] + j) * words;
        for (uint32_t i = 0; i < grid.size[0]; i++)
            putchar(occupied[row + i / 64] >> i % 64 & 1 ? '#' : solid[row + i / 64] >> i % 64 & 1 ? '+' : '.');
        putchar('\n');
    }
}

/* The first `count` sides of the octahedron. Returns false where memory does not suffice. */
static int fill(size_t count)
{
    const tribox_soup soup = {{x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {z[0], z[1], z[2]}, count};
    const size_t bytes = tribox_window_words(grid.size) * sizeof(uint64_t);
    uint64_t *occupied = calloc(1, bytes), *solid = malloc(bytes); /* a bit for each cell; the surface is clear at first */
    void *scratch = malloc(tribox_fill_bytes(grid.size));
    size_t inside, odd_rows;
    const char *failed = "out of memory";
    want_large_pages(occupied, bytes);
    want_large_pages(solid, bytes);
    if (occupied && solid && scratch) {
        tribox_status status = tribox_voxelize(&soup, &grid, NULL, NULL, occupied, NULL);
        if (!status)
            status = tribox_fill_outside(grid.size, occupied, scratch, solid, &inside);
        if (!status) {
            printf("%zu sides, what the outside does not reach: %zu cells\n", count, inside);
            print_cut(occupied, solid);
            status = tribox_fill_parity(&soup, &grid, occupied, scratch, solid, &inside, &odd_rows);
        }
        if (!status) {
            printf("%zu sides, by parity: %zu cells, %zu odd rows\n", count, inside, odd_rows);
            print_cut(occupied, solid);
        }
        failed = status ? tribox_status_text(status) : NULL;
    }
    if (failed)
        fprintf(stderr, "%s\n", failed);
    free(occupied);
    free(solid);
    free(scratch);
    return !failed;
}

int main(void)
{
    make_octahedron();
    return fill(SIDES) && fill(SIDES - 1) ? EXIT_SUCCESS : EXIT_FAILURE;
}
