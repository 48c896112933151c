/* read_ply.c - reads PLY files: their vertices, faces and strips of triangles. What else they have is skipped. */
#include <inttypes.h>

#include "console/message.h"
#include "ply_values.h"
#include "readers.h"

/* Between two strips; no file has as many vertices. */
static const uint32_t strip_end = UINT32_MAX;

typedef int read_instance(ply_values *v, indexed_mesh *m);

static int read_vertex(ply_values *v, indexed_mesh *m)
{
    double position[3] = {0, 0, 0};
    int code = EXIT_CODE_OK;
    for (int i = 0; !code && i < v->element->property_count; i++) {
        const ply_property *p = &v->element->properties[i];
        code = p->role <= PLY_Z ? ply_values_take_coordinate(v, p->type, &position[p->role], &m->fit) : ply_values_skip(v, p);
    }
    if (!code)
        indexed_mesh_add_vertex(position, m);
    return code;
}

static int read_floats(ply_values *v, indexed_mesh *m)
{
    float position[3] = {0, 0, 0};
    int code = EXIT_CODE_OK;
    for (int i = 0; !code && i < v->element->property_count; i++) {
        const ply_property *p = &v->element->properties[i];
        code = p->role <= PLY_Z ? ply_values_take_float(v, &position[p->role]) : ply_values_skip(v, p);
    }
    if (!code)
        indexed_mesh_add_floats(position, m);
    return code;
}

static int read_corner(ply_values *v, ply_type type, const indexed_mesh *m, uint32_t *corner)
{
    double index = 0;
    const int code = ply_values_take(v, type, &index);
    if (code)
        return code;
    const bool is_strip = v->element->kind == PLY_STRIPS, is_end = is_strip && index == -1;
    if (is_end || (index >= 0 && index < (double)m->vertices && index == (double)(uint32_t)index)) {
        *corner = is_end ? strip_end : (uint32_t)index;
        return EXIT_CODE_OK;
    }
    return message_failure("%s: damaged: %s %" PRIu64 " refers to vertex %.15g, the mesh has %zu, counted from 0", v->path,
                           is_strip ? "strip" : "face", v->number, index, m->vertices);
}

/* Reads the corners into m->face. */
static int read_corners(ply_values *v, const ply_property *list, indexed_mesh *m, uint64_t *count)
{
    int code = ply_values_take_count(v, list, count);
    if (!code)
        code = indexed_mesh_reserve_face(v->path, *count, m);
    for (uint64_t i = 0; !code && i < *count; i++)
        code = read_corner(v, list->type, m, &m->face[i]);
    return code;
}

/* Every corner makes a triangle with the two before it; -1 ends a strip and begins another. */
static int add_strips(const char *path, uint64_t corners, indexed_mesh *m)
{
    int code = EXIT_CODE_OK;
    for (uint64_t i = 2; !code && i < corners; i++) {
        const uint32_t *c = m->face + i - 2;
        if (c[0] != strip_end && c[1] != strip_end && c[2] != strip_end)
            code = indexed_mesh_add_triangle(path, c[0], c[1], c[2], m);
    }
    return code;
}

static int read_face(ply_values *v, indexed_mesh *m)
{
    uint64_t corners = 0;
    int code = EXIT_CODE_OK;
    for (int i = 0; !code && i < v->element->property_count; i++) {
        const ply_property *p = &v->element->properties[i];
        code = p->role == PLY_CORNERS ? read_corners(v, p, m, &corners) : ply_values_skip(v, p);
    }
    if (code)
        return code;
    return v->element->kind == PLY_STRIPS ? add_strips(v->path, corners, m) : indexed_mesh_add_face(v->path, (size_t)corners, m);
}

static int skip_instance(ply_values *v, indexed_mesh *m)
{
    int code = EXIT_CODE_OK;
    (void)m;
    for (int i = 0; !code && i < v->element->property_count; i++)
        code = ply_values_skip(v, &v->element->properties[i]);
    return code;
}

static int read_element(ply_values *v, const ply_element *e, read_instance *read, indexed_mesh *m)
{
    int code = ply_values_begin(v, e);
    if (!code && (read == read_vertex || read == read_floats))
        code = indexed_mesh_reserve(v->path, e->count, read == read_floats ? sizeof(float) : sizeof(double), m);
    for (; !code && v->number < e->count; v->number++)
        code = read(v, m);
    return code;
}

/* Floats of binary files are not worth the memory of doubles. */
static read_instance *vertex_reader(const ply_values *v, const ply_element *e)
{
    bool is_float = v->format != PLY_ASCII;
    for (int i = 0; i < e->property_count; i++)
        is_float &= e->properties[i].role > PLY_Z || e->properties[i].type == PLY_FLOAT;
    return is_float ? read_floats : read_vertex;
}

static bool has_faces(const ply_element *e) { return e->kind == PLY_FACES || e->kind == PLY_STRIPS; }

/* The vertices are read first, wherever they are in the file. */
static int read_elements(const char *path, const whole_file *file, const ply_header *h, indexed_mesh *m)
{
    const ply_element *const end = h->elements + h->element_count, *vertices = h->elements, *e;
    ply_values v = ply_values_of(path, file, h);
    int code = EXIT_CODE_OK;
    bool is_face_first = false;
    while (vertices < end && vertices->kind != PLY_VERTICES)
        is_face_first |= has_faces(vertices++);
    for (e = h->elements; !code && e < end && e <= vertices; e++)
        code = read_element(&v, e, e == vertices ? vertex_reader(&v, e) : skip_instance, m);
    if (is_face_first) {
        v = ply_values_of(path, file, h);
        e = h->elements;
    }
    for (; !code && e < end; e++)
        code = read_element(&v, e, has_faces(e) ? read_face : skip_instance, m);
    return code;
}

int read_ply(const char *path, const whole_file *file, indexed_mesh *m)
{
    ply_header header;
    const int code = ply_header_read(path, file, &header);
    return code ? code : read_elements(path, file, &header, m);
}
