/*
 * test_bricks_far.c - grids of up to 2^20 cells along each axis, whose dense bits no call could write: bricks of a few tiles have
 * the cells that overlap, each asked by its own box, in float and double.
 */
#include <math.h>

#include "common/harness.h"
#include "common/contact.h"
#include "common/grid_planes.h"

enum { TRIANGLES = 40, SAMPLES = 400, ROUNDS = 500, SIDE = 128, BRICKS = SIDE / 8 };

/* One tile of a huge grid, and triangles about it. */
typedef struct far_tile {
    tribox_grid grid;
    uint32_t at[3]; /* in tiles */
    float streams[9][TRIANGLES];
    double corners[TRIANGLES][9];
    uint8_t cells[SIDE][SIDE][SIDE]; /* those of bricks, by z, y, x */
    size_t set;
} far_tile;

static far_tile drawn;

static int take(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    far_tile *const t = data;
    for (int a = 0; a < 3; a++)
        assert_true(at[a] / BRICKS == t->at[a]);
    for (uint32_t k = 0; k < 8; k++)
        for (uint32_t n = 0; n < 64; n++)
            if (bits[k] >> n & 1) {
                t->cells[at[2] % BRICKS * 8 + k][at[1] % BRICKS * 8 + n / 8][at[0] % BRICKS * 8 + n % 8] = 1;
                t->set++;
            }
    return 0;
}

static size_t number_of(const far_tile *t)
{
    const size_t along[2] = {t->grid.size[0] / SIDE, t->grid.size[1] / SIDE};
    return ((size_t)t->at[2] * along[1] + t->at[1]) * along[0] + t->at[0];
}

/* Triangles of about a tile's size and smaller, with corners on planes now and then. */
static void draw(random_source *r, far_tile *t)
{
    for (int a = 0; a < 3; a++) {
        t->grid.size[a] = (uint32_t)1 << random_int_between(r, 13, 20);
        t->grid.cell[a] = random_int(r, 2) ? 0.1 : random_double(r, 0.5, 2);
        t->grid.origin[a] = random_int(r, 2) ? 0 : -0.5 * t->grid.size[a] * t->grid.cell[a];
        const uint32_t tiles = t->grid.size[a] / SIDE;
        t->at[a] = random_int(r, 2) ? (uint32_t)random_int(r, (int)tiles) : random_int(r, 2) ? tiles - 1 : 0;
    }
    for (int i = 0; i < TRIANGLES; i++) {
        const double radius = pow(2, random_double(r, -2, 8));
        double middle[3];
        for (int a = 0; a < 3; a++)
            middle[a] = random_double(r, -10, SIDE + 10);
        for (int n = 0; n < 9; n++) {
            const int a = n % 3;
            const double place = (double)t->at[a] * SIDE + middle[a] + random_double(r, -radius, radius);
            const float u = grid_planes_place(&t->grid, a, random_int(r, 3) ? place : floor(place));
            t->streams[n][i] = u;
            t->corners[i][n] = (double)u;
        }
    }
    memset(t->cells, 0, sizeof t->cells);
    t->set = 0;
}

static tribox_soup soup_of(const far_tile *t)
{
    tribox_soup soup = {.count = TRIANGLES};
    for (int v = 0; v < 3; v++) {
        soup.x[v] = t->streams[3 * v];
        soup.y[v] = t->streams[3 * v + 1];
        soup.z[v] = t->streams[3 * v + 2];
    }
    return soup;
}

static tribox_mesh mesh_of(const far_tile *t)
{
    return (tribox_mesh){.positions = t->corners, .vertices = 3 * TRIANGLES, .count = TRIANGLES, .position_bytes = 8};
}

static void make_bricks(far_tile *t, bool is_double, const tribox_options *options)
{
    const tribox_soup soup = soup_of(t);
    const tribox_mesh mesh = mesh_of(t);
    size_t starts[2];
    uint32_t list[TRIANGLES];
    tribox_report report;
    void *const scratch = malloc(tribox_bricks_bytes(SIDE));
    assert_non_null(scratch);
    const tribox_tiles one = {SIDE, number_of(t), 1};
    const tribox_sink sink = {take, t};
    for (int pass = 0; pass < 2; pass++)
        assert_int_equal(is_double ? tribox_mesh_tile_lists(&mesh, &t->grid, &one, options, starts, pass ? list : NULL)
                                   : tribox_tile_lists(&soup, &t->grid, &one, options, starts, pass ? list : NULL),
                         TRIBOX_OK);
    assert_int_equal(is_double ? tribox_mesh_bricks(&mesh, &t->grid, &one, starts, list, options, scratch, &sink, &report)
                               : tribox_bricks(&soup, &t->grid, &one, starts, list, options, scratch, &sink, &report),
                     TRIBOX_OK);
    free(scratch);
    assert_int_equal(report.overlapping, t->set);
}

/* Whether any triangle overlaps a cell of the tile, by its box. */
static bool overlaps(const far_tile *t, bool is_double, const uint32_t cell[3])
{
    const tribox_soup soup = soup_of(t);
    const tribox_mesh mesh = mesh_of(t);
    const tribox_options scalar = {.kernel = "scalar"};
    tribox_report report;
    uint32_t p[3];
    for (int a = 0; a < 3; a++)
        p[a] = t->at[a] * SIDE + cell[a];
    const tribox_box box = tribox_grid_cell(&t->grid, p[0], p[1], p[2]);
    assert_int_equal(is_double ? tribox_mesh_overlap(&mesh, &box, &scalar, NULL, &report)
                               : tribox_overlap(&soup, &box, &scalar, NULL, &report),
                     TRIBOX_OK);
    return report.overlapping > 0;
}

/* Cells anywhere, and beside those that are set. */
static void check_sample(random_source *r, const far_tile *t, bool is_double)
{
    uint32_t cell[3];
    for (int a = 0; a < 3; a++)
        cell[a] = (uint32_t)random_int(r, SIDE);
    for (int n = random_int(r, 3 * SIDE); n > 0 && !t->cells[cell[2]][cell[1]][cell[0]]; n--)
        cell[n % 3] = (cell[n % 3] + 1) % SIDE;
    if (random_int(r, 2)) {
        const int a = random_int(r, 3);
        cell[a] = (cell[a] + SIDE - 1) % SIDE;
    }
    assert_int_equal(t->cells[cell[2]][cell[1]][cell[0]], overlaps(t, is_double, cell));
}

CASE(test_far)
{
    random_source r = random_named(args.seed, "far");
    for (size_t round = 0; round < arguments_rounds(&args, 100000 / ROUNDS); round++) {
        const bool is_double = round % 3 == 2;
        const tribox_options options = {.kernel = names[random_int(&r, kernels)]};
        draw(&r, &drawn);
        make_bricks(&drawn, is_double, &options);
        for (int n = 0; n < SAMPLES; n++)
            check_sample(&r, &drawn, is_double);
    }
}

PROGRAM(RUN(test_far))
