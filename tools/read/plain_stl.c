/* plain_stl.c - STL files as text in lower case. Parts of them begin with a facet. */
#include <string.h>

#include "text.h"

static const char *skip_space(const char *c)
{
    while (text_ends_word(*c))
        c++;
    return c;
}

/* What follows a word, which is next; else NULL. */
static const char *expect(const char *c, const char *word)
{
    const size_t length = strlen(word);
    c = c ? skip_space(c) : NULL;
    return c && !memcmp(c, word, length) && text_ends_word(c[length]) ? c + length : NULL;
}

/* The bytes of a word before a blank or another character up to it, eight at once: what is carried comes after that. */
static const char *skip_word(const char *c)
{
    for (;; c += 8) {
        const uint64_t bytes = digits_load(c);
        const uint64_t ends = (bytes - UINT64_C(0x2121212121212121)) & ~bytes & UINT64_C(0x8080808080808080);
        if (ends)
            return c + __builtin_ctzll(ends) / 8;
    }
}

static const char *skip_words(const char *c, int count)
{
    for (; c && count; count--) {
        const char *const first = skip_space(c);
        c = skip_word(first);
        if (c == first || !text_ends_word(*c))
            return NULL;
    }
    return c;
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

static inline const char *read_vertex(const char *c, text_part *part)
{
    double *const position = part->positions + 3 * part->vertices;
    c = expect(c, "vertex");
    for (int a = 0; c && a < 3; a++) {
        c = written_number_scan(skip_space(c), &position[a], &part->fit);
        c = c && text_ends_word(*c) ? c : NULL;
    }
    part->vertices++;
    return c;
}

/* What follows "facet". */
static const char *read_facet(const char *c, text_part *part)
{
    c = expect(expect(skip_words(expect(c, "normal"), 3), "outer"), "loop");
    for (int v = 0; c && v < 3; v++)
        c = read_vertex(c, part);
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

/* Reads up to the first facet after the part's lines, or the end of the file. Returns where it stopped; NULL: not plain. */
static const char *read_items(const char *c, text_part *part)
{
    const char *next;
    for (;;) {
        c = skip_space(c);
        if (c >= part->end)
            return part->is_last ? c : NULL;
        if (part->is_inside && (next = expect(c, "facet"))) {
            if (c >= part->limit)
                return c;
            next = read_facet(next, part);
        } else {
            next = expect(c, part->is_inside ? "endsolid" : "solid");
            next = next ? skip_name(next, part->end) : NULL;
            part->is_inside = !part->is_inside;
        }
        c = next;
        if (!c || (c >= part->end && !part->is_last))
            return NULL;
    }
}

static bool read_facets(const text *t, text_part *part)
{
    const char *const begin = part->number ? find_facet(part->begin, part->limit) : part->begin;
    (void)t;
    if (!begin)
        return true;
    part->is_inside = part->number;
    const char *const end = read_items(begin, part);
    if (!end)
        return false;
    part->facets_begin = part->offset + (uint64_t)(begin - part->begin);
    part->facets_end = part->offset + (uint64_t)(end - part->begin);
    return true;
}

/* The facets of a part have to begin where those before them end, in a solid. */
static bool join_facets(text *t, const text_part *part)
{
    if (!part->facets_end)
        return true;
    const bool is_joined = !part->number || (part->facets_begin == t->facets_end && t->is_inside);
    t->facets_end = part->facets_end;
    t->is_inside = part->is_inside;
    return is_joined;
}

bool plain_stl(const plain_file *file, mesh *m)
{
    text t = {.file = file, .has_no_faces = true, .read = read_facets, .join = join_facets};
    const bool is_read = text_read(&t) && !t.is_inside && text_make(&t, m);
    text_free(&t);
    return is_read;
}
