/* scan_text.c - OFF: a line for each vertex and each face, with all that follows on it; and STL as text: solids of facets. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "console/message.h"
#include "scan.h"

/* "0 0 0" and "0", each with the end of its line: no vertex or face is shorter. */
enum { VERTEX_BYTES_MIN = 6, FACE_BYTES_MIN = 2 };

/* "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop endfacet ": no facet is shorter. */
enum { FACET_BYTES_MIN = 86 };

/* Words such as OFF, COFF, STCNOFF; the first count may follow at once, as in OFF8. */
static int take_keyword(scan *s)
{
    words *const w = &s->words;
    if (!words_next(w))
        return words_refuse(w, "'OFF'");
    const size_t prefix = strspn(w->word, "STCN");
    if (!strncmp(w->word + strspn(w->word, "STCN4n"), "OFF", 3) && strncmp(w->word + prefix, "OFF", 3))
        return SCAN_REFUSE(s, "%s: has vertices of other than three coordinates; save it with three", w->path);
    if (strncmp(w->word + prefix, "OFF", 3))
        return SCAN_REFUSE(s, "%s: not an OFF file: it does not begin with 'OFF'", w->path);
    s->has_coloured_vertices = memchr(w->word, 'C', prefix);
    s->has_normals = memchr(w->word, 'N', prefix);
    w->at = w->word + prefix + 3;
    return EXIT_CODE_OK;
}

/* The edges are those of all faces. They may be left away. */
static int take_counts(scan *s)
{
    uint64_t *const numbers[] = {&s->all[SCAN_POSITIONS], &s->faces};
    words *const w = &s->words;
    int code = take_keyword(s);
    for (int n = 0; !code && n < 3; n++) {
        const bool is_there = n < 2 ? words_next(w) : words_next_on_line(w);
        if (!n && words_is(w, "BINARY"))
            return SCAN_REFUSE(s, "%s: is binary, and only OFF as text is read; save it as text", w->path);
        if (n < 2 && (!is_there || !words_whole(w, numbers[n])))
            return SCAN_REFUSE(s, "%s: truncated, or not text: no counts of vertices and faces after 'OFF'; write it again as text",
                               w->path);
        if (is_there)
            code = scan_refer(s, (scan_reference){.at = w->word, .length = w->length, .which = SCAN_VERTICES + n});
    }
    words_skip_line(w);
    s->item.kind = SCAN_COUNT;
    s->is_inside = true;
    return code;
}

int scan_open_off(scan *s, const whole_file *file)
{
    (void)file;
    const words *const w = &s->words;
    const int code = take_counts(s);
    if (code)
        return code;
    const uint64_t bytes = (uint64_t)(w->end - w->at) + 1; /* the last line may lack its end */
    if (s->all[SCAN_POSITIONS] > bytes / VERTEX_BYTES_MIN || s->faces > bytes / FACE_BYTES_MIN)
        return SCAN_REFUSE(s,
                           "%s: truncated: %" PRIu64 " vertices and %" PRIu64
                           " faces promised, more than the file has bytes for; write it again",
                           w->path, s->all[SCAN_POSITIONS], s->faces);
    return EXIT_CODE_OK;
}

/* Three numbers of what is left of a line: whole ones go to 255, others, which have a point, to 1. */
static void take_colour(scan *s)
{
    scan_item *const i = &s->item;
    i->most = 255;
    i->has_colour = s->has_colours;
    for (int c = 0; i->has_colour && c < 3; c++) {
        i->has_colour = words_next_on_line(&s->words) && words_number(&s->words, &i->colour[c], &(float_fit){FLOAT_FIT_EXACT});
        if (strspn(s->words.word, "0123456789") < s->words.length)
            i->most = 1;
    }
}

static int take_vertex(scan *s)
{
    words *const w = &s->words;
    for (int a = 0; a < 3; a++)
        if (!(a ? words_next_on_line(w) : words_next(w)) || !words_number(w, &s->item.position[a], &s->fit))
            return words_refuse(w, "a coordinate of a vertex");
        else if (!a)
            s->item.begin = words_line_begin(w, s->from);
    for (int n = 0; s->has_normals && n < 3; n++)
        words_next_on_line(w);
    if (s->has_coloured_vertices)
        take_colour(s);
    s->item.kind = SCAN_VERTEX;
    s->item.which = SCAN_POSITIONS;
    s->here[SCAN_POSITIONS]++;
    return EXIT_CODE_OK;
}

static int take_face(scan *s)
{
    words *const w = &s->words;
    uint64_t corners;
    int code = EXIT_CODE_OK;
    if (!words_next(w) || !words_whole(w, &corners))
        return words_refuse(w, "the number of vertices of a face");
    s->item.begin = words_line_begin(w, s->from);
    if (corners > (uint64_t)(w->end - w->at) / 2)
        return SCAN_REFUSE(s, "%s: truncated: face %" PRIu64 " has fewer than its %" PRIu64 " vertices; write it again", w->path,
                           s->number, corners);
    for (; !code && corners; corners--) {
        scan_reference corner = {.which = SCAN_POSITIONS};
        if (!words_next_on_line(w) || !words_whole(w, &corner.number))
            return words_refuse(w, "the number of a vertex");
        if (corner.number >= s->all[SCAN_POSITIONS])
            return SCAN_REFUSE(s, "%s: damaged: face %" PRIu64 " refers to vertex %.*s, the file has %" PRIu64 ", counted from 0",
                               w->path, s->number, words_shown(w), w->word, s->all[SCAN_POSITIONS]);
        corner.at = w->word;
        corner.length = w->length;
        code = scan_refer(s, corner);
    }
    take_colour(s);
    s->item.kind = SCAN_FACE;
    s->number++;
    return code;
}

int scan_next_off(scan *s)
{
    int code = EXIT_CODE_OK;
    if (!s->is_inside) {
        code = take_counts(s);
    } else if (s->here[SCAN_POSITIONS] < s->all[SCAN_POSITIONS]) {
        code = take_vertex(s);
    } else if (s->number < s->faces) {
        code = take_face(s);
    } else {
        s->item.kind = SCAN_END;
        s->item.begin = s->item.end = s->words.end;
        return code;
    }
    words_skip_line(&s->words);
    s->item.end = words_line_next(&s->words);
    return code;
}

/* What follows the word "facet"; NULL: a number, of which the first three are the normal's. */
static const char *const facet[] = {"normal", NULL, NULL, NULL, "outer",  "loop", "vertex", NULL, NULL,      NULL,
                                    "vertex", NULL, NULL, NULL, "vertex", NULL,   NULL,     NULL, "endloop", "endfacet"};

static int take_facet(scan *s)
{
    words *const w = &s->words;
    double *number = s->item.position;
    for (size_t n = 0; n < sizeof facet / sizeof facet[0]; n++) {
        const char *const due = facet[n];
        char quoted[16];
        if (words_next(w) && (due ? words_is(w, due) : n < 4 || words_number(w, number++, &s->fit)))
            continue;
        snprintf(quoted, sizeof quoted, "'%s'", due ? due : "");
        return words_refuse(w, due ? quoted : n < 4 ? "a coordinate of a normal" : "a coordinate of a vertex");
    }
    s->item.kind = SCAN_FACET;
    s->item.corners = 3;
    return EXIT_CODE_OK;
}

/* Each facet has the space before it. */
int scan_next_stl(scan *s)
{
    words *const w = &s->words;
    int code = EXIT_CODE_OK;
    const bool is_there = words_next(w);
    s->item.kind = SCAN_OTHER;
    if (s->is_inside && is_there && words_is(w, "facet")) {
        code = take_facet(s);
    } else if (s->is_inside && (!is_there || !words_is(w, "endsolid"))) {
        code = words_refuse(w, "'facet' or 'endsolid'");
    } else if (!is_there) {
        s->item.kind = SCAN_END;
        w->at = w->end;
    } else if (!s->is_inside && !words_is(w, "solid")) {
        code = words_refuse(w, "'solid'");
    } else {
        words_skip_line(w); /* the name */
        s->is_inside = !s->is_inside;
    }
    s->item.end = w->at;
    return code;
}

int scan_open_stl(scan *s, const whole_file *file)
{
    words w = s->words;
    if (!words_next(&w) || !words_is(&w, "solid") || memchr(file->bytes, '\0', file->size))
        return SCAN_REFUSE(s,
                           "%s: truncated, or not an STL file: its size is not the one that its header promises, nor is it text "
                           "from 'solid' to 'endsolid'; write it again",
                           w.path);
    s->all[SCAN_POSITIONS] = 3 * ((uint64_t)file->size / FACET_BYTES_MIN + 1);
    return EXIT_CODE_OK;
}
