#include "real_meshes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>

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

static void try_file(const arguments *args, mesh_trial *try_mesh, const char *name)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/%s", args->meshes, name);
    assert_in_range(length, 1, sizeof path - 1);
    mesh m;
    if (!mesh_read(path, &m))
        fail_msg("%s could not be read", name);
    try_mesh(args, name, &m);
    fflush(stdout);
    mesh_free(&m);
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
