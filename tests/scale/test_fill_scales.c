/* test_fill_scales.c - a closed mesh and its grid fill the same cells by parity, whatever power of two scales each axis. */
#include <math.h>

#include "common/harness.h"
#include "common/closed_meshes.h"

/* Numbers are multiples of 2^-FINE cells and below 2^COARSE: from LEAST to MOST no scale rounds any of them, nor a middle. */
enum { FINE = 20, COARSE = 10, LEAST = -1074 + FINE, MOST = 1023 - COARSE };
enum { SIDE = 20, TRIANGLES = 400, ROUNDS = 12, PAIRS = 100000, SCALES = 200 };

typedef struct scaled_mesh {
    double u[TRIANGLES][3][3];
    size_t count;
    tribox_grid grid;
    double centre[3], radius[3];
} scaled_mesh;

typedef struct answer {
    uint64_t solid[SIDE * SIDE];
    size_t inside, odd_rows;
} answer;

static void put(void *to, const double a[3], const double b[3], const double c[3])
{
    scaled_mesh *const m = to;
    const double *const from[3] = {a, b, c};
    assert_true(m->count < TRIANGLES);
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++)
            m->u[m->count][v][k] = ldexp(round(ldexp(m->centre[k] + m->radius[k] * from[v][k], FINE)), -FINE);
    m->count++;
}

/* At scale 1: cells of length 1, some of whose middles are on the surface. */
static void draw(random_source *r, scaled_mesh *m)
{
    m->count = 0;
    for (int a = 0; a < 3; a++) {
        m->grid.origin[a] = random_int_between(r, -40, 40) / 4.0;
        m->grid.cell[a] = 1;
        m->grid.size[a] = (uint32_t)random_int_between(r, 1, SIDE);
        m->centre[a] = m->grid.origin[a] + random_int(r, 2 * (int)m->grid.size[a]) / 2.0;
        m->radius[a] = random_int(r, 3) ? random_double(r, 1, SIDE) : random_int_between(r, 1, SIDE);
    }
    closed_any(&(closed_mesh_sink){put, m}, r);
}

static void ask(const scaled_mesh *m, const int scale[3], answer *to)
{
    static double u[TRIANGLES][3][3];
    static uint64_t none[SIDE * SIDE], scratch[2 * SIDE * SIDE];
    tribox_grid grid = m->grid;
    for (size_t n = 0; n < 9 * m->count; n++)
        u[n / 9][n / 3 % 3][n % 3] = ldexp(m->u[n / 9][n / 3 % 3][n % 3], scale[n % 3]);
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = ldexp(grid.origin[a], scale[a]);
        grid.cell[a] = ldexp(grid.cell[a], scale[a]);
    }
    const tribox_mesh mesh = {.positions = u, .vertices = 3 * m->count, .count = m->count, .position_bytes = 8};
    memset(to, 0, sizeof *to);
    assert_true(tribox_fill_bytes(grid.size) <= sizeof scratch);
    assert_int_equal(tribox_mesh_fill_parity(&mesh, &grid, none, scratch, to->solid, &to->inside, &to->odd_rows), TRIBOX_OK);
}

static void check(const scaled_mesh *m, const int scale[3], const answer *expected)
{
    static answer found;
    ask(m, scale, &found);
    if (memcmp(&found, expected, sizeof found))
        fail_msg("%s: %zu inside and %zu odd rows at 2^%d, 2^%d, 2^%d, not %zu and %zu, or in other cells", doing, found.inside,
                 found.odd_rows, scale[0], scale[1], scale[2], expected->inside, expected->odd_rows);
}

/* Each axis anywhere in the range of doubles, or all about one place in it. */
static void draw_scale(random_source *r, int scale[3])
{
    const bool are_near = random_int(r, 2);
    const int place = random_int_between(r, LEAST + 100, MOST - 100);
    for (int a = 0; a < 3; a++)
        scale[a] = are_near ? random_int_between(r, place - 100, place + 100) : random_int_between(r, LEAST, MOST);
}

CASE(test_scales)
{
    static scaled_mesh drawn;
    static answer expected;
    random_source r = random_named(args.seed, "fill scales");
    const int rounds = (int)(ROUNDS * arguments_rounds(&args, PAIRS)) / (arguments_are_short(&args) ? 10 : 1);
    for (int round = 0; round < rounds; round++) {
        int scale[3] = {0, 0, 0};
        draw(&r, &drawn);
        snprintf(doing, sizeof doing, "round %d: %zu triangles", round, drawn.count);
        ask(&drawn, scale, &expected);
        assert_int_equal(expected.odd_rows, 0);
        for (int all = LEAST + round % ROUNDS; all <= MOST; all += ROUNDS) {
            scale[0] = scale[1] = scale[2] = all;
            check(&drawn, scale, &expected);
        }
        for (int n = 0; n < SCALES; n++) {
            draw_scale(&r, scale);
            check(&drawn, scale, &expected);
        }
    }
}

PROGRAM(RUN(test_scales))
