/* colours_ply.c - PLY: red, green and blue of faces, else of vertices. */
#include <math.h>
#include <stdlib.h>

#include "console/message.h"
#include "face_colours.h"
#include "read/ply_values.h"

/* Which properties of an element are its colour. */
typedef struct channels {
    int at[3]; /* -1 for none */
    double most;
    bool are_there;
} channels;

typedef struct ply {
    face_colours *f;
    ply_header header;
    ply_values values;
    bool is_for_vertices; /* which are read before faces */
    rgb *vertices;        /* NULL: they have no colour, or it is not looked at */
    uint64_t vertex_count;
} ply;

/* What was read of a vertex or a face. */
typedef struct record {
    double number[3];
    uint64_t corners;
    rgb_sum of_corners;
} record;

static bool is_channel(const ply_property *p, int c)
{
    static const char *const names[2][3] = {{"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}};
    const words name = {.word = p->name, .length = p->name_length};
    return !p->count && (words_is(&name, names[0][c]) || words_is(&name, names[1][c]));
}

static double most_of(ply_type type)
{
    return type == PLY_FLOAT || type == PLY_DOUBLE ? 1 : type == PLY_UINT16 ? UINT16_MAX : UINT8_MAX;
}

static channels channels_of(const ply_element *e)
{
    channels found = {.at = {-1, -1, -1}, .most = 1};
    for (int i = e->property_count - 1; i >= 0; i--)
        for (int c = 0; c < 3; c++)
            if (is_channel(&e->properties[i], c)) {
                found.at[c] = i;
                found.most = most_of(e->properties[i].type);
            }
    found.are_there = found.at[0] >= 0 && found.at[1] >= 0 && found.at[2] >= 0;
    return found;
}

static int channel_of(const channels *c, int property)
{
    for (int n = 0; n < 3; n++)
        if (c->are_there && c->at[n] == property)
            return n;
    return -1;
}

static void add_corner(const ply *p, double number, rgb_sum *sum)
{
    if (p->vertices && number >= 0 && number < (double)p->vertex_count)
        rgb_add(sum, p->vertices[(uint64_t)number]);
}

/* Each corner makes a triangle with the two before it; -1 ends a strip and begins another. */
static void add_strip_corner(const ply *p, double number, double last[3], record *r)
{
    last[0] = last[1];
    last[1] = last[2];
    last[2] = number;
    rgb_sum sum = {.count = 0};
    for (int n = 0; n < 3; n++)
        add_corner(p, last[n], &sum);
    const rgb mean = rgb_mean(&sum);
    r->corners++;
    if (!p->is_for_vertices && last[0] >= 0 && last[1] >= 0 && number >= 0)
        face_colours_add(p->f, 3, p->vertices ? &mean : NULL);
}

static int read_corners(ply *p, const ply_property *list, record *r)
{
    const bool is_strip = p->values.element->kind == PLY_STRIPS;
    double last[3] = {-1, -1, -1};
    uint64_t count;
    int code = ply_values_take_count(&p->values, list, &count);
    for (uint64_t i = 0; !code && i < count; i++) {
        double number = 0;
        code = ply_values_take(&p->values, list->type, &number);
        if (is_strip)
            add_strip_corner(p, number, last, r);
        else
            add_corner(p, number, &r->of_corners);
    }
    r->corners = is_strip ? 0 : count;
    return code;
}

static int read_record(ply *p, const channels *c, record *r)
{
    const ply_element *const e = p->values.element;
    int code = EXIT_CODE_OK;
    *r = (record){.corners = 0};
    for (int i = 0; !code && i < e->property_count; i++) {
        const ply_property *const property = &e->properties[i];
        const int channel = channel_of(c, i);
        code = property->role == PLY_CORNERS ? read_corners(p, property, r)
               : channel >= 0                ? ply_values_take(&p->values, property->type, &r->number[channel])
                                             : ply_values_skip(&p->values, property);
    }
    return code;
}

static void take_face(ply *p, const channels *c, const record *r)
{
    const rgb own = rgb_of(r->number, c->most), mean = rgb_mean(&r->of_corners);
    p->f->to->from = c->are_there ? "faces" : "vertices";
    face_colours_add(p->f, r->corners, c->are_there ? &own : p->vertices ? &mean : NULL);
}

static int read_element(ply *p, const ply_element *e)
{
    const channels c = channels_of(e);
    record r;
    int code = ply_values_begin(&p->values, e);
    if (!code && p->is_for_vertices && e->kind == PLY_VERTICES && c.are_there) {
        p->vertex_count = e->count;
        p->vertices = malloc((size_t)(e->count + 1) * sizeof *p->vertices);
        if (!p->vertices)
            return message_failure("%s: out of memory for the colours of its vertices", p->f->path);
    }
    for (uint64_t n = 0; !code && !p->f->is_changed && n < e->count; n++) {
        p->values.number = n;
        code = read_record(p, &c, &r);
        if (!code && p->is_for_vertices && e->kind == PLY_VERTICES && p->vertices)
            p->vertices[n] = rgb_of(r.number, c.most);
        if (!code && !p->is_for_vertices && e->kind == PLY_FACES)
            take_face(p, &c, &r);
    }
    return code;
}

static int read_elements(ply *p, const whole_file *file, bool is_for_vertices)
{
    int code = EXIT_CODE_OK;
    p->is_for_vertices = is_for_vertices;
    p->values = ply_values_of(p->f->path, file, &p->header);
    for (int e = 0; !code && e < p->header.element_count; e++)
        code = read_element(p, &p->header.elements[e]);
    return code;
}

/* Vertices come first, wherever they are in the file, and are passed over where faces have colours. */
int face_colours_ply(face_colours *f, const whole_file *file)
{
    ply p = {.f = f};
    bool has_own = false;
    int code = ply_header_read(f->path, file, &p.header);
    if (code)
        return code;
    for (int e = 0; e < p.header.element_count; e++)
        has_own |= p.header.elements[e].kind == PLY_FACES && channels_of(&p.header.elements[e]).are_there;
    code = has_own ? EXIT_CODE_OK : read_elements(&p, file, true);
    if (!code)
        code = read_elements(&p, file, false);
    free(p.vertices);
    return code;
}
