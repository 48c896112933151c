/* scan.c - the items of a file, whatever its format, and the mesh that they make. */
#include "scan.h"

#include <inttypes.h>
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

static void take_vertex(const double position[3], indexed_mesh *m)
{
    const size_t first = 3 * m->positions.count++;
    for (size_t a = 0; a < 3; a++)
        if (m->position_bytes == sizeof(double))
            ((double *)m->positions.of)[first + a] = position[a];
        else
            ((float *)m->positions.of)[first + a] = (float)position[a];
}

/* Room for a face of so many corners; NULL where there is no memory. */
static uint32_t *add_face(size_t size, indexed_mesh *m)
{
    uint32_t *const corners = page_list_add(size, sizeof *corners, &m->corners);
    uint32_t *const own = page_list_add(1, sizeof *own, &m->sizes);
    if (own)
        *own = (uint32_t)size;
    return own ? corners : NULL;
}

static bool take_face(const scan_item *i, indexed_mesh *m)
{
    uint32_t *to = add_face(i->corners, m);
    for (size_t n = 0; to && n < i->count; n++)
        if (i->references[n].which == SCAN_POSITIONS)
            *to++ = (uint32_t)i->references[n].number;
    return to;
}

static bool take_strip(const scan_item *i, indexed_mesh *m)
{
    for (size_t n = 2; n < i->count; n++) {
        const scan_reference *const c = &i->references[n - 2];
        const bool is_whole = c[0].number != SCAN_BREAK && c[1].number != SCAN_BREAK && c[2].number != SCAN_BREAK;
        uint32_t *const to = is_whole ? add_face(3, m) : NULL;
        if (is_whole && !to)
            return false;
        for (size_t v = 0; is_whole && v < 3; v++)
            to[v] = (uint32_t)c[v].number;
    }
    return true;
}

static bool take(const scan_item *i, indexed_mesh *m)
{
    if (i->kind == SCAN_FACE)
        return take_face(i, m);
    if (i->kind == SCAN_STRIP)
        return take_strip(i, m);
    if (i->kind == SCAN_VERTEX && i->which == SCAN_POSITIONS)
        take_vertex(i->position, m);
    for (int v = 0; i->kind == SCAN_FACET && v < 3; v++)
        take_vertex(i->position + 3 * v, m);
    m->left_out += i->kind == SCAN_LINE;
    return true;
}

/* Floats of binary files are not worth the memory of doubles. */
static unsigned position_bytes(const scan *s)
{
    bool is_float = s->kind == MESH_PLY && s->ply.format != PLY_ASCII;
    for (int i = 0; is_float && i < s->ply.property_count; i++)
        is_float = s->ply.properties[i].role > PLY_Z || s->ply.properties[i].type == PLY_FLOAT;
    return is_float ? sizeof(float) : sizeof(double);
}

static int make_room(const char *path, const scan *s, indexed_mesh *m)
{
    const uint64_t vertices = s->all[SCAN_POSITIONS];
    if (vertices > UINT32_MAX)
        return message_failure("%s: %" PRIu64 " vertices, more than 4294967295; split the mesh", path, vertices);
    m->is_soup = s->kind == MESH_STL_TEXT;
    m->position_bytes = position_bytes(s);
    if (!page_list_add((size_t)vertices, 3 * m->position_bytes, &m->positions))
        return message_failure("%s: out of memory for %" PRIu64 " vertices", path, vertices);
    m->positions.count = 0; /* so far */
    return EXIT_CODE_OK;
}

int scan_read(const char *path, mesh_kind kind, const whole_file *file, indexed_mesh *m)
{
    scan s;
    int code = scan_open(path, kind, file, &s);
    if (!code)
        code = make_room(path, &s, m);
    scan_again(&s);
    while (!code && !(code = scan_next(&s)) && s.item.kind != SCAN_END)
        if (!take(&s.item, m))
            code = message_failure("%s: out of memory for more than %zu faces", path, m->sizes.count);
    m->fit = s.fit;
    if (!code && kind == MESH_OBJ && !m->positions.count)
        code = message_failure("%s: not an OBJ file, or an empty one: it has no line with a vertex, 'v X Y Z'", path);
    scan_close(&s);
    return code;
}
