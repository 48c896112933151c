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
typedef char plane_text[DECIMAL_MAX];

static int begin(shell_file *f)
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

static void end(shell_file *f)
{
    plane_text **const planes = f->state;
    for (int a = 0; planes && a < 3; a++)
        free(planes[a]);
    free(planes);
}

static void put_vertex(shell_file *f, const uint32_t halves[3], rgb colour)
{
    plane_text **const planes = f->state;
    for (int a = 0; a < 3; a++) {
        plane_text between;
        char *const text = halves[a] % 2 ? between : planes[a][halves[a] / 2];
        if (halves[a] % 2 || !*text)
            decimal_of_double(shell_file_coordinate(f->cells, a, halves[a]), text);
        fprintf(f->to, a ? " %s" : "v %s", text);
    }
    for (int c = 0; f->corners && c < 3; c++)
        fprintf(f->to, " %.4f", colour.at[c] / 255.0);
    putc('\n', f->to);
}

static void put_triangle(shell_file *f, const uint32_t triangle[3], rgb colour)
{
    (void)colour;
    fprintf(f->to, "f %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", triangle[0] + 1, triangle[1] + 1, triangle[2] + 1);
}

const shell_format shell_obj = {.has_corners = true, .begin = begin, .vertex = put_vertex, .triangle = put_triangle, .end = end};
