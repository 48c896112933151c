/* bricks_shell.c - gathers the words of all cells, finds their surface, and has it written as a mesh. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "brick_cutter.h"
#include "brick_writer.h"
#include "console/message.h"
#include "shell_file.h"

/* Progress: so much for finding the surface, the rest for writing. */
static const double share_of_finding = 0.7;

typedef struct shell_words {
    voxels_slab slab;
    uint64_t *words; /* NULL until a brick comes */
} shell_words;

static const char shell_instead[] = "choose fewer cells, or write .npz or .vdb";

int bricks_check_shell(const char *path, const tribox_grid *grid)
{
    const uint64_t words = (uint64_t)voxels_layer_words(grid) * grid->size[2];
    (void)path;
    const int code = voxels_check_words(grid, shell_instead);
    return code ? code : voxels_check_memory(grid, words * sizeof(uint64_t) + shell_bytes(grid), shell_instead);
}

static int open_shell(brick_out *out)
{
    out->state = calloc(1, sizeof(shell_words));
    return out->state ? EXIT_CODE_OK : message_failure("%s: out of memory", out->file->path);
}

/* Without a brick as well there are words, all of them 0. */
static int take_shell_words(brick_out *out)
{
    shell_words *const g = out->state;
    const size_t words = voxels_layer_words(&out->cells.grid) * out->cells.grid.size[2];
    if (g->slab.bits)
        return EXIT_CODE_OK;
    g->words = calloc(words, sizeof *g->words);
    g->slab = (voxels_slab){.layers = out->cells.grid.size[2], .bits = g->words};
    return g->words ? EXIT_CODE_OK : message_failure("%s: out of memory for its cells", out->file->path);
}

static int put_shell(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    const shell_words *const g = out->state;
    const int code = take_shell_words(out);
    if (!code)
        bricks_lay(&out->cells.grid, g->words, at, bits);
    return code;
}

static void take_whole(brick_out *out, const voxels *v)
{
    shell_words *const g = out->state;
    g->slab = *v->slab;
}

static void drop_shell(brick_out *out)
{
    shell_words *const g = out->state;
    free(g->words);
    free(g);
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

static int write_shell(brick_out *out, progress *bar, int (*write)(shell_file *f))
{
    shell s;
    shell_words *const g = out->state;
    int code = take_shell_words(out);
    if (code)
        return code;
    out->cells.slab = &g->slab;
    out->cells.slabs = 1;
    shell_file f = {.to = out->to, .path = out->file->path, .cells = &out->cells, .shell = &s, .bar = bar};
    if (!shell_make(&s, &out->cells, tell_finding, bar))
        code = message_failure("%s: out of memory for the surface of the cells", out->file->path);
    if (!code)
        code = check_vertices(out, &s);
    if (!code)
        code = write(&f);
    shell_free(&s);
    return code;
}

double shell_file_coordinate(const voxels *v, int axis, uint32_t halves)
{
    const double low = fma(halves / 2, v->grid.cell[axis], v->grid.origin[axis]);
    const double high = halves % 2 ? fma(halves / 2 + 1, v->grid.cell[axis], v->grid.origin[axis]) : low;
    return (halves % 2 ? low + (high - low) / 2 : low) + v->shift[axis];
}

typedef struct file_triangles {
    shell_file *f;
    shell_taker *take;
} file_triangles;

static void take_file_triangle(void *data, const uint32_t triangle[3], rgb colour)
{
    const file_triangles *const t = data;
    const shell_corners *const c = t->f->corners;
    uint32_t own[3];
    for (int n = 0; n < 3; n++)
        own[n] = c ? shell_corners_find(c, triangle[n], colour) : triangle[n];
    t->take(t->f, own, colour);
}

static bool tell_writing(void *data, double done)
{
    const shell_file *const f = ((const file_triangles *)data)->f;
    progress_tell(f->bar, share_of_finding + (1 - share_of_finding) * done);
    return ferror(f->to);
}

void shell_file_triangles(shell_file *f, shell_taker *take)
{
    file_triangles t = {f, take};
    shell_triangles(f->shell, take_file_triangle, tell_writing, &t);
}

uint64_t shell_file_vertices(const shell_file *f) { return f->corners ? f->corners->count : f->shell->points.vertices; }

typedef struct file_vertices {
    shell_file *f;
    bool (*take)(void *file, const uint32_t halves[3], rgb colour);
} file_vertices;

static bool take_file_vertex(void *data, const uint32_t halves[3])
{
    const file_vertices *const v = data;
    return v->take(v->f, halves, (rgb){{0, 0, 0}});
}

bool shell_file_each_vertex(shell_file *f, bool (*take)(void *file, const uint32_t halves[3], rgb colour))
{
    const shell_corners *const c = f->corners;
    if (!c)
        return lattice_vertices(&f->shell->points, take_file_vertex, &(file_vertices){f, take});
    size_t n = 0;
    while (n < c->count && take(f, c->places[c->of[n].vertex], c->of[n].colour))
        n++;
    return n == c->count;
}

static bool tell_nothing(void *data, double done)
{
    (void)data, (void)done;
    return false;
}

static int with_corners(shell_file *f, int (*write)(shell_file *f))
{
    shell_corners corners;
    int code = EXIT_CODE_OK;
    if (!shell_corners_make(&corners, f->shell, tell_nothing, f))
        code = message_failure("%s: out of memory for the colours of its vertices", f->path);
    f->corners = &corners;
    if (!code)
        code = write(f);
    shell_corners_free(&corners);
    return code;
}

static int write_obj(shell_file *f) { return f->cells->colours ? with_corners(f, shell_write_obj) : shell_write_obj(f); }
static int write_glb(shell_file *f) { return f->cells->colours ? with_corners(f, shell_write_glb) : shell_write_glb(f); }

static int end_ply(brick_out *out, progress *bar) { return write_shell(out, bar, shell_write_ply); }
static int end_obj(brick_out *out, progress *bar) { return write_shell(out, bar, write_obj); }
static int end_glb(brick_out *out, progress *bar) { return write_shell(out, bar, write_glb); }

const brick_writer bricks_ply = {.open = open_shell, .put = put_shell, .whole = take_whole, .end = end_ply, .drop = drop_shell};
const brick_writer bricks_obj = {.open = open_shell, .put = put_shell, .whole = take_whole, .end = end_obj, .drop = drop_shell};
const brick_writer bricks_glb = {.open = open_shell, .put = put_shell, .whole = take_whole, .end = end_glb, .drop = drop_shell};
