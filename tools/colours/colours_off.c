/* colours_off.c - OFF: colours after the corners of a face, else those of the vertices of COFF. */
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "face_colours.h"
#include "read/words.h"

typedef struct off {
    face_colours *f;
    words words;
    bool has_colours, has_normals; /* of vertices: COFF, NOFF */
    uint64_t vertices, faces;
    rgb *vertex; /* NULL without colours */
} off;

/* The reader has read all of this before. */
static bool read_head(off *o)
{
    words *const w = &o->words;
    if (!words_next(w))
        return false;
    const size_t prefix = strspn(w->word, "STCN");
    o->has_colours = memchr(w->word, 'C', prefix);
    o->has_normals = memchr(w->word, 'N', prefix);
    if (strncmp(w->word + prefix, "OFF", 3))
        return false;
    w->at = w->word + prefix + 3;
    const bool is_sound = words_next(w) && words_whole(w, &o->vertices) && words_next(w) && words_whole(w, &o->faces);
    words_skip_line(w);
    return is_sound && o->vertices <= (uint64_t)(w->end - w->text) && o->faces <= (uint64_t)(w->end - w->text);
}

/* Three numbers of what is left of a line: whole ones go to 255, others, which have a point, to 1. */
static bool read_colour(words *w, rgb *colour)
{
    double number[3];
    bool is_whole = true;
    for (int c = 0; c < 3; c++) {
        if (!words_next_on_line(w) || !words_number(w, &number[c], &(float_fit){FLOAT_FIT_EXACT}))
            return false;
        is_whole &= strspn(w->word, "0123456789") >= w->length;
    }
    *colour = rgb_of(number, is_whole ? 255 : 1);
    return true;
}

static bool read_vertex(off *o, uint64_t number)
{
    words *const w = &o->words;
    const int before = o->has_normals ? 6 : 3;
    bool is_sound = words_next(w);
    for (int n = 1; is_sound && n < before; n++)
        is_sound = words_next_on_line(w);
    if (is_sound && o->vertex && !read_colour(w, &o->vertex[number]))
        o->vertex[number] = RGB_GREY;
    words_skip_line(w);
    return is_sound;
}

static bool read_face(off *o)
{
    words *const w = &o->words;
    uint64_t corners, corner;
    rgb_sum sum = {.count = 0};
    rgb own;
    if (!words_next(w) || !words_whole(w, &corners))
        return false;
    for (uint64_t i = 0; i < corners; i++) {
        if (!words_next_on_line(w) || !words_whole(w, &corner) || corner >= o->vertices)
            return false;
        if (o->vertex)
            rgb_add(&sum, o->vertex[corner]);
    }
    const bool has_own = read_colour(w, &own);
    const rgb colour = has_own ? own : rgb_mean(&sum);
    o->f->to->from = has_own ? "faces" : "vertices";
    words_skip_line(w);
    face_colours_add(o->f, corners, has_own || o->vertex ? &colour : NULL);
    return !o->f->is_changed;
}

int face_colours_off(face_colours *f, const whole_file *file)
{
    off o = {.f = f, .words = words_of(f->path, file, '#')};
    bool is_sound = read_head(&o);
    if (is_sound && o.has_colours) {
        o.vertex = malloc((size_t)(o.vertices + 1) * sizeof *o.vertex);
        if (!o.vertex)
            return message_failure("%s: out of memory for the colours of its vertices", f->path);
    }
    for (uint64_t v = 0; is_sound && v < o.vertices; v++)
        is_sound = read_vertex(&o, v);
    for (uint64_t n = 0; is_sound && n < o.faces; n++)
        is_sound = read_face(&o);
    f->is_changed |= !is_sound;
    free(o.vertex);
    return EXIT_CODE_OK;
}
