/* read_obj.c - reads OBJ files: their vertices and faces. Normals, texture, groups, materials and curves are left out. */
#include <inttypes.h>
#include <string.h>

#include "console/message.h"
#include "readers.h"
#include "words.h"

enum { VERTICES_AT_FIRST = 1024 };

/* Faces may refer to vertices that come after them: then vertices are read first, and faces once more. */
typedef struct obj {
    words words;
    indexed_mesh *mesh;
    bool has_vertices;   /* all of them are read, so that only faces are wanted */
    bool is_before_them; /* a face has referred to a vertex after it, so that only vertices are wanted */
    size_t above;        /* the vertices up to here, from which negative numbers count */
} obj;

static int make_room(const char *path, indexed_mesh *m)
{
    const uint64_t there = m->vertices, more = there ? 2 * there : VERTICES_AT_FIRST;
    return indexed_mesh_reserve(path, there < UINT32_MAX && more > UINT32_MAX ? UINT32_MAX : more, sizeof(double), m);
}

static int read_vertex(obj *o)
{
    indexed_mesh *const m = o->mesh;
    double position[3];
    o->above++;
    if (o->has_vertices)
        return EXIT_CODE_OK;
    for (int a = 0; a < 3; a++)
        if (!words_next_on_line(&o->words) || !words_number(&o->words, &position[a], &m->fit))
            return words_refuse(&o->words, "a coordinate of a vertex");
    const int code = m->vertices < m->vertices_max ? EXIT_CODE_OK : make_room(o->words.path, m);
    if (!code)
        indexed_mesh_add_vertex(position, m);
    return code;
}

/* The number of a vertex, before the first slash of the word; what follows are the numbers of its texture and its normal. */
static bool read_number(const words *w, bool *is_negative, uint64_t *number)
{
    words vertex = *w;
    const char *const slash = memchr(w->word, '/', w->length);
    *is_negative = w->length && *w->word == '-';
    vertex.word += *is_negative;
    vertex.length = (size_t)((slash ? slash : w->word + w->length) - vertex.word);
    for (const char *c = slash; c && c < w->word + w->length; c++)
        if (!strchr("/-0123456789", *c))
            return false;
    return words_whole(&vertex, number) && vertex.word[0] != '-';
}

static int refuse_corner(const words *w, size_t vertices)
{
    return message_failure("%s: damaged: line %" PRIu64 " refers to vertex %.*s, the file has %zu, counted from 1", w->path,
                           words_line(w), words_shown(w), w->word, vertices);
}

/* Sets o->is_before_them where the vertex may still follow. */
static int read_corner(obj *o, uint32_t *corner)
{
    const words *const w = &o->words;
    const size_t there = o->mesh->vertices;
    bool is_negative;
    uint64_t number;
    if (!read_number(w, &is_negative, &number))
        return words_refuse(w, "the number of a vertex");
    if (!number || (is_negative && number > o->above) || number > UINT32_MAX || (o->has_vertices && !is_negative && number > there))
        return refuse_corner(w, is_negative ? o->above : there);
    *corner = (uint32_t)(is_negative ? o->above - number : number - 1);
    o->is_before_them = *corner >= there;
    return EXIT_CODE_OK;
}

static int read_face(obj *o)
{
    indexed_mesh *const m = o->mesh;
    size_t corners = 0;
    int code = EXIT_CODE_OK;
    while (!code && !o->is_before_them && words_next_on_line(&o->words)) {
        code = indexed_mesh_reserve_face(o->words.path, corners + 1, m);
        if (!code)
            code = read_corner(o, &m->face[corners++]);
    }
    if (!code && !o->is_before_them && !corners)
        code = words_refuse(&o->words, "the number of a vertex");
    return code || o->is_before_them ? code : indexed_mesh_add_face(o->words.path, corners, m);
}

/* Reads the rest of a line after its first word. */
static int read_line(obj *o)
{
    const words *const w = &o->words;
    if (words_is(w, "v"))
        return read_vertex(o);
    if (o->is_before_them)
        return EXIT_CODE_OK;
    if (words_is(w, "f"))
        return read_face(o);
    o->mesh->left_out += words_is(w, "l") || words_is(w, "p");
    return EXIT_CODE_OK;
}

static int read_lines(const char *path, const whole_file *file, obj *o)
{
    int code = EXIT_CODE_OK;
    o->words = words_of(path, file, '#');
    o->words.is_continued = true;
    o->above = 0;
    while (!code && words_next(&o->words)) {
        code = read_line(o);
        words_skip_line(&o->words);
    }
    return code;
}

int read_obj(const char *path, const whole_file *file, indexed_mesh *m)
{
    obj o = {.mesh = m};
    int code = read_lines(path, file, &o);
    if (!code && o.is_before_them) {
        o.is_before_them = false;
        o.has_vertices = true;
        m->triangles = m->left_out = m->miscut = 0;
        code = read_lines(path, file, &o);
    }
    if (!code && !m->vertices)
        code = message_failure("%s: not an OBJ file, or an empty one: it has no line with a vertex, 'v X Y Z'", path);
    return code;
}
