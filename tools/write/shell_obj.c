/*
 * shell_obj.c - a shell as Wavefront's text, with decimals that give the planes of the grid back. Colours are those of vertices, as
 * materials would take a file beside this one.
 */
#include <inttypes.h>
#include <stdlib.h>

#include "console/decimal.h"
#include "console/message.h"
#include "shell_file.h"

/* The texts of all planes, as they are found; few against vertices, and long to find. */
typedef struct obj_texts {
    shell_file file; /* the first, as vertices and triangles are handed over with it */
    char (*plane[3])[DECIMAL_MAX];
} obj_texts;

static const char *text_of(const obj_texts *t, int axis, uint32_t halves, char between[DECIMAL_MAX])
{
    char *const text = halves % 2 ? between : t->plane[axis][halves / 2];
    if (halves % 2 || !*text)
        decimal_of_double(shell_file_coordinate(t->file.cells, axis, halves), text);
    return text;
}

static bool put_vertex_obj(void *file, const uint32_t halves[3], rgb colour)
{
    char between[3][DECIMAL_MAX];
    const obj_texts *const t = file;
    fprintf(t->file.to, "v %s %s %s", text_of(t, 0, halves[0], between[0]), text_of(t, 1, halves[1], between[1]),
            text_of(t, 2, halves[2], between[2]));
    for (int c = 0; t->file.corners && c < 3; c++)
        fprintf(t->file.to, " %.4f", colour.at[c] / 255.0);
    putc('\n', t->file.to);
    return !ferror(t->file.to);
}

static void put_triangle_obj(void *file, const uint32_t triangle[3], rgb colour)
{
    const obj_texts *const t = file;
    (void)colour;
    fprintf(t->file.to, "f %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", triangle[0] + 1, triangle[1] + 1, triangle[2] + 1);
}

static void write_lines(obj_texts *texts)
{
    shell_file *const f = &texts->file;
    fprintf(f->to, "# the surface of cells, by tribox: %" PRIu64 " vertices, %" PRIu64 " triangles\n", shell_file_vertices(f),
            f->shell->triangles);
    if (shell_file_each_vertex(f, put_vertex_obj))
        shell_file_triangles(f, put_triangle_obj);
}

int shell_write_obj(shell_file *f)
{
    obj_texts texts = {.file = *f};
    bool has_room = true;
    for (int a = 0; a < 3; a++) {
        texts.plane[a] = calloc(f->shell->points.size[a], sizeof *texts.plane[a]);
        has_room &= texts.plane[a] != NULL;
    }
    if (has_room)
        write_lines(&texts);
    for (int a = 0; a < 3; a++)
        free(texts.plane[a]);
    return has_room ? EXIT_CODE_OK : message_failure("%s: out of memory for its numbers", f->path);
}
