/*
 * plain_ply_text.c - PLY files as text: a line for each vertex, then a line for each face that begins with the list of its corners.
 */
#include "text_parts.h"
#include "text_pieces.h"

typedef struct ply_text {
    text_pieces pieces;
    const ply_element *vertices, *faces;
} ply_text;

static const char *skip_word(const char *c)
{
    const char *const first = c;
    while ((unsigned char)*c > ' ')
        c++;
    return c > first && text_ends_word(*c) ? c : NULL;
}

static const char *take_coordinate(const char *c, const ply_property *property, text_piece *piece)
{
    double *const number = piece->positions + 3 * piece->vertices + property->role;
    float_fit own = piece->fit;
    c = written_number_scan(c, number, property->type == PLY_DOUBLE ? &own : &piece->fit);
    if (property->type == PLY_DOUBLE && c && float_fit_of(*number) > piece->fit)
        piece->fit = FLOAT_FIT_NONE;
    return c && text_ends_word(*c) ? c : NULL;
}

static const char *read_vertex(const char *c, const ply_text *p, text_piece *piece)
{
    const ply_element *const e = p->vertices;
    for (int i = 0; c && i < e->property_count; i++) {
        c = text_skip_blanks(c);
        c = e->properties[i].role <= PLY_Z ? take_coordinate(c, &e->properties[i], piece) : skip_word(c);
    }
    piece->vertices++;
    return c ? text_end_line(c) : NULL;
}

static const char *take_whole(const char *c, uint64_t most, uint32_t *number)
{
    uint64_t found = 0;
    const char *const first = text_skip_blanks(c), *const end = digits_scan(first, &found);
    *number = (uint32_t)found;
    return end > first && end <= first + 10 && found <= most && text_ends_word(*end) ? end : NULL;
}

static const char *read_face(const char *c, const ply_text *p, text_piece *piece)
{
    uint32_t size;
    c = take_whole(c, UINT32_MAX, &size);
    for (uint32_t i = 0; c && i < size; i++) {
        uint32_t *const corner = &piece->corners[piece->corner_count++];
        c = take_whole(c, p->vertices->count - 1, corner);
    }
    text_piece_add_face(size, piece);
    for (int i = 1; c && i < p->faces->property_count; i++)
        c = skip_word(text_skip_blanks(c));
    return c ? text_end_line(c) : NULL;
}

static bool read_lines(void *data, unsigned thread, text_part *part)
{
    const ply_text *const p = data;
    const uint64_t vertices = p->vertices->count, all = vertices + p->faces->count;
    text_piece *const piece = text_pieces_begin(&p->pieces, thread);
    const char *c = piece ? part->begin : NULL;
    uint64_t line = part->first_line;
    for (; c && c < part->limit && line < vertices; line++)
        c = read_vertex(c, p, piece);
    for (; c && c < part->limit && line < all; line++)
        c = read_face(c, p, piece);
    return c && text_pieces_keep(&p->pieces, part->number, piece);
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

/* Lines that are missing at the end of the file. */
static bool is_whole(const ply_text *p)
{
    uint64_t vertices = 0, faces = 0;
    for (size_t i = 0; i < p->pieces.count; i++) {
        vertices += p->pieces.pieces[i].vertices;
        faces += p->pieces.pieces[i].faces;
    }
    return vertices == p->vertices->count && faces == p->faces->count;
}

bool plain_ply_text(const plain_file *file, const ply_header *h, mesh *m)
{
    ply_text p = {.vertices = &h->elements[0], .faces = &h->elements[1]};
    if (!are_plain(p.vertices, p.faces))
        return false;
    const bool is_read = text_pieces_make(file, text_parts_count(file, h->size), &p.pieces) &&
                         text_parts_run(file, h->size, TEXT_COUNTED, read_lines, &p) && is_whole(&p) &&
                         text_pieces_join(&p.pieces, m);
    text_pieces_free(&p.pieces);
    return is_read;
}
