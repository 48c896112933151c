/* ply_header.c - reads the header of a PLY file, and refuses what it does not understand. */
#include "scan.h"

#include <inttypes.h>
#include <stdbool.h>
#include <string.h>

#include "console/message.h"

/* Silent without a path. */
#define REFUSE(...) (path ? message_failure(__VA_ARGS__) : EXIT_CODE_FAILURE)

enum { LINE_SHOWN = 60 };

size_t ply_type_size(ply_type type)
{
    static const size_t sizes[] = {[PLY_NONE] = 0,  [PLY_INT8] = 1,   [PLY_UINT8] = 1, [PLY_INT16] = 2, [PLY_UINT16] = 2,
                                   [PLY_INT32] = 4, [PLY_UINT32] = 4, [PLY_FLOAT] = 4, [PLY_DOUBLE] = 8};
    return sizes[type];
}

/* Which of these names the last word is; `count` if it is none of them. */
static int find(const words *w, const char *const names[], int count)
{
    int i = 0;
    while (i < count && !words_is(w, names[i]))
        i++;
    return i;
}

static bool read_format(words *w, ply_header *h)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const int format = words_next_on_line(w) ? find(w, names, 3) : 3;
    h->format = (ply_format)format;
    return format < 3;
}

/* Each type has two names, in the order of the types. */
static bool read_type(words *w, ply_type *type)
{
    static const char *const names[] = {"char", "int8",  "uchar", "uint8",  "short", "int16",   "ushort", "uint16",
                                        "int",  "int32", "uint",  "uint32", "float", "float32", "double", "float64"};
    const int n = find(w, names, 16);
    *type = n < 16 ? (ply_type)(PLY_INT8 + n / 2) : PLY_NONE;
    return n < 16;
}

static int count_role(const ply_element *e, ply_role role)
{
    int count = 0;
    for (int i = 0; i < e->property_count; i++)
        count += e->properties[i].role == role;
    return count;
}

/* Of the colours the first of each name. */
static ply_role role_of(const words *name, const ply_element *e, bool is_list)
{
    static const char *const names[] = {"x", "y", "z", "red", "green", "blue", "diffuse_red", "diffuse_green", "diffuse_blue"};
    static const ply_role roles[] = {PLY_X, PLY_Y, PLY_Z, PLY_RED, PLY_GREEN, PLY_BLUE, PLY_RED, PLY_GREEN, PLY_BLUE, PLY_SKIPPED};
    if (is_list) {
        const bool is_corners = words_is(name, "vertex_indices") || words_is(name, "vertex_index");
        return (e->kind == PLY_FACES || e->kind == PLY_STRIPS) && is_corners ? PLY_CORNERS : PLY_SKIPPED;
    }
    const ply_role role = roles[find(name, names, 9)];
    const bool is_known = role <= PLY_Z ? e->kind == PLY_VERTICES : e->kind <= PLY_FACES && !count_role(e, role);
    return is_known ? role : PLY_SKIPPED;
}

/* property TYPE NAME, or property list COUNT_TYPE TYPE NAME */
static bool read_property(words *w, ply_header *h)
{
    if (!h->element_count || h->property_count == PLY_PROPERTIES_MAX || !words_next_on_line(w))
        return false;
    ply_element *const e = &h->elements[h->element_count - 1];
    ply_property *const p = &h->properties[h->property_count];
    const bool is_list = words_is(w, "list");
    *p = (ply_property){.count = PLY_NONE};
    if (is_list && (!words_next_on_line(w) || !read_type(w, &p->count) || p->count >= PLY_FLOAT || !words_next_on_line(w)))
        return false;
    if (!read_type(w, &p->type) || !words_next_on_line(w))
        return false;
    p->role = role_of(w, e, is_list);
    p->name = w->word;
    p->name_length = w->length;
    h->property_count++;
    e->property_count++;
    e->has_colour = count_role(e, PLY_RED) && count_role(e, PLY_GREEN) && count_role(e, PLY_BLUE);
    return true;
}

/* element NAME COUNT */
static bool read_element(words *w, ply_header *h)
{
    static const char *const kinds[] = {"vertex", "face", "tristrips"};
    if (h->element_count == PLY_ELEMENTS_MAX || !words_next_on_line(w))
        return false;
    ply_element *const e = &h->elements[h->element_count++];
    *e = (ply_element){.name = w->word,
                       .name_length = words_shown(w),
                       .kind = (ply_kind)find(w, kinds, 3),
                       .properties = h->properties + h->property_count};
    return words_next_on_line(w) && words_whole(w, &e->count);
}

/* Reads what follows the first word of a line. */
static bool read_line(words *w, ply_header *h)
{
    if (words_is(w, "format"))
        return read_format(w, h);
    if (words_is(w, "element"))
        return read_element(w, h);
    if (words_is(w, "property"))
        return read_property(w, h);
    return words_is(w, "comment") || words_is(w, "obj_info");
}

/* What the element lacks; NULL if it has all that is needed. */
static const char *lacking(const ply_element *e)
{
    if (!e->property_count)
        return "without a property";
    if (e->kind == PLY_VERTICES && (count_role(e, PLY_X) != 1 || count_role(e, PLY_Y) != 1 || count_role(e, PLY_Z) != 1))
        return "without one x, one y and one z each";
    if ((e->kind == PLY_FACES || e->kind == PLY_STRIPS) && count_role(e, PLY_CORNERS) != 1)
        return "without one list vertex_indices each";
    return NULL;
}

static int check_elements(const char *path, const ply_header *h)
{
    int seen[PLY_OTHER + 1] = {0};
    for (int i = 0; i < h->element_count; i++) {
        const ply_element *e = &h->elements[i];
        if (e->kind != PLY_OTHER && seen[e->kind]++)
            return REFUSE("%s: not a sound PLY file: its header has '%.*s' twice", path, e->name_length, e->name);
        if (e->count && lacking(e))
            return REFUSE("%s: not a sound PLY file: the header promises %" PRIu64 " of '%.*s' %s", path, e->count, e->name_length,
                          e->name, lacking(e));
    }
    return EXIT_CODE_OK;
}

static int refuse_line(const char *path, const char *line)
{
    const size_t length = path ? strcspn(line, "\r\n") : 0;
    return REFUSE("%s: not a sound PLY file: '%.*s' in its header is not understood", path,
                  length < LINE_SHOWN ? (int)length : LINE_SHOWN, line);
}

int ply_header_read(const char *path, const whole_file *file, ply_header *h)
{
    words w = words_of(path, file, ' ');
    bool has_format = false;
    h->element_count = h->property_count = 0;
    if (!words_next(&w) || w.word != file->bytes || !words_is(&w, "ply"))
        return REFUSE("%s: not a PLY file: it does not begin with 'ply'", path);
    while (words_next(&w) && !words_is(&w, "end_header")) {
        const char *const line = w.word;
        has_format |= words_is(&w, "format");
        const bool is_sound = read_line(&w, h);
        words_skip_line(&w);
        if (w.at == w.end)
            break;
        if (!is_sound)
            return refuse_line(path, line);
    }
    if (!words_is(&w, "end_header"))
        return REFUSE("%s: truncated: the PLY header does not end; write it again", path);
    if (!has_format)
        return REFUSE("%s: not a sound PLY file: its header does not say which format it has", path);
    /* One line end follows. Where lines end in CR alone, the first value may begin with the byte of LF. */
    const size_t line_end = file->bytes[3] == '\r' && file->bytes[4] == '\n' ? 2 : 1;
    const size_t left = (size_t)(w.end - w.at);
    h->size = (size_t)(w.at - w.text) + (left < line_end ? left : line_end);
    return check_elements(path, h);
}

double ply_number(uint64_t bits, ply_type type)
{
    const uint32_t low = (uint32_t)bits;
    float narrow;
    double wide;
    memcpy(&narrow, &low, sizeof narrow);
    memcpy(&wide, &bits, sizeof wide);
    return type == PLY_INT8     ? (int8_t)bits
           : type == PLY_INT16  ? (int16_t)bits
           : type == PLY_INT32  ? (int32_t)bits
           : type == PLY_FLOAT  ? (double)narrow
           : type == PLY_DOUBLE ? wide
                                : (double)bits;
}

bool ply_layout_of(const ply_header *h, uint64_t size, ply_layout *l)
{
    const ply_element *const vertices = &h->elements[0], *const faces = &h->elements[1];
    *l = (ply_layout){.is_big = h->format == PLY_BIG_ENDIAN, .vertices_at = h->size};
    bool is_sound = h->element_count >= 2 && vertices->kind == PLY_VERTICES && vertices->count && vertices->count <= UINT32_MAX &&
                    faces->kind == PLY_FACES && faces->count;
    for (int i = 0; is_sound && i < vertices->property_count; i++) {
        const ply_property *const p = &vertices->properties[i];
        is_sound = !p->count && (p->role > PLY_Z || !l->number || l->number == p->type);
        if (p->role <= PLY_Z) {
            l->number = p->type;
            l->axes[p->role] = l->vertex;
        }
        l->vertex += ply_type_size(p->type);
    }
    for (int i = 0; is_sound && i < faces->property_count; i++) {
        const ply_property *const p = &faces->properties[i];
        is_sound = !p->count || p->role == PLY_CORNERS;
        if (p->role == PLY_CORNERS) {
            l->count = p->count;
            l->corner = p->type;
        } else {
            *(l->count ? &l->after : &l->before) += ply_type_size(p->type);
        }
    }
    l->vertices = vertices->count;
    l->faces = faces->count;
    l->number_bytes = ply_type_size(l->number);
    l->count_bytes = ply_type_size(l->count);
    l->corner_bytes = ply_type_size(l->corner);
    if (!is_sound || l->vertices > (size - l->vertices_at) / l->vertex)
        return false;
    l->faces_at = l->vertices_at + l->vertices * l->vertex;
    return l->faces <= (size - l->faces_at) / (l->before + l->count_bytes + l->after);
}
