/* read_off.c - reads OFF files: a line for each vertex and each face; colours, normals and the like after them are left out. */
#include <inttypes.h>
#include <string.h>

#include "console/message.h"
#include "readers.h"
#include "words.h"

/* "0 0 0" and "0", each with the end of its line: no vertex or face is shorter. */
enum { VERTEX_BYTES_MIN = 6, FACE_BYTES_MIN = 2 };

/* Words such as OFF, COFF, STCNOFF; the first count may follow at once, as in OFF8. */
static int read_keyword(words *w)
{
    if (!words_next(w))
        return words_refuse(w, "'OFF'");
    const size_t prefix = strspn(w->word, "STCN");
    if (!strncmp(w->word + strspn(w->word, "STCN4n"), "OFF", 3) && strncmp(w->word + prefix, "OFF", 3))
        return message_failure("%s: has vertices of other than three coordinates; save it with three", w->path);
    if (strncmp(w->word + prefix, "OFF", 3))
        return message_failure("%s: not an OFF file: it does not begin with 'OFF'", w->path);
    w->at = w->word + prefix + 3;
    return EXIT_CODE_OK;
}

static int read_counts(words *w, uint64_t *vertices, uint64_t *faces)
{
    if (words_next(w) && words_is(w, "BINARY"))
        return message_failure("%s: is binary, and only OFF as text is read; save it as text", w->path);
    if (!words_whole(w, vertices) || !words_next(w) || !words_whole(w, faces))
        return message_failure("%s: truncated, or not text: no counts of vertices and faces after 'OFF'; write it again as text",
                               w->path);
    words_skip_line(w);
    const uint64_t bytes = (uint64_t)(w->end - w->at) + 1; /* the last line may lack its end */
    if (*vertices > bytes / VERTEX_BYTES_MIN || *faces > bytes / FACE_BYTES_MIN)
        return message_failure("%s: truncated: %" PRIu64 " vertices and %" PRIu64
                               " faces promised, more than the file has bytes for; write it again",
                               w->path, *vertices, *faces);
    return EXIT_CODE_OK;
}

static int read_vertex(words *w, indexed_mesh *m)
{
    double position[3];
    for (int a = 0; a < 3; a++)
        if (!(a ? words_next_on_line(w) : words_next(w)) || !words_number(w, &position[a], &m->fit))
            return words_refuse(w, "a coordinate of a vertex");
    words_skip_line(w);
    indexed_mesh_add_vertex(position, m);
    return EXIT_CODE_OK;
}

static int read_face(words *w, uint64_t number, indexed_mesh *m)
{
    uint64_t corners, index;
    if (!words_next(w) || !words_whole(w, &corners))
        return words_refuse(w, "the number of vertices of a face");
    if (corners > (uint64_t)(w->end - w->at) / 2)
        return message_failure("%s: truncated: face %" PRIu64 " has fewer than its %" PRIu64 " vertices; write it again", w->path,
                               number, corners);
    int code = indexed_mesh_reserve_face(w->path, corners, m);
    for (uint64_t i = 0; !code && i < corners; i++) {
        if (!words_next_on_line(w) || !words_whole(w, &index))
            return words_refuse(w, "the number of a vertex");
        if (index >= m->vertices)
            return message_failure("%s: damaged: face %" PRIu64 " refers to vertex %.*s, the file has %zu, counted from 0", w->path,
                                   number, words_shown(w), w->word, m->vertices);
        m->face[i] = (uint32_t)index;
    }
    words_skip_line(w);
    return code ? code : indexed_mesh_add_face(w->path, (size_t)corners, m);
}

int read_off(const char *path, const whole_file *file, indexed_mesh *m)
{
    words w = words_of(path, file, '#');
    uint64_t vertices = 0, faces = 0;
    int code = read_keyword(&w);
    if (!code)
        code = read_counts(&w, &vertices, &faces);
    if (!code)
        code = indexed_mesh_reserve(path, vertices, sizeof(double), m);
    for (uint64_t i = 0; !code && i < vertices; i++)
        code = read_vertex(&w, m);
    for (uint64_t i = 0; !code && i < faces; i++)
        code = read_face(&w, i, m);
    return code;
}
