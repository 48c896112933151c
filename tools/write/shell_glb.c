/*
 * shell_glb.c - a shell as binary glTF 2.0: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
 *
 * Positions are floats there. They count cells, which is exact; the node scales them by the lengths of a cell and moves them to the
 * origin. There are no normals, so that readers shade each triangle flat. Colours are those of vertices, linear as glTF has them,
 * with a matte material, as the one that readers have without is a metal.
 */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "brick_writer.h"
#include "console/decimal.h"
#include "console/message.h"
#include "read/little.h"
#include "shell_file.h"

/* A float holds halves up to SIDE_MOST cells. Lengths of the file and its chunks are of 32 bits. */
enum {
    SIDE_MOST = 1 << 23,
    GLB_HEADER = 12,
    CHUNK = 8,
    VERTEX_BYTES = 12,
    TRIANGLE_BYTES = 12,
    COLOURED_BYTES = 20,
    TEXT_MAX = 2048
};

int bricks_check_glb(const char *path, const tribox_grid *grid)
{
    for (int a = 0; a < 3; a++)
        if (grid->size[a] > SIDE_MOST)
            return message_failure("%s: .glb holds at most %d cells on each axis, the grid has %u x %u x %u; write .ply or .obj",
                                   path, (int)SIDE_MOST, grid->size[0], grid->size[1], grid->size[2]);
    return bricks_check_shell(path, grid);
}

/* Least and most of each coordinate, in halves of cells. */
typedef struct extent {
    uint32_t least[3], most[3];
} extent;

static bool widen(void *data, const uint32_t halves[3])
{
    extent *const e = data;
    for (int a = 0; a < 3; a++) {
        e->least[a] = halves[a] < e->least[a] ? halves[a] : e->least[a];
        e->most[a] = halves[a] > e->most[a] ? halves[a] : e->most[a];
    }
    return true;
}

/* Appends a text, and numbers in brackets. */
static void add(char text[TEXT_MAX], const char *more) { strncat(text, more, TEXT_MAX - 1 - strlen(text)); }

static void add_numbers(char text[TEXT_MAX], const char *name, const double number[3])
{
    char decimal[DECIMAL_MAX];
    add(text, name);
    for (int a = 0; a < 3; a++) {
        add(text, a ? "," : "[");
        add(text, decimal_of_double(number[a], decimal));
    }
    add(text, "]");
}

static void describe_place(char text[TEXT_MAX], const voxels *v)
{
    double corner[3];
    for (int a = 0; a < 3; a++)
        corner[a] = v->grid.origin[a] + v->shift[a];
    add(text, "\"nodes\":[{\"name\":\"tribox\",\"mesh\":0");
    add_numbers(text, ",\"translation\":", corner);
    add_numbers(text, ",\"scale\":", v->grid.cell);
    add(text, "}],");
}

static uint64_t vertex_bytes(const shell_file *f) { return f->corners ? COLOURED_BYTES : VERTEX_BYTES; }

static uint64_t buffer_bytes(const shell_file *f)
{
    return vertex_bytes(f) * shell_file_vertices(f) + TRIANGLE_BYTES * f->shell->triangles;
}

/* Where positions, corners of triangles and colours are, after the first's least and most. */
static void describe_accessors(char text[TEXT_MAX], const shell_file *f)
{
    char part[TEXT_MAX];
    snprintf(part, sizeof part, "},{\"bufferView\":1,\"componentType\":5125,\"count\":%" PRIu64 ",\"type\":\"SCALAR\"}",
             3 * f->shell->triangles);
    add(text, part);
    snprintf(part, sizeof part,
             ",{\"bufferView\":0,\"byteOffset\":%d,\"componentType\":5123,\"normalized\":true,\"count\":%" PRIu64
             ",\"type\":\"VEC4\"}",
             (int)VERTEX_BYTES, shell_file_vertices(f));
    add(text, f->corners ? part : "");
}

/* Two views of one buffer: vertices, with a colour after each where there are colours, and which of them make triangles. */
static void describe_views(char text[TEXT_MAX], const shell_file *f)
{
    const uint64_t vertices = vertex_bytes(f) * shell_file_vertices(f), triangles = TRIANGLE_BYTES * f->shell->triangles;
    char part[TEXT_MAX];
    snprintf(part, sizeof part, "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%" PRIu64, vertices);
    add(text, part);
    snprintf(part, sizeof part, ",\"byteStride\":%d", (int)COLOURED_BYTES);
    add(text, f->corners ? part : "");
    snprintf(part, sizeof part,
             ",\"target\":34962},{\"buffer\":0,\"byteOffset\":%" PRIu64 ",\"byteLength\":%" PRIu64
             ",\"target\":34963}],\"buffers\":[{\"byteLength\":%" PRIu64 "}],",
             vertices, triangles, vertices + triangles);
    add(text, part);
    if (f->corners)
        add(text, "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":1}}],");
}

static void describe_mesh(char text[TEXT_MAX], const shell_file *f)
{
    char part[TEXT_MAX];
    extent e = {{UINT32_MAX, UINT32_MAX, UINT32_MAX}, {0, 0, 0}};
    double least[3], most[3];
    lattice_vertices(&f->shell->points, widen, &e);
    for (int a = 0; a < 3; a++) {
        least[a] = e.least[a] / 2.0;
        most[a] = e.most[a] / 2.0;
    }
    add(text, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0");
    add(text, f->corners ? ",\"COLOR_0\":2},\"indices\":1,\"material\":0}]}]," : "},\"indices\":1}]}],");
    snprintf(part, sizeof part, "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%" PRIu64 ",\"type\":\"VEC3\"",
             shell_file_vertices(f));
    add(text, part);
    add_numbers(text, ",\"min\":", least);
    add_numbers(text, ",\"max\":", most);
    describe_accessors(text, f);
    describe_views(text, f);
}

/* Blanks fill it up to a multiple of four. No cell that is set, no mesh: glTF has no empty ones. */
static void describe(char text[TEXT_MAX], const shell_file *f)
{
    text[0] = '\0';
    add(text, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"tribox\"},");
    if (f->shell->triangles) {
        describe_place(text, f->cells);
        describe_mesh(text, f);
    }
    add(text, f->shell->triangles ? "\"scene\":0,\"scenes\":[{\"nodes\":[0]}]}" : "\"scene\":0,\"scenes\":[{}]}");
    while (strlen(text) % 4)
        add(text, " ");
}

static void put_numbers(FILE *to, const uint32_t *number, int count)
{
    unsigned char bytes[COLOURED_BYTES];
    for (int n = 0; n < count; n++)
        little_put32(bytes + 4 * n, number[n]);
    fwrite(bytes, 1, 4 * (size_t)count, to);
}

static void find_bits(const uint32_t halves[3], uint32_t bits[3])
{
    for (int a = 0; a < 3; a++) {
        const float x = (float)halves[a] / 2;
        memcpy(&bits[a], &x, sizeof x);
    }
}

/* In 16 bits all bytes stay apart, the dark ones too. */
static uint32_t linear_of(const rgb_curve *curve, unsigned char byte)
{
    return (uint32_t)((double)curve->light[byte] * UINT16_MAX + 0.5);
}

/* With what vertices of colours need. */
typedef struct glb_file {
    shell_file file; /* the first, as vertices are handed over with it */
    rgb_curve curve;
} glb_file;

static bool put_vertex_glb(void *file, const uint32_t halves[3], rgb colour)
{
    const glb_file *const g = file;
    const shell_file *const f = &g->file;
    uint32_t number[COLOURED_BYTES / 4];
    find_bits(halves, number);
    if (f->corners) {
        number[3] = linear_of(&g->curve, colour.at[0]) | linear_of(&g->curve, colour.at[1]) << 16;
        number[4] = linear_of(&g->curve, colour.at[2]) | (uint32_t)UINT16_MAX << 16;
    }
    put_numbers(f->to, number, f->corners ? 5 : 3);
    return !ferror(f->to);
}

static void put_triangle_glb(void *file, const uint32_t triangle[3], rgb colour)
{
    const shell_file *const f = file;
    (void)colour;
    put_numbers(f->to, triangle, 3);
}

int shell_write_glb(shell_file *f)
{
    char text[TEXT_MAX];
    describe(text, f);
    const uint64_t bytes = buffer_bytes(f);
    const uint64_t all = GLB_HEADER + CHUNK + strlen(text) + (bytes ? CHUNK + bytes : 0);
    if (all > UINT32_MAX)
        return message_failure("%s: %" PRIu64 " vertices and %" PRIu64 " triangles take more than the 4 GiB that .glb holds: write "
                               ".ply or .obj, or choose fewer cells",
                               f->path, shell_file_vertices(f), f->shell->triangles);
    fputs("glTF", f->to);
    put_numbers(f->to, (const uint32_t[3]){2, (uint32_t)all, (uint32_t)strlen(text)}, 3);
    fprintf(f->to, "JSON%s", text);
    if (!bytes)
        return EXIT_CODE_OK;
    put_numbers(f->to, (const uint32_t[1]){(uint32_t)bytes}, 1);
    fwrite("BIN", 1, 4, f->to);
    glb_file g = {*f, rgb_curve_make()};
    if (shell_file_each_vertex(&g.file, put_vertex_glb))
        shell_file_triangles(f, put_triangle_glb);
    return EXIT_CODE_OK;
}
