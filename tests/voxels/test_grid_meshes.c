/*
 * test_grid_meshes.c - real meshes in grids of several resolutions, cubic and not, some with planes through vertices: EXACT from
 * every kernel against the oracle. Skipped (exit code 77) without a folder of meshes.
 */
#include "cells.h"

#include <math.h>

#include "common/harness.h"
#include "common/real_meshes.h"

enum {
    TRIANGLES_MAX = CELLS_TRIANGLES - 1, /* of a mesh, evenly spread: the oracle looks at every cell of every one */
    ASKED_MAX = 1000000                  /* cells of one grid that the oracle is asked about */
};

static const int resolutions[] = {7, 32, 64, 130, 300};

static cells_case drawn;

/*
 * About `resolution` cells along the longest side. Kind 0: cubes from the lowest corner of the mesh; 1: a length for each axis;
 * 2: the origin is a vertex, so that a part lies outside; 3: cells that end at both ends of the bounds.
 */
static void draw_grid(random_source *r, const mesh *m, const tribox_box *bounds, int resolution, int kind)
{
    tribox_grid *const grid = &drawn.grid;
    double longest = 0;
    for (int a = 0; a < 3; a++)
        longest = fmax(longest, (double)bounds->hi[a] - bounds->lo[a]);
    const size_t vertex = (size_t)(random_bits(r) % m->count);
    for (int a = 0; a < 3; a++) {
        const double extent = fmax((double)bounds->hi[a] - bounds->lo[a], longest / resolution);
        const int cells = kind == 1 ? random_int_between(r, 1, resolution) : resolution;
        const double cell = kind == 1 || kind == 3 ? extent / cells : longest / resolution;
        grid->cell[a] = (float)cell;
        grid->size[a] = (uint32_t)fmin(ceil(extent / cell), cells);
        grid->origin[a] = (float)bounds->lo[a];
        if (kind == 2) {
            grid->origin[a] = m->coordinate[vertex % 3][a][vertex];
            grid->size[a] = (uint32_t)random_int_between(r, 1, resolution);
        }
    }
    cells_open(&drawn);
}

/* Triangles evenly spread over the mesh, until the oracle has enough to do. */
static void choose_triangles(const mesh *m)
{
    size_t cost = 0;
    drawn.count = 0;
    for (size_t i = 0; i < m->count && drawn.count < TRIANGLES_MAX && cost < ASKED_MAX; i += m->count / TRIANGLES_MAX + 1) {
        double u[3][3];
        for (int n = 0; n < 9; n++)
            u[n / 3][n % 3] = m->coordinate[n / 3][n % 3][i];
        cells_put(&drawn, u);
        cost += cells_cost(&drawn, drawn.count - 1, TRIBOX_AXES_ALL);
    }
}

static size_t try_grid(void)
{
    const size_t words = cells_words(&drawn);
    uint64_t *const expected = cells_make(words), *const occupied = cells_make(words);
    tally others = {0};
    const size_t asked = cells_expect(&drawn, 0, drawn.count, TRIBOX_AXES_ALL, expected);
    for (int kernel = 0; kernel < kernels; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            drawn.options = (tribox_options){.kernel = names[kernel], .accuracy = (tribox_accuracy)accuracy};
            cells_ask(&drawn, 0, drawn.count, occupied);
            if (accuracy == TRIBOX_EXACT)
                cells_check(&drawn, 0, drawn.count, expected, occupied);
            else
                cells_check_band(&drawn, expected, occupied, &others);
        }
    free(expected);
    free(occupied);
    return asked;
}

static void try_mesh(const arguments *given, const char *name, const mesh *m)
{
    random_source r = random_named(given->seed, name);
    const tribox_box bounds = mesh_bounds(m);
    size_t asked = 0;
    args = *given;
    kernels = kernels_here(names);
    drawn.scene = name;
    for (size_t k = 0; k < sizeof resolutions / sizeof resolutions[0]; k++)
        for (int kind = 0; kind < 4; kind++) {
            draw_grid(&r, m, &bounds, resolutions[k], kind);
            choose_triangles(m);
            asked += try_grid();
        }
    printf("%-20s %7zu triangles, oracle asked about %zu cells\n", name, m->count, asked);
}

int main(int argc, char **argv) { return real_meshes_main(argc, argv, try_mesh); }
