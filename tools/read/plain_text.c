/*
 * plain_text.c - OBJ: lines "v X Y Z" and "f A B C ...", with A, A/T, A//N or A/T/N, and others, which count for nothing. PLY: a
 * line for each vertex, then for each face, which begins with the list of its corners. STL in lower case: chunks begin at a facet.
 */
#include <string.h>

#include "plain.h"

static const char *skip_space(const char *c)
{
    while (text_ends_word(*c))
        c++;
    return c;
}

/* Three numbers, which may stand on several lines or not. */
static inline const char *take_position(const char *c, bool has_lines, text_chunk *chunk)
{
    double *const position = chunk->positions + 3 * chunk->vertices;
    for (int a = 0; c && a < 3; a++) {
        c = written_number_scan(has_lines ? skip_space(c) : text_skip_blanks(c), &position[a], &chunk->fit);
        c = c && text_ends_word(*c) ? c : NULL;
    }
    chunk->vertices++;
    return c;
}

/* What follows a word, eight bytes at once: what is carried comes after that. NULL where there is none, or it ends otherwise. */
static const char *skip_word(const char *c)
{
    for (const char *const first = c;; c += 8) {
        const uint64_t bytes = digits_load(c);
        const uint64_t ends = (bytes - UINT64_C(0x2121212121212121)) & ~bytes & UINT64_C(0x8080808080808080);
        if (ends) {
            c += __builtin_ctzll(ends) / 8;
            return c > first && text_ends_word(*c) ? c : NULL;
        }
    }
}

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

/* The numbers of texture and normal are not looked at. */
static const char *skip_slashes(const char *c)
{
    while (*c == '/' || *c == '-' || (*c >= '0' && *c <= '9'))
        c++;
    return c;
}

static const char *read_corner(const char *c, text_chunk *chunk)
{
    const bool is_relative = *c == '-';
    uint64_t number = 0;
    const char *const first = c + is_relative, *const end = digits_scan(first, &number);
    if (end == first || end > first + 10 || !number || number > UINT32_MAX)
        return NULL;
    if (is_relative) {
        const int64_t vertex = (int64_t)chunk->vertices - (int64_t)number;
        chunk->relatives[chunk->relative_count++] = (text_relative){chunk->corner_count, vertex};
    } else if (number - 1 > chunk->highest) {
        chunk->highest = (uint32_t)(number - 1);
    }
    chunk->corners[chunk->corner_count++] = (uint32_t)(number - 1);
    return *end == '/' ? skip_slashes(end) : end;
}

static const char *read_obj_face(const char *c, text_chunk *chunk)
{
    const size_t before = chunk->corner_count;
    for (c = text_skip_blanks(c); c && *c != '\n' && *c != '\r'; c = c ? text_skip_blanks(c) : NULL) {
        c = read_corner(c, chunk);
        if (c && !text_ends_word(*c))
            return NULL;
    }
    if (!c || chunk->corner_count == before)
        return NULL;
    text_add_face((uint32_t)(chunk->corner_count - before), chunk);
    return text_end_line(c);
}

static const char *read_obj_line(const char *c, const char *limit, text_chunk *chunk)
{
    c = text_skip_blanks(c);
    const char lower = (char)(*c | 0x20);
    if (*c == '\v' || *c == '\f') /* as blank as others, and nobody writes them */
        return NULL;
    const bool is_known = lower == 'v' || lower == 'f' || lower == 'l' || lower == 'p';
    if (*c == 'v' && text_is_blank(c[1])) {
        c = take_position(c + 1, false, chunk);
        return c ? skip_line(c, limit) : NULL;
    }
    if (*c == 'f' && text_is_blank(c[1]))
        return read_obj_face(c + 1, chunk);
    if (is_known && !(c[1] >= 'a' && c[1] <= 'z')) {
        if ((*c != 'l' && *c != 'p') || !text_is_blank(c[1]))
            return NULL;
        chunk->left_out++;
    }
    return skip_line(c, limit);
}

static bool read_obj_lines(const text *t, text_chunk *chunk)
{
    const char *c = chunk->begin;
    (void)t;
    while (c && c < chunk->limit)
        c = read_obj_line(c, chunk->limit, chunk);
    return c;
}

bool plain_obj(const plain_file *file, mesh *m) { return text_read(&(text){.file = file, .read = read_obj_lines}, m); }

static const char *take_coordinate(const char *c, const ply_property *property, text_chunk *chunk)
{
    double *const number = chunk->positions + 3 * chunk->vertices + property->role;
    float_fit own = chunk->fit;
    c = written_number_scan(c, number, property->type == PLY_DOUBLE ? &own : &chunk->fit);
    if (property->type == PLY_DOUBLE && c && float_fit_of(*number) > chunk->fit)
        chunk->fit = FLOAT_FIT_NONE;
    return c && text_ends_word(*c) ? c : NULL;
}

static const char *read_ply_vertex(const char *c, const text *t, text_chunk *chunk)
{
    const ply_element *const e = t->of_vertices;
    for (int i = 0; c && i < e->property_count; i++) {
        c = text_skip_blanks(c);
        c = e->properties[i].role <= PLY_Z ? take_coordinate(c, &e->properties[i], chunk) : skip_word(c);
    }
    chunk->vertices++;
    return c ? text_end_line(c) : NULL;
}

static const char *take_whole(const char *c, uint64_t most, uint32_t *number)
{
    uint64_t found = 0;
    const char *const first = text_skip_blanks(c), *const end = digits_scan(first, &found);
    *number = (uint32_t)found;
    return end > first && end <= first + 10 && found <= most && text_ends_word(*end) ? end : NULL;
}

static const char *read_ply_face(const char *c, const text *t, text_chunk *chunk)
{
    uint32_t size;
    c = take_whole(c, UINT32_MAX, &size);
    for (uint32_t i = 0; c && i < size; i++) {
        uint32_t *const corner = &chunk->corners[chunk->corner_count++];
        c = take_whole(c, t->of_vertices->count - 1, corner);
    }
    text_add_face(size, chunk);
    for (int i = 1; c && i < t->of_faces->property_count; i++)
        c = skip_word(text_skip_blanks(c));
    return c ? text_end_line(c) : NULL;
}

static bool read_ply_lines(const text *t, text_chunk *chunk)
{
    const uint64_t vertices = t->of_vertices->count, all = vertices + t->of_faces->count;
    const char *c = chunk->begin;
    uint64_t line = chunk->first_line;
    for (; c && c < chunk->limit && line < vertices; line++)
        c = read_ply_vertex(c, t, chunk);
    for (; c && c < chunk->limit && line < all; line++)
        c = read_ply_face(c, t, chunk);
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
static bool is_whole(const text *t)
{
    return t->all.positions.count == t->of_vertices->count && t->all.sizes.count == t->of_faces->count;
}

bool plain_ply_text(const plain_file *file, const ply_header *h, mesh *m)
{
    text t = {.file = file,
              .from = h->size,
              .are_counted = true,
              .read = read_ply_lines,
              .is_whole = is_whole,
              .of_vertices = &h->elements[0],
              .of_faces = &h->elements[1]};
    return are_plain(t.of_vertices, t.of_faces) && text_read(&t, m);
}

/* What follows a word, which is next; else NULL. */
static const char *expect(const char *c, const char *word)
{
    const size_t length = strlen(word);
    c = c ? skip_space(c) : NULL;
    return c && !memcmp(c, word, length) && text_ends_word(c[length]) ? c + length : NULL;
}

/* The rest of a line: a name. */
static const char *skip_name(const char *c, const char *end)
{
    const char *const line_end = memchr(c, '\n', (size_t)(end - c));
    if (!line_end)
        return NULL;
    const char *const text_end = line_end > c && line_end[-1] == '\r' ? line_end - 1 : line_end;
    const size_t length = (size_t)(text_end - c);
    return memchr(c, '\r', length) || memchr(c, '\0', length) ? NULL : line_end;
}

/* What follows "facet". */
static const char *read_facet(const char *c, text_chunk *chunk)
{
    c = expect(c, "normal");
    for (int a = 0; c && a < 3; a++)
        c = skip_word(skip_space(c));
    c = expect(expect(c, "outer"), "loop");
    for (int v = 0; c && v < 3; v++)
        c = take_position(expect(c, "vertex"), true, chunk);
    return expect(expect(c, "endloop"), "endfacet");
}

/* Where the next facet begins that begins a line; NULL where none does before the limit. */
static const char *find_facet(const char *c, const char *limit)
{
    while (c && c < limit) {
        const char *const word = text_skip_blanks(c);
        if (!memcmp(word, "facet", 5) && text_ends_word(word[5]))
            return word;
        c = memchr(c, '\n', (size_t)(limit - c));
        c = c ? c + 1 : NULL;
    }
    return NULL;
}

/* Reads up to the first facet after the chunk's lines, or the end of the file. Returns where it stopped; NULL: not plain. */
static const char *read_items(const char *c, text_chunk *chunk)
{
    const char *next;
    for (;;) {
        c = skip_space(c);
        if (c >= chunk->end)
            return chunk->is_last ? c : NULL;
        if (chunk->is_inside && (next = expect(c, "facet"))) {
            if (c >= chunk->limit)
                return c;
            next = read_facet(next, chunk);
        } else {
            next = expect(c, chunk->is_inside ? "endsolid" : "solid");
            next = next ? skip_name(next, chunk->end) : NULL;
            chunk->is_inside = !chunk->is_inside;
        }
        c = next;
        if (!c || (c >= chunk->end && !chunk->is_last))
            return NULL;
    }
}

static bool read_facets(const text *t, text_chunk *chunk)
{
    const char *const begin = chunk->number ? find_facet(chunk->begin, chunk->limit) : chunk->begin;
    (void)t;
    if (!begin)
        return true;
    chunk->is_inside = chunk->number;
    const char *const end = read_items(begin, chunk);
    if (!end)
        return false;
    chunk->facets_begin = chunk->offset + (uint64_t)(begin - chunk->begin);
    chunk->facets_end = chunk->offset + (uint64_t)(end - chunk->begin);
    return true;
}

/* The facets of a chunk have to begin where those before them end, in a solid. */
static bool join_facets(text *t, const text_chunk *chunk)
{
    if (!chunk->facets_end)
        return true;
    const bool is_joined = !chunk->number || (chunk->facets_begin == t->facets_end && t->is_inside);
    t->facets_end = chunk->facets_end;
    t->is_inside = chunk->is_inside;
    return is_joined;
}

static bool has_ended(const text *t) { return !t->is_inside; }

bool plain_stl(const plain_file *file, mesh *m)
{
    text t = {.file = file, .read = read_facets, .join = join_facets, .is_whole = has_ended, .all.is_soup = true};
    return text_read(&t, m);
}
