/* colours_obj.c - OBJ: colours of vertices, `v X Y Z R G B`, and materials of faces. */
#include <inttypes.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "face_colours.h"
#include "files/named_file.h"
#include "read/obj_lines.h"
#include "rgb.h"

typedef struct material {
    char *name;
    rgb colour;
    bool has_colour;
} material;

typedef struct materials {
    material *of;
    size_t count, room;
} materials;

/* The first of that name; NULL where there is none. */
static const material *materials_find(const materials *m, const char *name, size_t length)
{
    for (size_t i = 0; i < m->count; i++)
        if (strlen(m->of[i].name) == length && !memcmp(m->of[i].name, name, length))
            return &m->of[i];
    return NULL;
}

static bool make_room(materials *m)
{
    if (m->count < m->room)
        return true;
    const size_t room = m->room ? 2 * m->room : 16;
    material *const more = realloc(m->of, room * sizeof *more);
    if (!more)
        return false;
    m->of = more;
    m->room = room;
    return true;
}

static bool add(materials *m, const char *name, size_t length)
{
    char *const copy = make_room(m) ? malloc(length + 1) : NULL;
    if (!copy)
        return false;
    memcpy(copy, name, length);
    copy[length] = '\0';
    m->of[m->count++] = (material){.name = copy};
    return true;
}

/* One number stands for all three. Spectra and other words are no colour. */
static void read_colour(material *to, words w)
{
    double number[3] = {0, 0, 0};
    int count = 0;
    while (count < 3 && words_next_on_line(&w) && words_number(&w, &number[count], &(float_fit){FLOAT_FIT_EXACT}))
        count++;
    for (int c = 1; count == 1 && c < 3; c++)
        number[c] = number[0];
    to->has_colour = count == 1 || count == 3;
    to->colour = to->has_colour ? rgb_of(number, 1) : RGB_GREY;
}

static bool read_lines(materials *m, const char *path, const whole_file *file)
{
    words w = words_of(path, file, '#');
    obj_line line;
    for (const char *from = file->bytes; obj_line_next(&w, from, &line); from = line.end) {
        size_t length;
        const char *const rest = obj_line_rest(&line, &length);
        if (words_is(&line.words, "newmtl")) {
            if (!add(m, rest, length))
                return false;
        } else if (m->count && words_is(&line.words, "Kd")) {
            read_colour(&m->of[m->count - 1], line.words);
        }
    }
    return true;
}

/* Adds those of a file. Returns an exit_code; materials_free may follow in any case. */
static int materials_read(materials *m, const char *path)
{
    whole_file file;
    int code = whole_file_read(path, &file);
    if (!code && !read_lines(m, path, &file))
        code = message_failure("%s: out of memory for its materials", path);
    whole_file_free(&file);
    return code;
}

static void materials_free(materials *m)
{
    for (size_t i = 0; i < m->count; i++)
        free(m->of[i].name);
    free(m->of);
    *m = (materials){.count = 0};
}

typedef struct obj {
    face_colours *f;
    const whole_file *file;
    obj_numbers numbers;
    rgb *vertex;       /* NULL where none has a colour */
    bool *is_coloured; /* each vertex */
    bool has_vertices; /* some have one */
    materials materials;
    const material *now;
    uint64_t missing; /* lines that use a material that there is not */
    int code;
} obj;

static bool read_numbers(words w, double number[6])
{
    int count = 0;
    while (count < 6 && words_next_on_line(&w) && words_number(&w, &number[count], &(float_fit){FLOAT_FIT_EXACT}))
        count++;
    return count == 6;
}

/* Faces refer to lines before and after them. */
static void count(obj *o, const obj_line *line)
{
    double number[6];
    if (line->kind == OBJ_VERTEX)
        o->numbers.all[line->which]++;
    if (line->kind == OBJ_VERTEX && line->which == OBJ_POSITIONS && !o->has_vertices)
        o->has_vertices = read_numbers(line->words, number);
}

static void take_vertex(obj *o, const obj_line *line)
{
    double number[6];
    if (line->kind != OBJ_VERTEX || line->which != OBJ_POSITIONS)
        return;
    const uint64_t n = o->numbers.here[OBJ_POSITIONS]++;
    o->is_coloured[n] = read_numbers(line->words, number);
    if (o->is_coloured[n])
        o->vertex[n] = rgb_of(number + 3, 1);
}

static void take_face(obj *o, const obj_line *line)
{
    obj_corners corners = obj_corners_of(line);
    rgb_sum sum = {.count = 0};
    uint64_t count = 0;
    words w = line->words;
    for (obj_reference r; o->has_vertices && obj_corners_next(&corners, &o->numbers, &r);)
        if (r.which == OBJ_POSITIONS && o->is_coloured[r.number])
            rgb_add(&sum, o->vertex[r.number]);
    while (words_next_on_line(&w))
        count++;
    const rgb mean = rgb_mean(&sum);
    const bool has_own = sum.count && sum.count == count;
    if (count > 2)
        o->f->to->from = has_own ? "vertices" : "materials";
    face_colours_add(o->f, count, has_own ? &mean : o->now && o->now->has_colour ? &o->now->colour : NULL);
}

static void use_material(obj *o, const obj_line *line)
{
    size_t length;
    const char *const name = obj_line_rest(line, &length);
    o->now = materials_find(&o->materials, name, length);
    if (o->now && o->now->has_colour)
        return;
    if (!o->missing++)
        message_say("warning: %s: material '%.*s' %s: its faces are grey", o->f->path, (int)(length < 60 ? length : 60), name,
                    o->now ? "has no Kd that is a colour" : "is in none of its .mtl files");
}

static char *beside(const char *path, const char *name, size_t length)
{
    const size_t folder = named_file_folder(path);
    char *const joined = malloc(folder + length + 1);
    if (!joined)
        return NULL;
    memcpy(joined, path, folder);
    memcpy(joined + folder, name, length);
    joined[folder + length] = '\0';
    for (char *c = joined + folder; *c; c++)
        *c = (char)(*c == '\\' ? '/' : *c);
    return joined;
}

/* Returns whether there is such a file. A path that is whole stays as it is. */
static bool take_library(obj *o, const char *name, size_t length, bool has_to)
{
    file_about about;
    char *const path = beside(*name == '/' ? "" : o->f->path, name, length);
    if (!path) {
        o->code = message_failure("%s: out of memory for its materials", o->f->path);
        return true;
    }
    const bool is_there = named_file_about(path, &about) && about.kind == FILE_KIND_REGULAR && about.size;
    if (is_there)
        o->code = file_out_check(o->f->outputs, "file of its materials", (const char *const[]){path}, 1);
    if (is_there && !o->code)
        o->code = materials_read(&o->materials, path);
    if (!is_there && has_to)
        message_say("warning: %s: its materials '%s' are no file that can be read: their faces are grey", o->f->path, path);
    free(path);
    return is_there;
}

/* One name, be it with blanks, or several. */
static void take_libraries(obj *o, const obj_line *line)
{
    size_t length;
    const char *const all = obj_line_rest(line, &length);
    words w = line->words;
    const bool is_one = !memchr(all, ' ', length);
    if (!length || take_library(o, all, length, is_one) || is_one)
        return;
    while (!o->code && words_next_on_line(&w))
        take_library(o, w.word, w.length, true);
}

static void take(obj *o, const obj_line *line)
{
    if (line->kind == OBJ_VERTEX)
        o->numbers.here[line->which]++;
    else if (line->kind == OBJ_FACE)
        take_face(o, line);
    else if (words_is(&line->words, "usemtl"))
        use_material(o, line);
    else if (words_is(&line->words, "mtllib"))
        take_libraries(o, line);
}

static void walk(obj *o, void (*each)(obj *o, const obj_line *line))
{
    words w = words_of(o->f->path, o->file, '#');
    const char *from = o->file->bytes;
    w.is_continued = true;
    for (obj_line line; !o->code && !o->f->is_changed && obj_line_next(&w, from, &line); from = line.end)
        each(o, &line);
}

static void take_vertices(obj *o)
{
    const size_t vertices = (size_t)o->numbers.all[OBJ_POSITIONS];
    o->vertex = malloc(vertices * sizeof *o->vertex);
    o->is_coloured = calloc(vertices, sizeof *o->is_coloured);
    if (!o->vertex || !o->is_coloured)
        o->code = message_failure("%s: out of memory for the colours of its vertices", o->f->path);
    walk(o, take_vertex);
    o->numbers.here[OBJ_POSITIONS] = 0;
}

int face_colours_obj(face_colours *f, const whole_file *file)
{
    obj o = {.f = f, .file = file};
    walk(&o, count);
    if (o.has_vertices)
        take_vertices(&o);
    walk(&o, take);
    if (o.missing > 1)
        message_say("warning: %s: in all %" PRIu64 " lines use materials without a colour", f->path, o.missing);
    free(o.vertex);
    free(o.is_coloured);
    materials_free(&o.materials);
    return o.code;
}
