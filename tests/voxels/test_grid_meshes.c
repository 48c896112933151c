/*
 * test_grid_meshes.c - real meshes in grids of several resolutions, cubic and not, some with planes through vertices: EXACT from
 * every kernel against the oracle. Skipped (exit code 77) without a folder of meshes.
 */
#include "occupancy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/real_meshes.h"
#include "common/random_draws.h"

enum {
    TRIANGLES_MAX = TRIANGLE_LIST_MAX - 1, /* of a mesh, evenly spread: the oracle looks at every cell of every one */
    ASKED_MAX = 1000000                    /* cells of one grid that the oracle is asked about */
};

static const int resolutions[] = {7, 32, 64, 130, 300};

static grid_planes at;
static triangle_list triangles;

/*
 * About `resolution` cells along the longest side. Kind 0: cubes from the lowest corner of the mesh; 1: a length for each axis;
 * 2: the origin is a vertex, so that a part lies outside; 3: cells that end at both ends of the bounds.
 */
static void draw_grid(random_source *r, const mesh *m, const tribox_box *bounds, int resolution, int kind)
{
    tribox_grid grid;
    double longest = 0;
    for (int a = 0; a < 3; a++)
        longest = fmax(longest, (double)bounds->hi[a] - bounds->lo[a]);
    const size_t vertex = (size_t)(random_bits(r) % m->count);
    for (int a = 0; a < 3; a++) {
        const double extent = fmax((double)bounds->hi[a] - bounds->lo[a], longest / resolution);
        const int cells = kind == 1 ? random_int_between(r, 1, resolution) : resolution;
        const double cell = kind == 1 || kind == 3 ? extent / cells : longest / resolution;
        grid.cell[a] = (float)cell;
        grid.size[a] = (uint32_t)fmin(ceil(extent / cell), cells);
        grid.origin[a] = (float)bounds->lo[a];
        if (kind == 2) {
            grid.origin[a] = m->coordinate[vertex % 3][a][vertex];
            grid.size[a] = (uint32_t)random_int_between(r, 1, resolution);
        }
    }
    assert_true(grid_planes_make(&at, &grid));
}

/* Triangles evenly spread over the mesh, until the oracle has enough to do. */
static size_t choose_triangles(const mesh *m, uint64_t *expected)
{
    const size_t step = m->count / TRIANGLES_MAX + 1;
    size_t asked = 0;
    triangles.count = 0;
    for (size_t i = 0; i < m->count && triangles.count < TRIANGLES_MAX && asked < ASKED_MAX; i += step) {
        float u[3][3];
        mesh_triangle(m, i, u);
        asked += occupancy_add(&at, (const_vertices)u, TRIBOX_AXES_ALL, expected);
        triangle_list_put(&triangles, (const_vertices)u);
    }
    return asked;
}

static size_t try_grid(request *q, const mesh *m)
{
    const char *kernels[KERNELS_MAX];
    const int kernel_count = kernels_here(kernels);
    uint64_t *const expected = occupancy_make(at.words), *const occupied = occupancy_make(at.words);
    tally conservative = {0}, fast = {0};
    const size_t asked = choose_triangles(m, expected);
    for (int kernel = 0; kernel < kernel_count; kernel++) {
        q->options = (tribox_options){.kernel = kernels[kernel]};
        request_ask(q, 0, triangles.count, occupied);
        request_check_exact(q, 0, triangles.count, expected, occupied);
        q->options.accuracy = TRIBOX_CONSERVATIVE;
        request_ask(q, 0, triangles.count, occupied);
        request_check_band(q, expected, occupied, &conservative);
        q->options.accuracy = TRIBOX_FAST;
        request_ask(q, 0, triangles.count, occupied);
        request_check_band(q, expected, occupied, &fast);
    }
    free(expected);
    free(occupied);
    return asked;
}

static void try_mesh(const arguments *args, const char *name, const mesh *m)
{
    random_source r = random_named(args->seed, name);
    request q = {.scene = name, .seed = args->seed, .at = &at, .triangles = &triangles};
    const tribox_box bounds = mesh_bounds(m);
    size_t asked = 0;
    for (size_t k = 0; k < sizeof resolutions / sizeof resolutions[0]; k++)
        for (int kind = 0; kind < 4; kind++) {
            draw_grid(&r, m, &bounds, resolutions[k], kind);
            asked += try_grid(&q, m);
        }
    printf("%-20s %7zu triangles, oracle asked about %zu cells\n", name, m->count, asked);
}

int main(int argc, char **argv) { return real_meshes_main(argc, argv, try_mesh); }
