/*
 * test_taken.c - a mesh that is handed over while it is read is the mesh that is stored, triangle by triangle, and its box is the
 * least: where that is open, what was handed over is dropped, and the mesh is stored. For any number of threads.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "console/message.h"
#include "read/mesh_ways.h"

static char folder[] = "/tmp/tribox-taken-XXXXXX";
static char path[64];

/* A mesh that is changed case by case: a height field of faces that differ, of which vertex 0 and others reach the sides. */
enum { SIDE = 150, VERTICES = SIDE * SIDE, FACES = 2 * (SIDE - 1) * (SIDE - 1) };
static float vertex[VERTICES + 1][3];
static uint32_t face[FACES][3];
static size_t vertices, faces;

static void make_field(void)
{
    vertices = VERTICES;
    faces = 0;
    for (uint32_t v = 0; v < VERTICES; v++) {
        const uint32_t i = v % SIDE, j = v / SIDE;
        const float at[3] = {(float)i * 0.7f + 1, (float)j * 1.3f + 1, 2 + sinf((float)(i * j))};
        memcpy(vertex[v], at, sizeof at);
        if (i + 1 < SIDE && j + 1 < SIDE) {
            const uint32_t pair[2][3] = {{v, v + 1, v + SIDE}, {v + 1, v + SIDE + 1, v + SIDE}};
            memcpy(face[faces], pair, sizeof pair);
            faces += 2;
        }
    }
}

static void put_numbers(const void *numbers, size_t count, bool is_big, FILE *file)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, (const unsigned char *)numbers + i * sizeof bits, sizeof bits);
        for (int b = 0; b < 4; b++)
            fputc((int)(bits >> 8 * (is_big ? 3 - b : b) & 0xff), file);
    }
}

/* fault: NULL, or the count of corners that the face in the middle has instead of 3. */
static void write_mesh(bool is_big, const char *fault, size_t missing)
{
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file,
            "ply\nformat binary_%s_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\nproperty float z\n"
            "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            is_big ? "big" : "little", vertices, faces);
    put_numbers(vertex, 3 * vertices, is_big, file);
    for (size_t f = 0; f + missing < faces; f++) {
        fputc(fault && f == faces / 2 ? fault[0] : 3, file);
        put_numbers(face[f], 3, is_big, file);
    }
    assert_int_equal(fclose(file), 0);
}

/* What a taker sees. The order of triangles is open: sums of what tells them apart. */
typedef struct seen {
    pthread_mutex_t lock;
    uint64_t sum;
    size_t triangles, promised, begun, dropped, threads;
    size_t fails_at; /* the triangle at which it cannot go on */
    bool is_unwilling;
    tribox_box bounds;
} seen;

static uint64_t hash(const double u[9])
{
    uint64_t h = 1469598103934665603U, bits;
    for (int c = 0; c < 9; c++) {
        memcpy(&bits, &u[c], sizeof bits);
        h = (h ^ bits ^ bits >> 32) * 1099511628211U;
    }
    return h;
}

static bool begin(void *data, const tribox_box *bounds, size_t triangles)
{
    seen *const s = data;
    s->begun++;
    s->bounds = *bounds;
    s->promised = triangles;
    return !s->is_unwilling;
}

static bool take(void *data, unsigned thread, const tribox_mesh *block)
{
    seen *const s = data;
    const float *const positions = block->positions;
    const uint32_t *const corners = block->indices;
    uint64_t sum = 0;
    for (size_t i = 0; i < block->count; i++) {
        double u[9];
        for (size_t c = 0; c < 9; c++) {
            if (corners[3 * i + c / 3] >= block->vertices)
                return false;
            u[c] = (double)positions[3 * corners[3 * i + c / 3] + c % 3];
        }
        sum += hash(u);
    }
    pthread_mutex_lock(&s->lock);
    s->sum += sum;
    s->triangles += block->count;
    s->threads = thread > s->threads ? thread : s->threads;
    const bool goes_on = s->triangles <= s->fails_at;
    pthread_mutex_unlock(&s->lock);
    return goes_on;
}

static void drop(void *data) { ((seen *)data)->dropped++; }

static uint64_t hash_of(const mesh *m)
{
    uint64_t sum = 0;
    for (size_t t = 0; t < m->triangles; t++) {
        double u[9];
        mesh_triangle(m, t, u);
        sum += hash(u);
    }
    return sum;
}

typedef enum due { TAKEN, DROPPED, STORED /* the taker is not asked, or is unwilling */ } due;

static void check_with(unsigned threads, due how, size_t fails_at, bool is_unwilling)
{
    mesh slow = {.coordinates = NULL}, m = {.coordinates = NULL};
    seen s = {.fails_at = fails_at, .is_unwilling = is_unwilling};
    const mesh_taker taker = {begin, take, drop, &s};
    const int code = mesh_read_slowly(path, false, 1, &slow);
    pthread_mutex_init(&s.lock, NULL);
    const bool is_read = mesh_read_plain(path, false, threads, 1 << 18, &taker, &m);
    pthread_mutex_destroy(&s.lock);
    assert_int_equal(is_read, !code);
    assert_int_equal(m.is_taken, how == TAKEN && is_read);
    assert_int_equal(s.dropped, how == DROPPED);
    if (is_read) {
        assert_int_equal(m.triangles, slow.triangles);
        assert_int_equal(m.not_finite, slow.not_finite);
        assert_int_equal(m.first_not_finite, slow.first_not_finite);
        assert_memory_equal(&m.bounds, &slow.bounds, sizeof m.bounds);
        assert_true((how == TAKEN ? s.sum : hash_of(&m)) == hash_of(&slow));
    }
    if (how == TAKEN && is_read) {
        assert_int_equal(s.begun, 1);
        assert_int_equal(s.triangles, m.triangles);
        assert_int_equal(s.promised, m.triangles);
        assert_memory_equal(&s.bounds, &m.bounds, sizeof m.bounds);
        assert_true(s.threads < threads);
        assert_null(m.coordinates);
    }
    mesh_free(&m);
    mesh_free(&slow);
}

static void check(due how)
{
    static const unsigned threads[] = {1, 2, 3, 7, 200};
    write_mesh(false, NULL, 0);
    for (size_t t = 0; t < sizeof threads / sizeof threads[0]; t++)
        check_with(threads[t], how, SIZE_MAX, false);
}

static void test_whole(void **state)
{
    (void)state;
    make_field();
    check(TAKEN);
    write_mesh(true, NULL, 0);
    check_with(2, TAKEN, SIZE_MAX, false);
    write_mesh(false, NULL, 0);
    check_with(3, STORED, SIZE_MAX, true);
    check_with(3, DROPPED, FACES / 2, false);
    check_with(1, DROPPED, 0, false);
    faces = 1;
    vertices = 3;
    const float corner[3] = {3, 4, 5};
    memcpy(vertex[1], corner, sizeof corner);
    face[0][0] = 0, face[0][1] = 1, face[0][2] = 2;
    check(TAKEN);
    face[0][1] = face[0][2] = 0;
    check(DROPPED);
    vertices = 1;
    check(TAKEN);
}

/* A vertex that reaches a side and that no triangle has, first, last or in the middle: what is handed over has another box. */
static void test_unused(void **state)
{
    static const size_t at[] = {0, 4095, 4096, VERTICES};
    (void)state;
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++)
        for (size_t side = 0; side < 6; side++) {
            make_field();
            vertices = VERTICES + 1;
            memcpy(vertex[VERTICES], vertex[0], sizeof vertex[0]);
            vertex[at[i]][side % 3] = side < 3 ? -1000 : 1000;
            check(at[i] < VERTICES ? TAKEN : DROPPED);
            for (size_t f = 0; f < faces; f++)
                for (size_t c = 0; c < 3; c++)
                    face[f][c] = face[f][c] == at[i] ? 1 : face[f][c];
            write_mesh(false, NULL, 0);
            check_with(2, DROPPED, SIZE_MAX, false);
        }
    make_field();
    vertices = VERTICES + 1;
    memcpy(vertex[VERTICES], vertex[SIDE + 1], sizeof vertex[0]);
    check(TAKEN);
}

/* What the box of all vertices leaves open is not handed over. */
static void test_not_finite_and_zeros(void **state)
{
    static const float odd[] = {NAN, -NAN, INFINITY, -INFINITY};
    (void)state;
    for (size_t i = 0; i < 4; i++)
        for (size_t a = 0; a < 3; a++) {
            make_field();
            vertex[VERTICES - 1 - i][a] = odd[i];
            check(STORED);
            make_field();
            vertex[6000 * i + 5][a] = odd[i];
            check(STORED);
            make_field();
            vertices = VERTICES + 1;
            memcpy(vertex[VERTICES], vertex[0], sizeof vertex[0]);
            vertex[VERTICES][a] = odd[i];
            check(STORED);
        }
    for (size_t a = 0; a < 3; a++) {
        make_field();
        vertex[0][a] = 0;
        check(TAKEN);
        vertex[VERTICES - 1][a] = -0.0f;
        check(STORED);
        vertex[VERTICES - 1][a] = 2;
        vertex[5000][a] = -0.0f;
        check(STORED);
        vertex[0][a] = -5;
        check(TAKEN);
        vertex[0][a] = 0;
        vertex[1][a] = -0.0f;
        vertex[VERTICES - 1][a] = -0.0f;
        for (size_t v = 2; v < VERTICES - 1; v++)
            vertex[v][a] *= -1;
        check(STORED);
    }
}

static void test_range(void **state)
{
    static const float scale[] = {1e-45f, 1e-38f, 1e-20f, 1e20f, 1e36f};
    (void)state;
    for (size_t i = 0; i < sizeof scale / sizeof scale[0]; i++) {
        make_field();
        for (size_t v = 0; v < vertices; v++)
            for (size_t a = 0; a < 3; a++)
                vertex[v][a] *= scale[i];
        check(TAKEN);
    }
}

static void test_damaged(void **state)
{
    static const unsigned threads[] = {1, 2, 7};
    (void)state;
    for (size_t t = 0; t < 3; t++) {
        make_field();
        write_mesh(false, NULL, 1);
        check_with(threads[t], STORED, SIZE_MAX, false);
        face[faces / 2][1] = VERTICES;
        write_mesh(false, NULL, 0);
        check_with(threads[t], DROPPED, SIZE_MAX, false);
        make_field();
        face[faces - 1][2] = UINT32_MAX;
        write_mesh(false, NULL, 0);
        check_with(threads[t], DROPPED, SIZE_MAX, false);
        make_field();
        write_mesh(false, "\4", 0);
        check_with(threads[t], DROPPED, SIZE_MAX, false);
    }
}

static int make_folder(void **state)
{
    (void)state;
    message_set_program("test"); /* the slow way says why it refuses, which is as it should be */
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/a.ply", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_whole), cmocka_unit_test(test_unused),
                                       cmocka_unit_test(test_not_finite_and_zeros), cmocka_unit_test(test_range),
                                       cmocka_unit_test(test_damaged)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
