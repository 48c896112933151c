/*
 * voxels_threads.c - voxelizes a soup with threads, each of which owns some layers; prints one layer.
 *
 *     cc -std=c11 -O2 voxels_threads.c $(pkg-config --cflags --libs tribox) -pthread -o voxels_threads && ./voxels_threads
 */
#define _DEFAULT_SOURCE
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <tribox.h>

#include "large_pages.h"

enum { SHELLS = 3, TRIANGLES = 8 * SHELLS, THREADS = 4 };

/* Octahedra, one within another: x[v][i] is the x of vertex v of triangle i. */
static float x[3][TRIANGLES], y[3][TRIANGLES], z[3][TRIANGLES];
static const tribox_soup soup = {{x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {z[0], z[1], z[2]}, TRIANGLES};
static const tribox_grid grid = {.origin = {-12, -12, -12}, .cell = {0.5, 0.5, 0.5}, .size = {48, 48, 48}};

typedef struct share {
    uint32_t first, layers; /* layers first .. first + layers - 1 along z */
    uint64_t *occupied;     /* the words of these layers, which no other thread writes */
    tribox_status status;
    tribox_report report;
} share;

static void make_soup(void)
{
    static const float radius[SHELLS] = {11.25f, 7.25f, 3.25f};
    for (int i = 0; i < TRIANGLES; i++) {
        x[0][i] = i & 1 ? radius[i / 8] : -radius[i / 8];
        y[1][i] = i & 2 ? radius[i / 8] : -radius[i / 8];
        z[2][i] = i & 4 ? radius[i / 8] : -radius[i / 8];
    }
}

static void *work(void *data)
{
    share *s = data;
    const tribox_window window = {{0, 0, s->first}, {grid.size[0], grid.size[1], s->layers}};
    s->status = tribox_voxelize(&soup, &grid, &window, NULL, s->occupied, &s->report);
    return NULL;
}

static void print_layer(const uint64_t *occupied, uint32_t k)
{
    for (uint32_t j = 0; j < grid.size[1]; j++) {
        const uint64_t *row = occupied + (k * grid.size[1] + j) * tribox_mask_words(grid.size[0]);
        for (uint32_t i = 0; i < grid.size[0]; i++)
            putchar(row[i / 64] >> i % 64 & 1 ? '#' : '.');
        putchar('\n');
    }
}

int main(void)
{
    const size_t words = tribox_window_words(grid.size);
    uint64_t *occupied = calloc(words, sizeof *occupied); /* a bit for each cell, clear at first */
    if (!occupied) {
        fprintf(stderr, "out of memory\n");
        return 1;
    }
    want_large_pages(occupied, words * sizeof *occupied);
    make_soup();

    share shares[THREADS];
    pthread_t threads[THREADS];
    const size_t layer_words = tribox_mask_words(grid.size[0]) * grid.size[1];
    for (uint32_t t = 0; t < THREADS; t++) {
        const uint32_t first = t * grid.size[2] / THREADS, end = (t + 1) * grid.size[2] / THREADS;
        shares[t] = (share){.first = first, .layers = end - first, .occupied = occupied + first * layer_words};
        if (pthread_create(&threads[t], NULL, work, &shares[t]) != 0) {
            fprintf(stderr, "cannot start a thread\n");
            return 1;
        }
    }

    size_t cells = 0;
    for (int t = 0; t < THREADS; t++) {
        pthread_join(threads[t], NULL);
        if (shares[t].status != TRIBOX_OK) {
            fprintf(stderr, "tribox: %s\n", tribox_status_text(shares[t].status));
            return 1;
        }
        cells += shares[t].report.overlapping;
    }
    printf("%zu of %u cells are occupied; this is layer 20:\n", cells, 48u * 48 * 48);
    print_layer(occupied, 20);
    free(occupied);
    return 0;
}
