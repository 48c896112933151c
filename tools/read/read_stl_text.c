/* read_stl_text.c - reads STL files that are text: solids of facets, each a normal, which is left out, and three vertices. */
#include <stdio.h>
#include <string.h>

#include "console/message.h"
#include "readers.h"
#include "words.h"

/* "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop endfacet ": no facet is shorter. */
enum { FACET_BYTES_MIN = 86 };

static int expect(words *w, const char *due)
{
    char quoted[16];
    if (words_next(w) && words_is(w, due))
        return EXIT_CODE_OK;
    snprintf(quoted, sizeof quoted, "'%s'", due);
    return words_refuse(w, quoted);
}

static int read_vertex(words *w, indexed_mesh *m)
{
    double position[3];
    const int code = expect(w, "vertex");
    if (code)
        return code;
    for (int a = 0; a < 3; a++)
        if (!words_next(w) || !words_number(w, &position[a], &m->fit))
            return words_refuse(w, "a coordinate of a vertex");
    indexed_mesh_add_vertex(position, m);
    return EXIT_CODE_OK;
}

/* What follows the word "facet". */
static int read_facet(words *w, indexed_mesh *m)
{
    const uint32_t first = (uint32_t)m->vertices;
    int code = expect(w, "normal");
    for (int a = 0; !code && a < 3; a++)
        if (!words_next(w))
            code = words_refuse(w, "a coordinate of a normal");
    if (!code)
        code = expect(w, "outer");
    if (!code)
        code = expect(w, "loop");
    for (int v = 0; !code && v < 3; v++)
        code = read_vertex(w, m);
    if (!code)
        code = expect(w, "endloop");
    if (!code)
        code = expect(w, "endfacet");
    return code ? code : indexed_mesh_add_triangle(w->path, first, first + 1, first + 2, m);
}

/* What follows the word "solid". */
static int read_solid(words *w, indexed_mesh *m)
{
    int code = EXIT_CODE_OK;
    words_skip_line(w); /* the name */
    while (!code && words_next(w) && words_is(w, "facet"))
        code = read_facet(w, m);
    if (!code && !words_is(w, "endsolid"))
        code = words_refuse(w, "'facet' or 'endsolid'");
    words_skip_line(w);
    return code;
}

int read_stl_text(const char *path, const whole_file *file, indexed_mesh *m)
{
    words w = words_of(path, file, ' ');
    if (!words_next(&w) || !words_is(&w, "solid") || memchr(file->bytes, '\0', file->size))
        return message_failure(
            "%s: truncated, or not an STL file: its size is not the one that its header promises, nor is it text "
            "from 'solid' to 'endsolid'; write it again",
            path);
    int code = indexed_mesh_reserve(path, 3 * ((uint64_t)file->size / FACET_BYTES_MIN + 1), sizeof(double), m);
    while (!code) {
        code = read_solid(&w, m);
        if (code || !words_next(&w))
            break;
        if (!words_is(&w, "solid"))
            code = words_refuse(&w, "'solid'");
    }
    return code;
}
