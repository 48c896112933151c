/* plain_obj.c - OBJ files: lines "v X Y Z" and "f A B C ...", with A, A/T, A//N or A/T/N, and others, which count for nothing. */
#include <string.h>

#include "text.h"

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

static const char *read_vertex(const char *c, const char *limit, text_part *part)
{
    double *const position = part->positions + 3 * part->vertices;
    for (int a = 0; a < 3; a++) {
        c = written_number_scan(text_skip_blanks(c), &position[a], &part->fit);
        if (!c || !text_ends_word(*c))
            return NULL;
    }
    part->vertices++;
    return *c == '\n' ? c + 1 : skip_line(c, limit);
}

/* The numbers of texture and normal are not looked at. */
static const char *skip_slashes(const char *c)
{
    while (*c == '/' || *c == '-' || (*c >= '0' && *c <= '9'))
        c++;
    return c;
}

static const char *read_corner(const char *c, text_part *part)
{
    const bool is_relative = *c == '-';
    uint64_t number = 0;
    const char *const first = c + is_relative, *const end = digits_scan(first, &number);
    if (end == first || end > first + 10 || !number || number > UINT32_MAX)
        return NULL;
    if (is_relative) {
        const int64_t vertex = (int64_t)part->vertices - (int64_t)number;
        part->relatives[part->relative_count++] = (text_relative){part->corner_count, vertex};
    } else if (number - 1 > part->highest) {
        part->highest = (uint32_t)(number - 1);
    }
    part->corners[part->corner_count++] = (uint32_t)(number - 1);
    return *end == '/' ? skip_slashes(end) : end;
}

static const char *read_face(const char *c, text_part *part)
{
    const size_t before = part->corner_count;
    for (c = text_skip_blanks(c); c && *c != '\n' && *c != '\r'; c = c ? text_skip_blanks(c) : NULL) {
        c = read_corner(c, part);
        if (c && !text_ends_word(*c))
            return NULL;
    }
    if (!c || part->corner_count == before)
        return NULL;
    text_add_face((uint32_t)(part->corner_count - before), part);
    return text_end_line(c);
}

static const char *read_line(const char *c, const char *limit, text_part *part)
{
    c = text_skip_blanks(c);
    const char lower = (char)(*c | 0x20);
    if (*c == '\v' || *c == '\f') /* as blank as others, and nobody writes them */
        return NULL;
    const bool is_known = lower == 'v' || lower == 'f' || lower == 'l' || lower == 'p';
    if (*c == 'v' && text_is_blank(c[1]))
        return read_vertex(c + 1, limit, part);
    if (*c == 'f' && text_is_blank(c[1]))
        return read_face(c + 1, part);
    if (is_known && !(c[1] >= 'a' && c[1] <= 'z')) {
        if ((*c != 'l' && *c != 'p') || !text_is_blank(c[1]))
            return NULL;
        part->left_out++;
    }
    return skip_line(c, limit);
}

static bool read_lines(const text *t, text_part *part)
{
    const char *c = part->begin;
    (void)t;
    while (c && c < part->limit)
        c = read_line(c, part->limit, part);
    return c;
}

bool plain_obj(const plain_file *file, mesh *m)
{
    text t = {.file = file, .read = read_lines};
    const bool is_read = text_read(&t) && text_make(&t, m);
    text_free(&t);
    return is_read;
}
