#include "real_meshes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SKIPPED = 77 };

static const char *const files[] = {"stanford-bunny.ply", "buildings.ply",     "sponza.ply",
                                    "SainteHelens.ply",   "thingi10k_124.stl", "ModelNet_chair.ply"};

tribox_box mesh_bounds(const mesh *m)
{
    tribox_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int a = 0; a < 3; a++)
        for (int j = 0; j < 3; j++)
            for (size_t i = 0; i < m->count; i++) {
                box.lo[a] = fminf((float)box.lo[a], m->coordinate[j][a][i]);
                box.hi[a] = fmaxf((float)box.hi[a], m->coordinate[j][a][i]);
            }
    return box;
}

void mesh_triangle(const mesh *m, size_t i, float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            u[j][a] = m->coordinate[j][a][i];
}

/* All bytes of a file, and a zero. */
static unsigned char *load(const char *path, size_t *size)
{
    FILE *const file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END) || !(*size = (size_t)ftell(file)) || fseek(file, 0, SEEK_SET))
        fail_msg("%s cannot be read", path);
    unsigned char *const bytes = calloc(*size + 1, 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

static uint32_t word_at(const unsigned char *p) { return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24; }

/* Binary little-endian PLY of triangles of floats, whose header these files have word for word; or binary STL. */
static void read_mesh(const char *path, mesh *m)
{
    enum { VERTEX = 12, FACE = 13, HEADER = 84, TRIANGLE = 50, NORMAL = 12 };
    static const char header[] = "ply format binary_little_endian 1.0 element vertex %zu property float x property float y "
                                 "property float z element face %zu property list uchar int vertex_indices end_header%n";
    size_t size = 0, vertices = 0, faces = 0;
    int end = 0;
    unsigned char *const bytes = load(path, &size);
    const bool is_ply = sscanf((const char *)bytes, header, &vertices, &faces, &end) == 2 && end;
    const size_t first_face = (size_t)end + 1 + VERTEX * vertices;
    m->count = is_ply ? faces : size < HEADER ? 0 : word_at(bytes + HEADER - 4);
    if (!m->count || size != (is_ply ? first_face + FACE * faces : HEADER + TRIANGLE * m->count))
        fail_msg("%s is no such file of triangles, or has another size", path);
    for (int k = 0; k < 9; k++) {
        m->coordinate[k / 3][k % 3] = malloc(m->count * sizeof(float));
        assert_non_null(m->coordinate[k / 3][k % 3]);
    }
    for (size_t i = 0; i < m->count; i++)
        for (size_t j = 0; j < 3; j++) {
            const unsigned char *const face = bytes + first_face + FACE * i;
            const size_t number = is_ply ? word_at(face + 1 + 4 * j) : 0;
            if (is_ply && (face[0] != 3 || number >= vertices))
                fail_msg("%s: face %zu is no triangle of its vertices", path, i);
            for (size_t a = 0; a < 3; a++) {
                const uint32_t bits = word_at(
                    bytes + 4 * a + (is_ply ? (size_t)end + 1 + VERTEX * number : HEADER + TRIANGLE * i + NORMAL + VERTEX * j));
                memcpy(&m->coordinate[j][a][i], &bits, sizeof bits);
            }
        }
    free(bytes);
}

static void try_file(const arguments *args, mesh_trial *try_mesh, const char *name)
{
    char path[4096];
    mesh m = {.count = 0};
    assert_in_range(snprintf(path, sizeof path, "%s/%s", args->meshes, name), 1, sizeof path - 1);
    read_mesh(path, &m);
    try_mesh(args, name, &m);
    fflush(stdout);
    for (int k = 0; k < 9; k++)
        free(m.coordinate[k / 3][k % 3]);
}

void real_meshes_try(const arguments *args, mesh_trial *try_mesh)
{
    if (!args->meshes)
        skip();
    for (size_t k = 0; k < sizeof files / sizeof files[0]; k++)
        try_file(args, try_mesh, files[k]);
}

typedef struct mesh_test {
    arguments args;
    mesh_trial *try_mesh;
} mesh_test;

static void test_meshes(void **state)
{
    const mesh_test *const test = *state;
    real_meshes_try(&test->args, test->try_mesh);
}

int real_meshes_main(int argc, char **argv, mesh_trial *try_mesh)
{
    mesh_test test = {.args = arguments_parse(argc, argv), .try_mesh = try_mesh};
    if (!test.args.meshes) {
        printf("skipped: no folder of meshes; give one with --meshes FOLDER or in TRIBOX_MESHES\n");
        return SKIPPED;
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_meshes, &test)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
