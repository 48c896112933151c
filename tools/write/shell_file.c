/* shell_file.c - finds the surface of all cells, and writes it as a mesh. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brick_out.h"
#include "console/written_number.h"
#include "console/message.h"
#include "read/little.h"
#include "shell/shell.h"

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
    size_t count, room;
    bool lacks_memory;
} shell_corners;

typedef struct shell_file {
    FILE *to;
    const char *path;
    const voxels *cells;
    const shell *shell;
    progress *bar;
    const struct shell_format *format;
    uint64_t vertices;            /* of the file */
    const shell_corners *corners; /* NULL: the shell's vertices are those of the file */
    void *state;                  /* the format's own */
} shell_file;

typedef struct shell_format {
    bool has_corners;                                                    /* it has colours at vertices alone */
    int (*begin)(shell_file *f);                                         /* writes what stands first. Returns an exit_code */
    void (*vertex)(shell_file *f, const uint32_t halves[3], rgb colour); /* in halves of cells; colour: of a corner */
    void (*triangle)(shell_file *f, const uint32_t triangle[3], rgb colour);
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

static void put_ply_vertex(shell_file *f, const uint32_t halves[3], rgb colour)
{
    unsigned char bytes[3 * sizeof(uint64_t)];
    (void)colour;
    for (int a = 0; a < 3; a++) {
        const double x = coordinate_of(f->cells, a, halves[a]);
        uint64_t bits;
        memcpy(&bits, &x, sizeof bits);
        little_put64(bytes + 8 * a, bits);
    }
    fwrite(bytes, 1, sizeof bytes, f->to);
}

static void put_ply_triangle(shell_file *f, const uint32_t triangle[3], rgb colour)
{
    enum { PLAIN = 1 + 3 * sizeof(uint32_t) };
    unsigned char bytes[PLAIN + sizeof colour] = {3};
    for (int n = 0; n < 3; n++)
        little_put32(bytes + 1 + 4 * n, triangle[n]);
    memcpy(bytes + PLAIN, colour.at, sizeof colour);
    fwrite(bytes, 1, f->cells->colours ? sizeof bytes : PLAIN, f->to);
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

static void put_obj_vertex(shell_file *f, const uint32_t halves[3], rgb colour)
{
    plane_text **const planes = f->state;
    for (int a = 0; a < 3; a++) {
        plane_text between;
        char *const text = halves[a] % 2 ? between : planes[a][halves[a] / 2];
        if (halves[a] % 2 || !*text)
            decimal_of_double(coordinate_of(f->cells, a, halves[a]), text);
        fprintf(f->to, a ? " %s" : "v %s", text);
    }
    for (int c = 0; f->corners && c < 3; c++)
        fprintf(f->to, " %.4f", colour.at[c] / 255.0);
    putc('\n', f->to);
}

static void put_obj_triangle(shell_file *f, const uint32_t triangle[3], rgb colour)
{
    (void)colour;
    fprintf(f->to, "f %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", triangle[0] + 1, triangle[1] + 1, triangle[2] + 1);
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

static void put_glb_vertex(shell_file *f, const uint32_t halves[3], rgb colour)
{
    uint32_t number[COLOURED_BYTES / 4];
    find_bits(halves, number);
    if (f->corners) {
        number[3] = linear_of(f->state, colour.at[0]) | linear_of(f->state, colour.at[1]) << 16;
        number[4] = linear_of(f->state, colour.at[2]) | (uint32_t)UINT16_MAX << 16;
    }
    put_numbers(f->to, number, f->corners ? 5 : 3);
}

static void put_glb_triangle(shell_file *f, const uint32_t triangle[3], rgb colour)
{
    (void)colour;
    put_numbers(f->to, triangle, 3);
}

/* Blanks fill the text up to a multiple of four. No cell that is set, no mesh: glTF has no empty ones. */
static int begin_glb(shell_file *f)
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

static void add(shell_corners *c, uint32_t vertex, rgb colour)
{
    if (c->count == c->room) {
        const size_t room = c->room ? 2 * c->room : 4096;
        shell_corner *const more = room <= (size_t)LATTICE_VERTICES_MAX + 1 ? realloc(c->of, room * sizeof *more) : NULL;
        c->lacks_memory = !more;
        if (!more)
            return;
        c->of = more;
        c->room = room;
    }
    c->of[c->count] = (shell_corner){vertex, c->first[vertex], colour};
    c->first[vertex] = (uint32_t)c->count++;
}

static void take_corners(void *data, const uint32_t triangle[3], rgb colour)
{
    shell_corners *const c = data;
    for (int n = 0; n < 3 && !c->lacks_memory; n++)
        if (find_corner(c, triangle[n], colour) == UINT32_MAX)
            add(c, triangle[n], colour);
}

static bool take_place(void *data, const uint32_t halves[3])
{
    uint32_t(**const to)[3] = data;
    memcpy(*(*to)++, halves, sizeof **to);
    return true;
}

static bool lacks_memory(void *data, double done)
{
    const shell_corners *const c = data;
    (void)done;
    return c->lacks_memory;
}

/* Walks through the triangles. False without memory. */
static bool make_corners(shell_corners *c, const shell *s)
{
    const size_t vertices = (size_t)s->points.vertices + 1;
    *c = (shell_corners){.places = malloc(vertices * sizeof *c->places), .first = malloc(vertices * sizeof *c->first)};
    if (!c->places || !c->first)
        return false;
    uint32_t(*to)[3] = c->places;
    memset(c->first, 0xff, vertices * sizeof *c->first);
    lattice_vertices(&s->points, take_place, &to);
    shell_triangles(s, take_corners, lacks_memory, c);
    return !c->lacks_memory;
}

static bool tell_finding(void *data, double done)
{
    progress_tell(data, share_of_finding * done);
    return false;
}

static int check_vertices(const brick_out *out, const shell *s)
{
    if (s->points.vertices <= LATTICE_VERTICES_MAX)
        return EXIT_CODE_OK;
    return message_failure("%s: the surface of the cells has %" PRIu64
                           " vertices, and %d are the most: choose fewer cells, or write "
                           ".npz or .vdb",
                           out->file->path, s->points.vertices, (int)LATTICE_VERTICES_MAX);
}

static void take_triangle(void *file, const uint32_t triangle[3], rgb colour)
{
    shell_file *const f = file;
    uint32_t own[3];
    for (int n = 0; n < 3; n++)
        own[n] = f->corners ? find_corner(f->corners, triangle[n], colour) : triangle[n];
    f->format->triangle(f, own, colour);
}

static bool tell_writing(void *file, double done)
{
    const shell_file *const f = file;
    progress_tell(f->bar, share_of_finding + (1 - share_of_finding) * done);
    return ferror(f->to);
}

static bool take_vertex(void *file, const uint32_t halves[3])
{
    shell_file *const f = file;
    f->format->vertex(f, halves, (rgb){{0, 0, 0}});
    return !ferror(f->to);
}

/* Where the stream fails it stops, and ferror tells. */
static int write_file(shell_file *f)
{
    const shell_corners *const c = f->corners;
    f->vertices = c ? c->count : f->shell->points.vertices;
    const int code = f->format->begin(f);
    if (!code && !c)
        lattice_vertices(&f->shell->points, take_vertex, f);
    for (size_t n = 0; !code && c && n < c->count && !ferror(f->to); n++)
        f->format->vertex(f, c->places[c->of[n].vertex], c->of[n].colour);
    if (!code && !ferror(f->to))
        shell_triangles(f->shell, take_triangle, tell_writing, f);
    if (f->format->end)
        f->format->end(f);
    return code;
}

static int write_with_corners(shell_file *f)
{
    shell_corners corners;
    const bool is_made = make_corners(&corners, f->shell);
    f->corners = &corners;
    const int code = is_made ? write_file(f) : message_failure("%s: out of memory for the colours of its vertices", f->path);
    free(corners.places);
    free(corners.first);
    free(corners.of);
    return code;
}

int shell_end(brick_out *out, progress *bar)
{
    shell s;
    const shell_format *const format = out->format->writer->bricks->shell;
    shell_file f = {.to = out->to, .path = out->file->path, .cells = &out->cells, .shell = &s, .bar = bar, .format = format};
    int code = EXIT_CODE_OK;
    if (!shell_make(&s, &out->cells, tell_finding, bar))
        code = message_failure("%s: out of memory for the surface of the cells", out->file->path);
    if (!code)
        code = check_vertices(out, &s);
    if (!code)
        code = format->has_corners && out->cells.colours ? write_with_corners(&f) : write_file(&f);
    shell_free(&s);
    return code;
}

#define SHELL_WRITER(check, format) \
    { \
        .check_grid = (check), .bricks = &(const brick_writer) \
        { \
            .open = gather_open, .put = gather_put, .end = shell_end, .drop = gather_drop, .shell = &(format) \
        } \
    }
const volume_writer volume_ply = SHELL_WRITER(check_grid, shell_ply), volume_obj = SHELL_WRITER(check_grid, shell_obj),
                    volume_glb = SHELL_WRITER(check_glb, shell_glb);
