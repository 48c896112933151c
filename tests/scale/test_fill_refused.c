/* test_fill_refused.c - bad input of every kind to the calls that fill by parity: nothing is written. */
#include <setjmp.h>
#include <stdarg.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tribox.h"

enum { CELLS = 4, WORDS = CELLS * CELLS, BYTES = 256 };

/* A call's arguments, right until a test spoils one. */
typedef struct call {
    bool is_double;
    float streams[9];
    double corners[3][3];
    tribox_soup soup;
    tribox_mesh mesh;
    tribox_grid grid;
    bool has_triangles, has_grid, has_occupied, has_solid, has_scratch, has_counts;
} call;

static call *right_call(bool is_double)
{
    static call c;
    c = (call){.is_double = is_double,
               .corners = {{2, 0, 0}, {2, 4, 0}, {2, 0, 4}},
               .soup = {.count = 1},
               .mesh = {.positions = c.corners, .vertices = 3, .count = 1, .position_bytes = 8},
               .grid = {{0, 0, 0}, {1, 1, 1}, {CELLS, CELLS, CELLS}},
               .has_triangles = true,
               .has_grid = true,
               .has_occupied = true,
               .has_solid = true,
               .has_scratch = true,
               .has_counts = true};
    for (int v = 0; v < 3; v++) {
        for (int a = 0; a < 3; a++)
            c.streams[3 * v + a] = (float)c.corners[v][a];
        c.soup.x[v] = &c.streams[3 * v];
        c.soup.y[v] = &c.streams[3 * v + 1];
        c.soup.z[v] = &c.streams[3 * v + 2];
    }
    return &c;
}

static bool is_poison(const void *bytes, size_t count)
{
    bool is = true;
    for (size_t n = 0; n < count; n++)
        is = is && ((const unsigned char *)bytes)[n] == 0xa5;
    return is;
}

static void check(const call *c, tribox_status expected)
{
    static const uint64_t occupied[WORDS];
    uint64_t solid[WORDS];
    unsigned char scratch[BYTES];
    size_t inside = 123, odd_rows = 123, *const to[2] = {c->has_counts ? &inside : NULL, c->has_counts ? &odd_rows : NULL};
    assert_true(tribox_fill_bytes((const uint32_t[3]){CELLS, CELLS, CELLS}) <= sizeof scratch);
    memset(solid, 0xa5, sizeof solid);
    memset(scratch, 0xa5, sizeof scratch);
    const uint64_t *const from = c->has_occupied ? occupied : NULL;
    uint64_t *const words = c->has_solid ? solid : NULL;
    void *const bytes = c->has_scratch ? scratch : NULL;
    const tribox_status status = c->is_double
                                     ? tribox_mesh_fill_parity(c->has_triangles ? &c->mesh : NULL, c->has_grid ? &c->grid : NULL,
                                                               from, bytes, words, to[0], to[1])
                                     : tribox_fill_parity(c->has_triangles ? &c->soup : NULL, c->has_grid ? &c->grid : NULL, from,
                                                          bytes, words, to[0], to[1]);
    assert_int_equal(status, expected);
    if (expected) {
        assert_true(is_poison(solid, sizeof solid) && is_poison(scratch, sizeof scratch));
        assert_true(inside == 123 && odd_rows == 123);
    } else if (c->has_counts) {
        assert_true(inside > 0 && inside <= 2 * CELLS * CELLS);
        assert_int_equal(inside, 2 * odd_rows); /* cells 2 and 3 of a row that crosses at 2 */
    }
}

static void test_missing(void **state)
{
    (void)state;
    for (int is_double = 0; is_double < 2; is_double++) {
        check(right_call(is_double), TRIBOX_OK);
        call c = *right_call(is_double);
        c.has_counts = false;
        check(&c, TRIBOX_OK);
        bool *const parts[] = {&c.has_triangles, &c.has_grid, &c.has_occupied, &c.has_solid, &c.has_scratch};
        for (size_t n = 0; n < sizeof parts / sizeof parts[0]; n++) {
            c = *right_call(is_double);
            *parts[n] = false;
            check(&c, TRIBOX_BAD_ARGUMENT);
        }
        c = *right_call(is_double);
        c.soup.z[2] = NULL;
        c.mesh.positions = NULL;
        check(&c, TRIBOX_BAD_ARGUMENT);
        c = *right_call(is_double);
        c.soup.count = c.mesh.count = SIZE_MAX / 2;
        check(&c, TRIBOX_BAD_ARGUMENT);
    }
}

static void test_grids(void **state)
{
    (void)state;
    static const double cells[] = {0, -1, NAN, INFINITY, 1e-30};
    for (int is_double = 0; is_double < 2; is_double++)
        for (int a = 0; a < 3; a++) {
            call c = *right_call(is_double);
            c.grid.size[a] = 0;
            check(&c, TRIBOX_BAD_GRID);
            c = *right_call(is_double);
            c.grid.origin[a] = NAN;
            check(&c, TRIBOX_BAD_GRID);
            c = *right_call(is_double);
            c.grid.size[a] = UINT32_MAX;
            c.grid.size[(a + 1) % 3] = UINT32_MAX;
            check(&c, TRIBOX_BAD_GRID);
            for (size_t n = 0; n < sizeof cells / sizeof cells[0]; n++) {
                c = *right_call(is_double);
                c.grid.cell[a] = cells[n];
                c.grid.origin[a] = 1;
                check(&c, TRIBOX_BAD_GRID);
            }
        }
}

static void test_meshes(void **state)
{
    (void)state;
    call c = *right_call(true);
    c.mesh.vertices = 2;
    check(&c, TRIBOX_BAD_VERTEX);
    c.mesh.vertices = 3;
    c.mesh.position_bytes = 5;
    check(&c, TRIBOX_BAD_ARGUMENT);
}

/* Indices, floats and strides: the same triangle. */
static void test_layouts(void **state)
{
    (void)state;
    static const uint32_t indices[] = {2, 0, 1};
    call c = *right_call(true);
    c.mesh.indices = indices;
    c.mesh.index_bytes = 4;
    check(&c, TRIBOX_OK);
    c.mesh.positions = c.streams;
    c.mesh.position_bytes = 4;
    check(&c, TRIBOX_OK);
    const double columns[9] = {2, 2, 2, 0, 4, 0, 0, 0, 4};
    c.mesh = (tribox_mesh){.positions = columns, .vertices = 3, .count = 1, .position_bytes = 8, .axis_stride = 24};
    check(&c, TRIBOX_OK);
}

/* Nothing but the surface. */
static void test_no_triangles(void **state)
{
    (void)state;
    for (int is_double = 0; is_double < 2; is_double++) {
        uint64_t occupied[WORDS], solid[WORDS], scratch[BYTES / 8];
        size_t inside = 1, odd_rows = 1;
        const tribox_soup soup = {.count = 0};
        const tribox_mesh mesh = {.count = 0};
        const call *const c = right_call(is_double);
        for (size_t n = 0; n < WORDS; n++)
            occupied[n] = ~UINT64_C(0) - n;
        assert_int_equal(is_double ? tribox_mesh_fill_parity(&mesh, &c->grid, occupied, scratch, solid, &inside, &odd_rows)
                                   : tribox_fill_parity(&soup, &c->grid, occupied, scratch, solid, &inside, &odd_rows),
                         TRIBOX_OK);
        assert_true(!inside && !odd_rows);
        for (size_t n = 0; n < WORDS; n++)
            assert_true(solid[n] == (occupied[n] & ((1 << CELLS) - 1)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_missing), cmocka_unit_test(test_grids),        cmocka_unit_test(test_meshes),
        cmocka_unit_test(test_layouts), cmocka_unit_test(test_no_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
