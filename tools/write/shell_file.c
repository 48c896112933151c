/* shell_file.c - finds the surface of all cells, and has it written as a mesh. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brick_out.h"
#include "console/message.h"
#include "shell_file.h"

/* Progress: so much for finding the surface, the rest for writing. */
static const double share_of_finding = 0.7;

static const char shell_instead[] = "choose fewer cells, or write .npz or .vdb";

int bricks_check_shell(const char *path, const tribox_grid *grid)
{
    const uint64_t words = (uint64_t)voxels_layer_words(grid) * grid->size[2];
    (void)path;
    const int code = voxels_check_words(grid, shell_instead);
    return code ? code : voxels_check_memory(grid, words * sizeof(uint64_t) + shell_bytes(grid), shell_instead);
}

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

double shell_file_coordinate(const voxels *v, int axis, uint32_t halves)
{
    const double low = fma(halves / 2, v->grid.cell[axis], v->grid.origin[axis]);
    const double high = halves % 2 ? fma(halves / 2 + 1, v->grid.cell[axis], v->grid.origin[axis]) : low;
    return (halves % 2 ? low + (high - low) / 2 : low) + v->shift[axis];
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
    const shell_format *const format = out->format->bricks->shell;
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

#define SHELL_WRITER(name) \
    { \
        .open = gather_open, .put = gather_put, .end = shell_end, .drop = gather_drop, .shell = &(name) \
    }
const brick_writer bricks_ply = SHELL_WRITER(shell_ply), bricks_obj = SHELL_WRITER(shell_obj), bricks_glb = SHELL_WRITER(shell_glb);
