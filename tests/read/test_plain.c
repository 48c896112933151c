/*
 * test_plain.c - whatever the fast way reads, the way that knows every spelling reads as well, and both make the same mesh, bit for
 * bit: for any number of threads, and chunks of a text that begin at any byte.
 */
#define _POSIX_C_SOURCE 200809L
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
#include "same_mesh.h"

static char folder[] = "/tmp/tribox-plain-XXXXXX";
static char path[64];

static void write_file(const char *name, const void *bytes, size_t size)
{
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Reads the last file each way. Returns whether the fast way did. */
static bool compare(const mesh *slow, int code, bool is_wide, unsigned threads, size_t chunk)
{
    mesh plain = {.coordinates = NULL};
    const bool is_plain = mesh_read_plain(path, is_wide, threads, chunk, &plain);
    if (is_plain && (code || !mesh_is_same(&plain, slow) || !mesh_is_looked_at_well(&plain)))
        fail_msg("%s: %u threads and chunks of %zu bytes make another mesh", path, threads, chunk);
    mesh_free(&plain);
    return is_plain;
}

typedef enum due { SLOWLY, FAST, EITHER /* as the chunks fall */ } due;

/* With chunks of every size up to that of the text, and threads. */
static void check(const char *name, const char *text, size_t size, due how)
{
    static const unsigned threads[] = {1, 2, 7};
    write_file(name, text, size);
    for (int is_wide = 0; is_wide < 2; is_wide++) {
        mesh slow = {.coordinates = NULL};
        const int code = mesh_read_slowly(path, MESH_OTHER, is_wide, 1, &slow);
        for (size_t chunk = 1; chunk <= size + 1; chunk += 1 + chunk / 31)
            for (int t = 0; t < 3; t++)
                if (compare(&slow, code, is_wide, threads[t], chunk) != (how == FAST) && how != EITHER)
                    fail_msg("%s: %u threads and chunks of %zu bytes: read %s\n%.300s", path, threads[t], chunk,
                             how == FAST ? "slowly" : "fast", text);
        mesh_free(&slow);
    }
}

/* Every line end as it is written on another system, and the last one left away. */
static void check_ends(const char *name, const char *text)
{
    char other[8192];
    size_t size = 0;
    for (const char *c = text; *c; c++) {
        if (*c == '\n')
            other[size++] = '\r';
        other[size++] = *c;
    }
    check(name, text, strlen(text), FAST);
    check(name, text, strlen(text) - 1, FAST);
    check(name, other, size, FAST);
    check(name, other, size - 2, FAST);
}

#define PLY "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty uchar red\nproperty float y\n"
#define PLY_FACES "property float z\nelement face 3\nproperty list uchar int vertex_indices\n"
#define PLY_DOUBLES "property double z\nelement face 3\nproperty list uchar int vertex_indices\nproperty int flag\n"

#define FACET(a) \
    "  facet normal 0 0 1\n    outer loop\n      vertex " a " 0 0\n      vertex 1 0 -0\n\tvertex 0 1 0.1\n    endloop\n  " \
    "endfacet\n"

static const struct {
    const char *name, *text;
    due how;
} rows[] = {
    {"a.obj",
     "# a comment\nmtllib x.mtl\nv 0 0 0\nv 1 0 0\nv\t0.1 1e-3\t-2\nvn 0 0 1\nvt 1 1\nf 1 2 3\n\nf 1/1 2/2 3/3 \n"
     "f 1//1 2//1 3//1\n  f -1 -2 -3\ng chunk\nf 1/1/1 3/3/1 2/2/1\n",
     FAST},
    {"a.obj", "f 1 2 3\nf 2 4 3\nv 0 0 0\nv 557820.15 5 1\nv -0 1.0000000000000002 1\nv 9007199254740993 1 1 0.5 0.5\np 1\nl 1 2\n",
     FAST},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.3 0.2 1\nf 1 2 3 4\nf 1 2\nf 5\nf -5 -4 -3 -2 -1\nv 9 9 9\nf 6 -1 1\n",
     FAST},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nF 1 2 3\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3#c\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", SLOWLY},
    {"a.obj", "v 557820.15 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", SLOWLY},
    {"a.obj", "v 557820.15 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n# x \\\nf 1 2 3\n", SLOWLY},
    {"a.obj", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n#x\rf 1 2 3\nf 1 2 3\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1e-400\nf 1 2 3\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0x1p4\nv 0 1 0\nf 1 2 3\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\vf 1 2 3\nf 1 2 3\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\n \fv 0 1 1\nv 0 1 0\nf 1 2 3\n", SLOWLY},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4294967299\n", SLOWLY},
    {"a.ply",
     PLY PLY_FACES "end_header\n0 255 0 0\n1\t0 0.1 0 \n1 0 1e-3 -0.0\n 0 0 1 12345678901234567\n3 0 1 2\n3  3 2 1\n"
                   "3 0 1 3 \nmore\n",
     FAST},
    {"a.ply", PLY PLY_DOUBLES "end_header\n0 255 0 0\n1 0 0 0.1\n1 x 1 0\n0 0 1 0.25\n4 0 1 2 3 7\n2 1 2 8\n3 0 1 3 9\n", FAST},
    {"a.ply", PLY PLY_FACES "end_header\n0 255 0 0\n1 0 0 0\n1 0 1 0\n0 0 1 557820.15\n3 0 1 2\n0\n3 0 1 3\n", FAST},
    {"a.ply", PLY PLY_FACES "end_header\n0 0 0 0\n1 0 0 0\n1 0 1 0\n0 0 1 0\n3 0 1 2\n3 0 1 2\n", SLOWLY},
    {"a.ply", PLY PLY_FACES "end_header\n0 0 0 0 1 0 0 0\n1 0 1 0\n0 0 1 0\n3 0 1 2\n3 0 1 2\n3 0 1 2\n", SLOWLY},
    {"a.ply", PLY PLY_FACES "end_header\n\n0 0 0 0\n1 0 0 0\n1 0 1 0\n0 0 1 0\n3 0 1 2\n3 0 1 2\n3 0 1 2\n", SLOWLY},
    {"a.ply", PLY PLY_FACES "end_header\n0 0 0 0\n1 0 0 0\n1 0 1 0\n0 0 1 0\n3 0 1 2\n3 0 1 4\n3 0 1 2\n", SLOWLY},
    {"a.ply", PLY PLY_FACES "end_header\n0 0 0 0\n1 0 0 0\n1 0 1 0\n0 0 1 0\n3 0 1 2\n3 0 1 2.0\n3 0 1 2\n", SLOWLY},
    {"a.ply", PLY PLY_FACES "end_header\n0 0 0 0\n1 0 0 inf\n1 0 1 0\n0 0 1 0\n3 0 1 2\n3 0 1 2\n3 0 1 2\n", SLOWLY},
    {"a.ply",
     PLY PLY_FACES "element edge 1\nproperty int a\nend_header\n0 0 0 0\n1 0 0 0\n1 0 1 0\n0 0 1 0\n3 0 1 2\n3 0 1 2\n3 0 1 2\n",
     SLOWLY},
    {"a.ply", PLY PLY_FACES "end_header\n0 0 0 0\n1 0 0 0\n1 0 1 0\n0 0 1 0\n3 0 1 2 3 0 1 2\n3 0 1 2\n", SLOWLY},
    {"a.stl", "solid a b\n" FACET("0") FACET("1e2") FACET("-1234567890123456789e-18") "endsolid a b\n", FAST},
    {"a.stl", "solid\n" FACET("0") "endsolid\nsolid facet\n" FACET("1") FACET("557820.15") "endsolid facet\n\n", FAST},
    {"a.stl",
     "solid a\nfacet normal nan nan nan outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n" FACET(
         "2") "endsolid\n",
     FAST},
    {"a.stl", "solid a\n" FACET("0") FACET("x") "endsolid\n", SLOWLY},
    {"a.stl", "solid a\n" FACET("0") "FACET normal 0 0 0\n", SLOWLY},
    {"a.stl", "solid a\n" FACET("0") FACET("1"), SLOWLY},
    {"a.stl", "solid a\n" FACET("0") "endsolid\n" FACET("1"), SLOWLY},
    {"a.stl", "solid a\nendsolid\n", SLOWLY},
    {"a.stl", "solid a\n" FACET("0 0") "endsolid\n", SLOWLY},
    {"a.stl", "Solid a\n" FACET("0") "EndSolid\n", SLOWLY},
    {"a.stl",
     "solid a\n" FACET("0") "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet " FACET("1")
         FACET("2") "endsolid",
     EITHER},
    {"a.stl",
     "solid a\n" FACET(
         "0") "facet normal 0 0 1 outer loop vertex 0 0 0\nvertex 1 0 0 vertex 0 1 0\nendloop\n"
              "endfacet facet normal 0 0 1\nouter loop\nvertex 3 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n" FACET("1")
                  FACET("2") "endsolid",
     EITHER},
    {"a.stl", "solid a\nendsolid solid\nfacet normal 0 0 0\n" FACET("1") FACET("2") "endsolid", EITHER}};

static void test_texts(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].how == FAST)
            check_ends(rows[i].name, rows[i].text);
        else
            check(rows[i].name, rows[i].text, strlen(rows[i].text), rows[i].how);
}

/* Numbers at which fast readers err, each as a coordinate of each format. */
static void test_numbers(void **state)
{
    char numbers[] =
        "9007199254740993 9007199254740992.5 0.30000001192092896 1.00000005960464477539 1.000000059604644775390625 "
        "2.2250738585072011e-308 4.9e-324 1e-46 3.4028236e38 1e39 1e400 -0 00000000000000000000000001 "
        "0.000000000000000000000000000001 1.17549435e-38 16777217 0.1 8388608.5 1e22 1e23 123456789012345678 +5 .5 5. 1E5 "
        "1e+05 1e00000005 ";
    char text[1024];
    (void)state;
    for (const char *n = strtok(numbers, " "); n; n = strtok(NULL, " ")) {
        snprintf(text, sizeof text, "v %s 0 1\nv 1 %s 0\nv 0 0 %s\nf 1 2 3\n", n, n, n);
        write_file("n.obj", text, strlen(text));
        for (int is_wide = 0; is_wide < 2; is_wide++) {
            mesh slow = {.coordinates = NULL};
            const int code = mesh_read_slowly(path, MESH_OTHER, is_wide, 1, &slow);
            compare(&slow, code, is_wide, 2, 16);
            mesh_free(&slow);
        }
    }
}

static void put(unsigned char **to, const void *bytes, size_t size, bool is_turned)
{
    for (size_t i = 0; i < size; i++)
        (*to)[i] = ((const unsigned char *)bytes)[is_turned ? size - 1 - i : i];
    *to += size;
}

/* Binary PLY, 9000 faces, more than a block; numbers alone where counts have four bytes. fault: what is unusual at one face. */
static size_t make_binary(const char *format, size_t count_bytes, uint32_t fault_count, uint32_t fault_corner, unsigned char *bytes)
{
    enum { VERTICES = 5000, FACES = 9000, FAULT = 5000 };
    static const char *const types[] = {"", "uchar", "ushort", "", "int"};
    const bool is_turned = !strcmp(format, "binary_big_endian"), has_more = count_bytes < 4;
    unsigned char *to = bytes;
    to += sprintf((char *)bytes,
                  "ply\nformat %s 1.0\nelement vertex %d\n%s"
                  "element face %d\nproperty short s\nproperty list %s uint vertex_index\nproperty uchar f\nend_header\n",
                  format, VERTICES,
                  has_more ? "property uchar q\nproperty float z\nproperty float x\nproperty float y\n"
                           : "property float x\nproperty float y\nproperty float z\n",
                  FACES, types[count_bytes]);
    for (int v = 0; v < VERTICES; v++) {
        const float z[3] = {v == 77 ? -0.0f : (float)(v % 17), v == 4000 ? (float)1e30 * (float)1e30 : (float)v * 0.37f, -(float)v};
        if (has_more)
            *to++ = 9;
        for (int a = 0; a < 3; a++)
            put(&to, &z[a], 4, is_turned);
    }
    for (uint32_t f = 0; f < FACES; f++) {
        const uint32_t count = f == FAULT ? fault_count : 3;
        const uint32_t corners[3] = {f % VERTICES, f * 7 % VERTICES, f == FAULT ? fault_corner : f * 13 % VERTICES};
        put(&to, &(uint16_t){3}, 2, is_turned);
        for (size_t b = 0; b < count_bytes; b++)
            *to++ = (unsigned char)(count >> 8 * (is_turned ? count_bytes - 1 - b : b));
        for (uint32_t k = 0; k < 3; k++)
            put(&to, &corners[k], 4, is_turned);
        *to++ = (unsigned char)f;
    }
    return (size_t)(to - bytes);
}

static void check_binary(const char *format, size_t count_bytes, uint32_t count, uint32_t corner, size_t cut, bool is_due)
{
    static unsigned char bytes[1 << 19];
    const size_t size = make_binary(format, count_bytes, count, corner, bytes);
    mesh slow = {.coordinates = NULL};
    write_file("b.ply", bytes, size - cut);
    const int code = mesh_read_slowly(path, MESH_OTHER, false, 1, &slow);
    for (unsigned threads = 1; threads < 8; threads += threads)
        assert_int_equal(compare(&slow, code, false, threads, 1 << 18), is_due);
    mesh_free(&slow);
}

static void test_ply_binary(void **state)
{
    (void)state;
    for (size_t count_bytes = 1; count_bytes <= 4; count_bytes *= 2) {
        check_binary("binary_little_endian", count_bytes, 3, 0, 0, true);
        check_binary("binary_big_endian", count_bytes, 3, 0, 0, true);
        check_binary("binary_little_endian", count_bytes, 4, 0, 0, false);
        check_binary("binary_little_endian", count_bytes, 2, 0, 0, false);
        check_binary("binary_big_endian", count_bytes, 3, 5000, 0, false);
        check_binary("binary_little_endian", count_bytes, 3, UINT32_MAX, 0, false);
        check_binary("binary_little_endian", count_bytes, 3, 0, 1, false);
    }
    check_binary("binary_little_endian", 2, 3 + 256, 0, 0, false);
    check_binary("binary_big_endian", 4, 3 + 65536, 0, 0, false);
}

static int make_folder(void **state)
{
    (void)state;
    message_set_program("test"); /* the slow way says why it refuses, which is as it should be */
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    static const char *const names[] = {"a.obj", "a.ply", "a.stl", "n.obj", "b.ply"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    return rmdir(folder);
}

/* Squares, triangles and segments in turn, more than a thread cuts at a time: squares from their first corner. */
static void test_polygons(void **state)
{
    enum { SIDE = 80, FACES = SIDE * SIDE, ROOM = 64 * FACES };
    char *const text = malloc(ROOM);
    mesh m = {.coordinates = NULL};
    size_t size = 0, next = 0;
    (void)state;
    assert_non_null(text);
    for (int v = 0; v < (SIDE + 1) * (SIDE + 1); v++)
        size += (size_t)sprintf(text + size, "v %d %d 0\n", v % (SIDE + 1), v / (SIDE + 1));
    for (int f = 0; f < FACES; f++) {
        const int a = f / SIDE * (SIDE + 1) + f % SIDE + 1, corners[4] = {a, a + 1, a + SIDE + 2, a + SIDE + 1};
        size += (size_t)sprintf(text + size, "f");
        for (int k = 0; k < 4 - f % 3; k++)
            size += (size_t)sprintf(text + size, k < 3 - f % 3 ? " %d" : " %d\n", corners[k]);
    }
    write_file("n.obj", text, size);
    free(text);
    assert_true(mesh_read_plain(path, false, 3, 1000, &m));
    assert_int_equal(m.left_out, FACES / 3);
    for (int f = 0; f < FACES; f++)
        for (int t = 0; t < 2 - f % 3; t++) {
            static const int at[2][9] = {{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1, 0}};
            double u[9];
            mesh_triangle(&m, next++, u);
            for (int c = 0; c < 9; c++)
                assert_true(u[c] == at[t][c] + (c % 3 == 0 ? f % SIDE : c % 3 == 1 ? f / SIDE : 0));
        }
    assert_int_equal(m.triangles, next);
    mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_texts), cmocka_unit_test(test_polygons),
                                       cmocka_unit_test(test_numbers), cmocka_unit_test(test_ply_binary)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
