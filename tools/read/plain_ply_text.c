/*
 * plain_ply_text.c - PLY files as text: a line for each vertex, then a line for each face that begins with the list of its corners.
 */
#include "text.h"

static const char *skip_word(const char *c)
{
    const char *const first = c;
    while ((unsigned char)*c > ' ')
        c++;
    return c > first && text_ends_word(*c) ? c : NULL;
}

static const char *take_coordinate(const char *c, const ply_property *property, text_part *part)
{
    double *const number = part->positions + 3 * part->vertices + property->role;
    float_fit own = part->fit;
    c = written_number_scan(c, number, property->type == PLY_DOUBLE ? &own : &part->fit);
    if (property->type == PLY_DOUBLE && c && float_fit_of(*number) > part->fit)
        part->fit = FLOAT_FIT_NONE;
    return c && text_ends_word(*c) ? c : NULL;
}

static const char *read_vertex(const char *c, const text *t, text_part *part)
{
    const ply_element *const e = t->of_vertices;
    for (int i = 0; c && i < e->property_count; i++) {
        c = text_skip_blanks(c);
        c = e->properties[i].role <= PLY_Z ? take_coordinate(c, &e->properties[i], part) : skip_word(c);
    }
    part->vertices++;
    return c ? text_end_line(c) : NULL;
}

static const char *take_whole(const char *c, uint64_t most, uint32_t *number)
{
    uint64_t found = 0;
    const char *const first = text_skip_blanks(c), *const end = digits_scan(first, &found);
    *number = (uint32_t)found;
    return end > first && end <= first + 10 && found <= most && text_ends_word(*end) ? end : NULL;
}

static const char *read_face(const char *c, const text *t, text_part *part)
{
    uint32_t size;
    c = take_whole(c, UINT32_MAX, &size);
    for (uint32_t i = 0; c && i < size; i++) {
        uint32_t *const corner = &part->corners[part->corner_count++];
        c = take_whole(c, t->of_vertices->count - 1, corner);
    }
    text_add_face(size, part);
    for (int i = 1; c && i < t->of_faces->property_count; i++)
        c = skip_word(text_skip_blanks(c));
    return c ? text_end_line(c) : NULL;
}

static bool read_lines(const text *t, text_part *part)
{
    const uint64_t vertices = t->of_vertices->count, all = vertices + t->of_faces->count;
    const char *c = part->begin;
    uint64_t line = part->first_line;
    for (; c && c < part->limit && line < vertices; line++)
        c = read_vertex(c, t, part);
    for (; c && c < part->limit && line < all; line++)
        c = read_face(c, t, part);
    return c;
}

static bool are_plain(const ply_element *vertices, const ply_element *faces)
{
    for (int i = 0; i < vertices->property_count; i++)
        if (vertices->properties[i].count)
            return false;
    for (int i = 0; i < faces->property_count; i++)
        if ((faces->properties[i].role == PLY_CORNERS) != !i || (i && faces->properties[i].count))
            return false;
    return vertices->count && faces->count && faces->count <= UINT64_MAX - vertices->count;
}

/* Lines may be missing at the end of the file. */
static bool is_whole(const text *t) { return t->positions.count == t->of_vertices->count && t->sizes.count == t->of_faces->count; }

bool plain_ply_text(const plain_file *file, const ply_header *h, mesh *m)
{
    text t = {.file = file,
              .from = h->size,
              .are_counted = true,
              .read = read_lines,
              .of_vertices = &h->elements[0],
              .of_faces = &h->elements[1]};
    const bool is_read = are_plain(t.of_vertices, t.of_faces) && text_read(&t) && is_whole(&t) && text_make(&t, m);
    text_free(&t);
    return is_read;
}
