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

#include "brick_out.h"
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

typedef char triple_text[3 * DECIMAL_MAX];

static const char *triple(const double number[3], triple_text text)
{
    char decimal[3][DECIMAL_MAX];
    snprintf(text, sizeof(triple_text), "[%s,%s,%s]", decimal_of_double(number[0], decimal[0]),
             decimal_of_double(number[1], decimal[1]), decimal_of_double(number[2], decimal[2]));
    return text;
}

/*
 * Two views of one buffer, vertices, with a colour after each where there are colours, and which of them make triangles; and where
 * positions, corners of triangles and colours are in them, after the first's least and most.
 */
static void describe_mesh(char text[TEXT_MAX], const shell_file *f, uint64_t vertex_bytes)
{
    extent e = {{UINT32_MAX, UINT32_MAX, UINT32_MAX}, {0, 0, 0}};
    double corner[3], low[3], high[3];
    triple_text place, scale, least, most;
    char colours[128] = "";
    const uint64_t vertices = vertex_bytes * f->vertices, triangles = TRIANGLE_BYTES * f->shell->triangles;
    lattice_vertices(&f->shell->points, widen, &e);
    for (int a = 0; a < 3; a++) {
        corner[a] = f->cells->grid.origin[a] + f->cells->shift[a];
        low[a] = e.least[a] / 2.0;
        high[a] = e.most[a] / 2.0;
    }
    if (f->corners)
        snprintf(colours, sizeof colours,
                 ",{\"bufferView\":0,\"byteOffset\":%d,\"componentType\":5123,\"normalized\":true,\"count\":%" PRIu64
                 ",\"type\":\"VEC4\"}",
                 (int)VERTEX_BYTES, f->vertices);
    snprintf(text, TEXT_MAX,
             "{\"asset\":{\"version\":\"2.0\",\"generator\":\"tribox\"},"
             "\"nodes\":[{\"name\":\"tribox\",\"mesh\":0,\"translation\":%s,\"scale\":%s}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0%s}]}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%" PRIu64
             ",\"type\":\"VEC3\",\"min\":%s,\"max\":%s},"
             "{\"bufferView\":1,\"componentType\":5125,\"count\":%" PRIu64 ",\"type\":\"SCALAR\"}%s],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%" PRIu64 "%s,\"target\":34962},"
             "{\"buffer\":0,\"byteOffset\":%" PRIu64 ",\"byteLength\":%" PRIu64 ",\"target\":34963}],"
             "\"buffers\":[{\"byteLength\":%" PRIu64 "}],%s\"scene\":0,\"scenes\":[{\"nodes\":[0]}]}",
             triple(corner, place), triple(f->cells->grid.cell, scale),
             f->corners ? ",\"COLOR_0\":2},\"indices\":1,\"material\":0" : "},\"indices\":1", f->vertices, triple(low, least),
             triple(high, most), 3 * f->shell->triangles, colours, vertices, f->corners ? ",\"byteStride\":20" : "", vertices,
             triangles, vertices + triangles,
             f->corners ? "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":1}}]," : "");
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

static void put_vertex(shell_file *f, const uint32_t halves[3], rgb colour)
{
    uint32_t number[COLOURED_BYTES / 4];
    find_bits(halves, number);
    if (f->corners) {
        number[3] = linear_of(f->state, colour.at[0]) | linear_of(f->state, colour.at[1]) << 16;
        number[4] = linear_of(f->state, colour.at[2]) | (uint32_t)UINT16_MAX << 16;
    }
    put_numbers(f->to, number, f->corners ? 5 : 3);
}

static void put_triangle(shell_file *f, const uint32_t triangle[3], rgb colour)
{
    (void)colour;
    put_numbers(f->to, triangle, 3);
}

/* Blanks fill the text up to a multiple of four. No cell that is set, no mesh: glTF has no empty ones. */
static int begin(shell_file *f)
{
    static rgb_curve curve;
    char text[TEXT_MAX] = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"tribox\"},\"scene\":0,\"scenes\":[{}]}";
    const uint64_t vertex_bytes = f->corners ? COLOURED_BYTES : VERTEX_BYTES;
    const uint64_t bytes = vertex_bytes * f->vertices + TRIANGLE_BYTES * f->shell->triangles;
    if (f->shell->triangles)
        describe_mesh(text, f, vertex_bytes);
    while (strlen(text) % 4)
        strcat(text, " ");
    const uint64_t all = GLB_HEADER + CHUNK + strlen(text) + (bytes ? CHUNK + bytes : 0);
    if (all > UINT32_MAX)
        return message_failure("%s: %" PRIu64 " vertices and %" PRIu64 " triangles take more than the 4 GiB that .glb holds: write "
                               ".ply or .obj, or choose fewer cells",
                               f->path, f->vertices, f->shell->triangles);
    curve = rgb_curve_make();
    f->state = &curve;
    fputs("glTF", f->to);
    put_numbers(f->to, (const uint32_t[3]){2, (uint32_t)all, (uint32_t)strlen(text)}, 3);
    fprintf(f->to, "JSON%s", text);
    if (bytes) {
        put_numbers(f->to, (const uint32_t[1]){(uint32_t)bytes}, 1);
        fwrite("BIN", 1, 4, f->to);
    }
    return EXIT_CODE_OK;
}

const shell_format shell_glb = {.has_corners = true, .begin = begin, .vertex = put_vertex, .triangle = put_triangle};
