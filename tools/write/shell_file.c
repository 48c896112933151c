/* shell_file.c - finds the surface of all cells, and writes it as a mesh. */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/written_number.h"
#include "read/little.h"
#include "shell/shell.h"
#include "volume.h"

/* A vertex where each has one colour: one that faces of several colours share is as many. */
typedef struct shell_corner {
    uint32_t vertex; /* of the shell */
    uint32_t next;   /* another corner of that; UINT32_MAX: none */
    rgb colour;
} shell_corner;

typedef struct shell_corners {
    uint32_t (*places)[3]; /* of the shell's vertices, in halves of cells */
    uint32_t *first;       /* corner of each of them */
    shell_corner *of;      /* in the order in which triangles come to them */
    size_t count;
} shell_corners;

typedef struct shell_file {
    FILE *to;
    const char *path;
    const voxels *cells;
    const shell *shell;
    const struct shell_format *format;
    uint64_t vertices; /* of the file */
    bool has_corners;  /* else the shell's vertices are those of the file */
    shell_corners corners;
    void *state; /* the format's own */
} shell_file;

typedef struct shell_format {
    bool has_corners;                                                    /* it has colours at vertices alone */
    int (*begin)(shell_file *f);                                         /* writes what stands first. Returns an exit_code */
    bool (*vertex)(shell_file *f, const uint32_t halves[3], rgb colour); /* in halves of cells; colour: of a corner */
    bool (*triangle)(shell_file *f, const uint32_t triangle[3], rgb colour);
    void (*end)(shell_file *f); /* frees the state, after a failure to begin too; NULL: there is none */
} shell_format;

/* From halves of cells to the coordinate before any shift: the planes are those of the grid, rounded once. */
static double coordinate_of(const voxels *v, int axis, uint32_t halves)
{
    const double low = fma(halves / 2, v->grid.cell[axis], v->grid.origin[axis]);
    const double high = halves % 2 ? fma(halves / 2 + 1, v->grid.cell[axis], v->grid.origin[axis]) : low;
    return (halves % 2 ? low + (high - low) / 2 : low) + v->shift[axis];
}

static const char shell_instead[] = "choose fewer cells, or write .npz or .vdb";

static int check_grid(const char *path, const tribox_grid *grid)
{
    const uint64_t words = (uint64_t)voxels_layer_words(grid) * grid->size[2];
    (void)path;
    const int code = voxels_check_words(grid, shell_instead);
    return code ? code : voxels_check_memory(grid, words * sizeof(uint64_t) + shell_bytes(grid), shell_instead);
}

/* -------------------------------------------------------------------------------------------------------------------------- PLY */

/* A binary PLY file, with doubles, which hold the planes of the grid, and a colour for each face. */
static int begin_ply(shell_file *f)
{
    fprintf(f->to,
            "ply\nformat binary_little_endian 1.0\ncomment the surface of cells, by tribox\n"
            "element vertex %" PRIu64 "\nproperty double x\nproperty double y\nproperty double z\n"
            "element face %" PRIu64 "\nproperty list uchar int vertex_indices\n%send_header\n",
            f->vertices, f->shell->triangles,
            f->cells->colours ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
    return EXIT_CODE_OK;
}

static bool put_ply_vertex(shell_file *f, const uint32_t halves[3], rgb colour)
{
    double place[3];
    (void)colour;
    for (int a = 0; a < 3; a++)
        place[a] = coordinate_of(f->cells, a, halves[a]);
    little_turn(place, 3, sizeof *place);
    return fwrite(place, sizeof *place, 3, f->to) == 3;
}

static bool put_ply_triangle(shell_file *f, const uint32_t triangle[3], rgb colour)
{
    enum { PLAIN = 1 + 3 * sizeof(uint32_t) };
    unsigned char bytes[PLAIN + sizeof colour] = {3};
    const size_t count = f->cells->colours ? sizeof bytes : PLAIN;
    for (int n = 0; n < 3; n++)
        little_put32(bytes + 1 + 4 * n, triangle[n]);
    memcpy(bytes + PLAIN, colour.at, sizeof colour);
    return fwrite(bytes, 1, count, f->to) == count;
}

static const shell_format shell_ply = {.begin = begin_ply, .vertex = put_ply_vertex, .triangle = put_ply_triangle};

/* -------------------------------------------------------------------------------------------------------------------------- OBJ */

/*
 * Decimals give the planes of the grid back: their texts, as they are found, are few against vertices, and long to find. Colours
 * are those of vertices, as materials would take a file beside this one.
 */
typedef char plane_text[DECIMAL_MAX];

static int begin_obj(shell_file *f)
{
    plane_text **const planes = f->state = calloc(3, sizeof *planes);
    bool has_room = planes;
    for (int a = 0; a < 3 && has_room; a++)
        has_room = (planes[a] = calloc(f->shell->points.size[a], sizeof *planes[a])) != NULL;
    if (!has_room)
        return message_failure("%s: out of memory for its numbers", f->path);
    fprintf(f->to, "# the surface of cells, by tribox: %" PRIu64 " vertices, %" PRIu64 " triangles\n", f->vertices,
            f->shell->triangles);
    return EXIT_CODE_OK;
}

static void end_obj(shell_file *f)
{
    plane_text **const planes = f->state;
    for (int a = 0; planes && a < 3; a++)
        free(planes[a]);
    free(planes);
}

static bool put_obj_vertex(shell_file *f, const uint32_t halves[3], rgb colour)
{
    plane_text **const planes = f->state;
    for (int a = 0; a < 3; a++) {
        plane_text between;
        char *const text = halves[a] % 2 ? between : planes[a][halves[a] / 2];
        if (halves[a] % 2 || !*text)
            decimal_of_double(coordinate_of(f->cells, a, halves[a]), text);
        fprintf(f->to, a ? " %s" : "v %s", text);
    }
    for (int c = 0; f->has_corners && c < 3; c++)
        fprintf(f->to, " %.4f", colour.at[c] / 255.0);
    return putc('\n', f->to) != EOF;
}

static bool put_obj_triangle(shell_file *f, const uint32_t triangle[3], rgb colour)
{
    (void)colour;
    return fprintf(f->to, "f %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", triangle[0] + 1, triangle[1] + 1, triangle[2] + 1) > 0;
}

static const shell_format shell_obj = {
    .has_corners = true, .begin = begin_obj, .vertex = put_obj_vertex, .triangle = put_obj_triangle, .end = end_obj};

/* -------------------------------------------------------------------------------------------------------------------------- GLB */

/*
 * Binary glTF 2.0: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
 *
 * Positions are floats there. They count cells, which is exact; the node scales them by the lengths of a cell and moves them to the
 * origin. There are no normals, so that readers shade each triangle flat. Colours are those of vertices, linear as glTF has them,
 * with a matte material, as the one that readers have without is a metal.
 */
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

static int check_glb(const char *path, const tribox_grid *grid)
{
    for (int a = 0; a < 3; a++)
        if (grid->size[a] > SIDE_MOST)
            return message_failure("%s: .glb holds at most %d cells on each axis, the grid has %u x %u x %u; write .ply or .obj",
                                   path, (int)SIDE_MOST, grid->size[0], grid->size[1], grid->size[2]);
    return check_grid(path, grid);
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

/*
 * Two views of one buffer, vertices, with a colour after each where there are colours, and which of them make triangles; and where
 * positions, corners of triangles and colours are in them, after the first's least and most.
 */
static void describe_mesh(char text[TEXT_MAX], const shell_file *f, uint64_t vertex_bytes)
{
    extent e = {{UINT32_MAX, UINT32_MAX, UINT32_MAX}, {0, 0, 0}};
    double corner[3], low[3], high[3];
    char place[3 * DECIMAL_MAX], scale[3 * DECIMAL_MAX], least[3 * DECIMAL_MAX], most[3 * DECIMAL_MAX];
    char colours[128] = "";
    const uint64_t vertices = vertex_bytes * f->vertices, triangles = TRIANGLE_BYTES * f->shell->triangles;
    lattice_vertices(&f->shell->points, widen, &e);
    for (int a = 0; a < 3; a++) {
        corner[a] = f->cells->grid.origin[a] + f->cells->shift[a];
        low[a] = e.least[a] / 2.0;
        high[a] = e.most[a] / 2.0;
    }
    if (f->has_corners)
        snprintf(colours, sizeof colours,
                 ",{\"bufferView\":0,\"byteOffset\":%d,\"componentType\":5123,\"normalized\":true,\"count\":%" PRIu64
                 ",\"type\":\"VEC4\"}",
                 (int)VERTEX_BYTES, f->vertices);
    snprintf(text, TEXT_MAX,
             "{\"asset\":{\"version\":\"2.0\",\"generator\":\"tribox\"},"
             "\"nodes\":[{\"name\":\"tribox\",\"mesh\":0,\"translation\":[%s],\"scale\":[%s]}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0%s}]}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%" PRIu64
             ",\"type\":\"VEC3\",\"min\":[%s],\"max\":[%s]},"
             "{\"bufferView\":1,\"componentType\":5125,\"count\":%" PRIu64 ",\"type\":\"SCALAR\"}%s],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%" PRIu64 "%s,\"target\":34962},"
             "{\"buffer\":0,\"byteOffset\":%" PRIu64 ",\"byteLength\":%" PRIu64 ",\"target\":34963}],"
             "\"buffers\":[{\"byteLength\":%" PRIu64 "}],%s\"scene\":0,\"scenes\":[{\"nodes\":[0]}]}",
             decimals_of(corner, ',', place), decimals_of(f->cells->grid.cell, ',', scale),
             f->has_corners ? ",\"COLOR_0\":2},\"indices\":1,\"material\":0" : "},\"indices\":1", f->vertices,
             decimals_of(low, ',', least), decimals_of(high, ',', most), 3 * f->shell->triangles, colours, vertices,
             f->has_corners ? ",\"byteStride\":20" : "", vertices, triangles, vertices + triangles,
             f->has_corners ? "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":1}}]," : "");
}

/* In 16 bits all bytes stay apart, the dark ones too. */
static uint32_t linear_of(const rgb_curve *curve, unsigned char byte)
{
    return (uint32_t)((double)curve->light[byte] * UINT16_MAX + 0.5);
}

static bool put_glb_vertex(shell_file *f, const uint32_t halves[3], rgb colour)
{
    const float place[3] = {(float)halves[0] / 2, (float)halves[1] / 2, (float)halves[2] / 2};
    uint32_t number[COLOURED_BYTES / 4];
    memcpy(number, place, sizeof place);
    if (f->has_corners) {
        number[3] = linear_of(f->state, colour.at[0]) | linear_of(f->state, colour.at[1]) << 16;
        number[4] = linear_of(f->state, colour.at[2]) | (uint32_t)UINT16_MAX << 16;
    }
    return volume_put_numbers(f->to, number, f->has_corners ? 5 : 3);
}

static bool put_glb_triangle(shell_file *f, const uint32_t triangle[3], rgb colour)
{
    (void)colour;
    return volume_put_numbers(f->to, triangle, 3);
}

/* Blanks fill the text up to a multiple of four. No cell that is set, no mesh: glTF has no empty ones. */
static int begin_glb(shell_file *f)
{
    static rgb_curve curve;
    char text[TEXT_MAX] = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"tribox\"},\"scene\":0,\"scenes\":[{}]}";
    const uint64_t vertex_bytes = f->has_corners ? COLOURED_BYTES : VERTEX_BYTES;
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
    volume_put_numbers(f->to, (const uint32_t[3]){2, (uint32_t)all, (uint32_t)strlen(text)}, 3);
    fprintf(f->to, "JSON%s", text);
    if (bytes) {
        volume_put_numbers(f->to, (const uint32_t[1]){(uint32_t)bytes}, 1);
        fwrite("BIN", 1, 4, f->to);
    }
    return EXIT_CODE_OK;
}

static const shell_format shell_glb = {
    .has_corners = true, .begin = begin_glb, .vertex = put_glb_vertex, .triangle = put_glb_triangle};

/* ------------------------------------------------------------------------------------------------------------------ all of them */

/* Progress: so much for finding the surface, the rest for writing. */
static const double share_of_finding = 0.7;

static uint32_t find_corner(const shell_corners *c, uint32_t vertex, rgb colour)
{
    uint32_t n = c->first[vertex];
    while (n != UINT32_MAX && rgb_number(c->of[n].colour) != rgb_number(colour))
        n = c->of[n].next;
    return n;
}

static bool take_corners(void *data, const uint32_t triangle[3], rgb colour)
{
    shell_corners *const c = data;
    for (int n = 0; n < 3 && c->count <= LATTICE_VERTICES_MAX; n++)
        if (find_corner(c, triangle[n], colour) == UINT32_MAX) {
            c->of[c->count] = (shell_corner){triangle[n], c->first[triangle[n]], colour};
            c->first[triangle[n]] = (uint32_t)c->count++;
        }
    return c->count <= LATTICE_VERTICES_MAX;
}

static bool take_place(void *data, const uint32_t halves[3])
{
    uint32_t(**const to)[3] = data;
    memcpy(*(*to)++, halves, sizeof **to);
    return true;
}

/* Walks through the triangles. False without memory, or with more corners than the most vertices. */
static bool make_corners(shell_corners *c, const shell *s)
{
    const uint64_t all = 3 * s->triangles, most = (uint64_t)LATTICE_VERTICES_MAX + 1;
    const size_t vertices = (size_t)s->points.vertices + 1, corners = (size_t)(all < most ? all : most) + 1;
    c->places = malloc(vertices * sizeof *c->places);
    c->first = malloc(vertices * sizeof *c->first);
    c->of = malloc(corners * sizeof *c->of);
    if (!c->places || !c->first || !c->of)
        return false;
    uint32_t(*to)[3] = c->places;
    memset(c->first, 0xff, vertices * sizeof *c->first);
    lattice_vertices(&s->points, take_place, &to);
    shell_triangles(s, take_corners, c, (shell_share){.bar = NULL});
    return c->count <= LATTICE_VERTICES_MAX;
}

static bool take_triangle(void *file, const uint32_t triangle[3], rgb colour)
{
    shell_file *const f = file;
    uint32_t own[3];
    for (int n = 0; n < 3; n++)
        own[n] = f->has_corners ? find_corner(&f->corners, triangle[n], colour) : triangle[n];
    return f->format->triangle(f, own, colour);
}

static bool take_vertex(void *file, const uint32_t halves[3])
{
    shell_file *const f = file;
    return f->format->vertex(f, halves, (rgb){{0, 0, 0}});
}

/* Where the stream fails it stops, and ferror tells. */
static int write_file(shell_file *f, progress *bar)
{
    const shell_corners *const c = &f->corners;
    f->vertices = f->has_corners ? c->count : f->shell->points.vertices;
    const int code = f->format->begin(f);
    bool is_written = !code && (f->has_corners || lattice_vertices(&f->shell->points, take_vertex, f));
    for (size_t n = 0; is_written && n < c->count; n++)
        is_written = f->format->vertex(f, c->places[c->of[n].vertex], c->of[n].colour);
    if (is_written)
        shell_triangles(f->shell, take_triangle, f, (shell_share){bar, share_of_finding, 1});
    if (f->format->end)
        f->format->end(f);
    return code;
}

static int shell_write(brick_out *out, progress *bar)
{
    shell s;
    const shell_format *const format = out->format->writer->shell;
    shell_file f = {.to = out->to, .path = out->file->path, .cells = &out->cells, .shell = &s, .format = format};
    f.has_corners = format->has_corners && out->cells.colours;
    int code = EXIT_CODE_OK;
    if (!shell_make(&s, &out->cells, bar, share_of_finding))
        code = message_failure("%s: out of memory for the surface of the cells", f.path);
    else if (s.points.vertices > LATTICE_VERTICES_MAX)
        code = message_failure("%s: the surface of the cells has %" PRIu64 " vertices, and %d are the most: %s", f.path,
                               s.points.vertices, (int)LATTICE_VERTICES_MAX, shell_instead);
    else if (f.has_corners && !make_corners(&f.corners, &s))
        code = message_failure("%s: out of memory for the colours of its vertices", f.path);
    if (!code)
        code = write_file(&f, bar);
    free(f.corners.places);
    free(f.corners.first);
    free(f.corners.of);
    shell_free(&s);
    return code;
}

const volume_writer volume_ply = {.check_grid = check_grid, .write_all = shell_write, .shell = &shell_ply};
const volume_writer volume_obj = {.check_grid = check_grid, .write_all = shell_write, .shell = &shell_obj};
const volume_writer volume_glb = {.check_grid = check_glb, .write_all = shell_write, .shell = &shell_glb};
