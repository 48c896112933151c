/* scan.c - the items of a file, whatever its format, and the mesh that they make. */
#include "scan.h"

#include <stdlib.h>

#include "console/system.h"
#include "console/message.h"

#define FORMAT(kind, name, word, ending, comment) {scan_open_##name, scan_next_##name, comment},
static const struct {
    int (*open)(scan *s, const whole_file *file);
    int (*next)(scan *s);
    char comment;
} formats[] = {MESH_KINDS(FORMAT)};

int scan_open(const char *path, mesh_kind kind, const whole_file *file, scan *s)
{
    s->kind = kind;
    s->words = words_of(path, file, formats[kind].comment);
    s->has_colours = s->has_coloured_vertices = false;
    s->item = (scan_item){.references = NULL};
    s->fit = FLOAT_FIT_EXACT;
    for (int k = 0; k < SCAN_NUMBERED; k++)
        s->all[k] = 0;
    scan_again(s);
    return formats[kind].open(s, file);
}

void scan_close(scan *s) { free(s->item.references); }

void scan_again(scan *s)
{
    s->words.at = s->from = s->words.text;
    s->is_inside = false;
    s->element = 0;
    s->number = 0;
    for (int k = 0; k < SCAN_NUMBERED; k++)
        s->here[k] = 0;
}

int scan_next(scan *s)
{
    scan_item *const i = &s->item;
    i->has_colour = false;
    i->corners = i->count = 0;
    i->run = 1;
    i->gap = i->begin = s->from;
    i->after = "";
    const int code = formats[s->kind].next(s);
    s->from = i->end;
    return code;
}

int scan_refer(scan *s, scan_reference reference)
{
    scan_item *const i = &s->item;
    scan_reference *const references =
        i->count < i->room ? i->references : memory_grow(i->references, i->count + 1, &i->room, sizeof reference);
    if (!references)
        return SCAN_REFUSE(s, "%s: out of memory for the corners of a face", s->words.path);
    i->references = references;
    i->references[i->count++] = reference;
    i->corners += reference.which == SCAN_POSITIONS;
    return EXIT_CODE_OK;
}

/* Faces may refer to vertices that come after them: then vertices are read first, and faces once more. */
typedef struct reading {
    const char *path;
    const scan *s;
    indexed_mesh *m;
    bool has_vertices;   /* all of them are read, so that only faces are wanted */
    bool is_before_them; /* a face has referred to a vertex after it, so that only vertices are wanted */
} reading;

static void take_vertex(const reading *r)
{
    if (!r->has_vertices && r->s->item.which == SCAN_POSITIONS)
        indexed_mesh_add_vertex(r->s->item.position, r->m);
}

static int take_facet(const reading *r)
{
    const uint32_t first = (uint32_t)r->m->vertices;
    for (int v = 0; v < 3; v++)
        indexed_mesh_add_vertex(r->s->item.position + 3 * v, r->m);
    return indexed_mesh_add_triangle(r->path, first, first + 1, first + 2, r->m);
}

static int add_strips(const reading *r)
{
    const scan_reference *c = r->s->item.references;
    int code = EXIT_CODE_OK;
    for (size_t i = 2; !code && i < r->s->item.count; i++, c++)
        if (c[0].number != SCAN_BREAK && c[1].number != SCAN_BREAK && c[2].number != SCAN_BREAK)
            code = indexed_mesh_add_triangle(r->path, (uint32_t)c[0].number, (uint32_t)c[1].number, (uint32_t)c[2].number, r->m);
    return code;
}

static int take_face(reading *r)
{
    const scan_item *const i = &r->s->item;
    size_t corners = 0;
    const int code = indexed_mesh_reserve_face(r->path, i->corners, r->m);
    for (size_t n = 0; !code && n < i->count; n++) {
        const scan_reference *const c = &i->references[n];
        r->is_before_them |= c->which == SCAN_POSITIONS && c->number >= r->m->vertices && c->number != SCAN_BREAK;
        if (c->which == SCAN_POSITIONS)
            r->m->face[corners++] = (uint32_t)c->number;
    }
    if (code || r->is_before_them)
        return code;
    return i->kind == SCAN_STRIP ? add_strips(r) : indexed_mesh_add_face(r->path, corners, r->m);
}

static int take(reading *r)
{
    const scan_kind kind = r->s->item.kind;
    if (kind == SCAN_VERTEX)
        take_vertex(r);
    else if (kind == SCAN_FACET)
        return take_facet(r);
    else if (!r->is_before_them && (kind == SCAN_FACE || kind == SCAN_STRIP))
        return take_face(r);
    r->m->left_out += kind == SCAN_LINE;
    return EXIT_CODE_OK;
}

/* Floats of binary files are not worth the memory of doubles. */
static unsigned position_bytes(const scan *s)
{
    bool is_float = s->kind == MESH_PLY && s->ply.format != PLY_ASCII;
    for (int i = 0; is_float && i < s->ply.property_count; i++)
        is_float = s->ply.properties[i].role > PLY_Z || s->ply.properties[i].type == PLY_FLOAT;
    return is_float ? sizeof(float) : sizeof(double);
}

int scan_read(const char *path, mesh_kind kind, const whole_file *file, indexed_mesh *m)
{
    scan s;
    reading r = {.path = path, .s = &s, .m = m};
    int code = scan_open(path, kind, file, &s);
    if (!code)
        code = indexed_mesh_reserve(path, s.all[SCAN_POSITIONS], position_bytes(&s), m);
    do {
        r.has_vertices = r.is_before_them;
        r.is_before_them = false;
        m->triangles = m->left_out = m->miscut = 0;
        scan_again(&s);
        while (!code && !(code = scan_next(&s)) && s.item.kind != SCAN_END)
            code = take(&r);
    } while (!code && r.is_before_them);
    m->fit = s.fit;
    if (!code && kind == MESH_OBJ && !m->vertices)
        code = message_failure("%s: not an OBJ file, or an empty one: it has no line with a vertex, 'v X Y Z'", path);
    scan_close(&s);
    return code;
}
