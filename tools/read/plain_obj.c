/* plain_obj.c - OBJ files: lines "v X Y Z" and "f A B C ...", with A, A/T, A//N or A/T/N, and others, which count for nothing. */
#include <string.h>

#include "text_parts.h"
#include "text_pieces.h"

/* Where no '\r' ends a line before that, and no backslash joins it with the next. */
static const char *skip_line(const char *c, const char *limit)
{
    const char *const end = memchr(c, '\n', (size_t)(limit - c));
    if (!end)
        return NULL;
    const char *const text_end = end > c && end[-1] == '\r' ? end - 1 : end;
    const bool is_joined = text_end > c && text_end[-1] == '\\';
    return is_joined || memchr(c, '\r', (size_t)(text_end - c)) ? NULL : end + 1;
}

static const char *read_vertex(const char *c, const char *limit, text_piece *piece)
{
    double *const position = piece->positions + 3 * piece->vertices;
    for (int a = 0; a < 3; a++) {
        c = written_number_scan(text_skip_blanks(c), &position[a], &piece->fit);
        if (!c || !text_ends_word(*c))
            return NULL;
    }
    piece->vertices++;
    return *c == '\n' ? c + 1 : skip_line(c, limit);
}

/* The numbers of texture and normal are not looked at. */
static const char *skip_slashes(const char *c)
{
    while (*c == '/' || *c == '-' || (*c >= '0' && *c <= '9'))
        c++;
    return c;
}

static const char *read_corner(const char *c, text_piece *piece)
{
    const bool is_relative = *c == '-';
    uint64_t number = 0;
    const char *const first = c + is_relative, *const end = digits_scan(first, &number);
    if (end == first || end > first + 10 || !number || number > UINT32_MAX)
        return NULL;
    if (is_relative) {
        const int64_t vertex = (int64_t)piece->vertices - (int64_t)number;
        piece->relatives[piece->relative_count++] = (text_relative){piece->corner_count, vertex};
    } else if (number - 1 > piece->highest) {
        piece->highest = (uint32_t)(number - 1);
    }
    piece->corners[piece->corner_count++] = (uint32_t)(number - 1);
    return *end == '/' ? skip_slashes(end) : end;
}

static const char *read_face(const char *c, text_piece *piece)
{
    const size_t before = piece->corner_count;
    for (c = text_skip_blanks(c); c && *c != '\n' && *c != '\r'; c = c ? text_skip_blanks(c) : NULL) {
        c = read_corner(c, piece);
        if (c && !text_ends_word(*c))
            return NULL;
    }
    if (!c || piece->corner_count == before)
        return NULL;
    text_piece_add_face((uint32_t)(piece->corner_count - before), piece);
    return text_end_line(c);
}

static const char *read_line(const char *c, const char *limit, text_piece *piece)
{
    c = text_skip_blanks(c);
    const char lower = (char)(*c | 0x20);
    if (*c == '\v' || *c == '\f') /* as blank as others, and nobody writes them */
        return NULL;
    const bool is_known = lower == 'v' || lower == 'f' || lower == 'l' || lower == 'p';
    if (*c == 'v' && text_is_blank(c[1]))
        return read_vertex(c + 1, limit, piece);
    if (*c == 'f' && text_is_blank(c[1]))
        return read_face(c + 1, piece);
    if (is_known && !(c[1] >= 'a' && c[1] <= 'z')) {
        if ((*c != 'l' && *c != 'p') || !text_is_blank(c[1]))
            return NULL;
        piece->left_out++;
    }
    return skip_line(c, limit);
}

static bool read_lines(void *data, unsigned thread, text_part *part)
{
    const text_pieces *const p = data;
    text_piece *const piece = text_pieces_begin(p, thread);
    const char *c = piece ? part->begin : NULL;
    while (c && c < part->limit)
        c = read_line(c, part->limit, piece);
    return c && text_pieces_keep(p, part->number, piece);
}

bool plain_obj(const plain_file *file, mesh *m)
{
    text_pieces p;
    const bool is_read = text_pieces_make(file, text_parts_count(file, 0), &p) &&
                         text_parts_run(file, 0, TEXT_ANY_ORDER, read_lines, &p) && text_pieces_join(&p, m);
    text_pieces_free(&p);
    return is_read;
}
