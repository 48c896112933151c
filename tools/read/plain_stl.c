/* plain_stl.c - STL files as text in lower case. Parts of them begin with a facet, and memory is that of the mesh. */
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_look.h"
#include "text_parts.h"
#include "text_pieces.h"

enum { FACET_BYTES = 86 /* at least, as scan_text.c says */ };

typedef struct stl_text {
    text_pieces scratches; /* of the threads */
    bool are_doubles;      /* a number is no float */
    mesh *m;
    size_t room; /* triangles at most */
    /* of the parts that are passed */
    size_t triangles;
    uint64_t end;   /* in the file */
    bool is_inside; /* a solid, there */
    mesh_look look;
    atomic_bool needs_doubles;
} stl_text;

/* What a part has: the facets that begin there, but for those before the first that begins a line. */
typedef struct stl_piece {
    size_t triangles, first;
    uint64_t begin, end; /* in the file */
    bool is_inside;      /* a solid, where it ends */
} stl_piece;

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

static inline const char *read_vertex(const char *c, text_piece *piece)
{
    double *const position = piece->positions + 3 * piece->vertices;
    c = expect(c, "vertex");
    for (int a = 0; c && a < 3; a++) {
        c = written_number_scan(skip_space(c), &position[a], &piece->fit);
        c = c && text_ends_word(*c) ? c : NULL;
    }
    piece->vertices++;
    return c;
}

/* What follows "facet". */
static const char *read_facet(const char *c, text_piece *piece)
{
    c = expect(expect(skip_words(expect(c, "normal"), 3), "outer"), "loop");
    for (int v = 0; c && v < 3; v++)
        c = read_vertex(c, piece);
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
static const char *read_items(const char *c, const text_part *part, bool *is_inside, text_piece *piece)
{
    const char *next;
    for (;;) {
        c = skip_space(c);
        if (c >= part->end)
            return part->is_last ? c : NULL;
        if (*is_inside && (next = expect(c, "facet"))) {
            if (c >= part->limit)
                return c;
            next = read_facet(next, piece);
        } else {
            next = expect(c, *is_inside ? "endsolid" : "solid");
            next = next ? skip_name(next, part->end) : NULL;
            *is_inside = !*is_inside;
        }
        c = next;
        if (!c || (c >= part->end && !part->is_last))
            return NULL;
    }
}

/* A piece has to begin where the one before it ends, in a solid. */
static bool join_piece(stl_text *s, text_part *part, stl_piece *piece)
{
    if (!text_part_await(part))
        return false;
    const bool is_joined = !part->number || (piece->begin == s->end && s->is_inside);
    piece->first = s->triangles;
    s->triangles += piece->triangles;
    s->end = piece->end;
    s->is_inside = piece->is_inside;
    const bool has_room = s->triangles <= s->room;
    text_part_pass(part);
    return is_joined && has_room;
}

static bool place_piece(stl_text *s, const text_piece *found, const stl_piece *piece)
{
    const tribox_mesh all = {
        .positions = found->positions, .vertices = found->vertices, .count = piece->triangles, .position_bytes = sizeof(double)};
    if (!piece->triangles)
        return true;
    if (!s->are_doubles)
        return mesh_look_put(&all, piece->first, s->m, &s->look);
    memcpy((double *)s->m->positions + 9 * piece->first, found->positions, piece->triangles * sizeof(double[9]));
    return true;
}

static bool read_part(void *data, unsigned thread, text_part *part)
{
    stl_text *const s = data;
    stl_piece piece = {.is_inside = part->number > 0};
    text_piece *const found = text_pieces_begin(&s->scratches, thread);
    const char *const begin = part->number ? find_facet(part->begin, part->limit) : part->begin;
    if (!found || !begin)
        return found;
    const char *const end = read_items(begin, part, &piece.is_inside, found);
    if (!end)
        return false;
    piece.begin = part->offset + (uint64_t)(begin - part->begin);
    piece.end = part->offset + (uint64_t)(end - part->begin);
    piece.triangles = found->vertices / 3;
    if (!s->are_doubles && found->fit == FLOAT_FIT_NONE) {
        s->needs_doubles = true;
        return false;
    }
    return join_piece(s, part, &piece) && place_piece(s, found, &piece);
}

/* For as many triangles as the text may have: memory that is not touched is not taken. */
static bool make_room(const plain_file *file, stl_text *s)
{
    const uint64_t most = file->size / FACET_BYTES + 1;
    if (most > SIZE_MAX / sizeof(double[9]))
        return false;
    s->room = (size_t)most;
    if (!s->are_doubles)
        return mesh_take_room(most, s->m);
    double *const positions = malloc(s->room * sizeof(double[9]));
    if (positions)
        mesh_set_doubles(positions, 3 * s->room, NULL, s->room, s->m);
    return positions;
}

static void end_mesh(unsigned threads, stl_text *s)
{
    mesh *const m = s->m;
    if (s->are_doubles) {
        double *const less = realloc(m->positions, s->triangles * sizeof(double[9]));
        mesh_set_doubles(less ? less : m->positions, 3 * s->triangles, NULL, s->triangles, m);
        mesh_look_all(threads, m);
    } else {
        m->triangles = m->soup.count = s->triangles;
        mesh_look_keep(&s->look, m);
    }
}

static bool read_as(const plain_file *file, bool are_doubles, bool *needs_doubles, mesh *m)
{
    stl_text s = {.are_doubles = are_doubles, .m = m, .look = mesh_look_none()};
    const bool is_read = text_pieces_make(file, 0, &s.scratches) && make_room(file, &s) &&
                         text_parts_run(file, 0, TEXT_IN_ORDER, read_part, &s) && !s.is_inside && s.triangles;
    text_pieces_free(&s.scratches);
    *needs_doubles = s.needs_doubles;
    if (is_read)
        end_mesh(file->threads, &s);
    else
        mesh_free(m);
    return is_read;
}

bool plain_stl(const plain_file *file, mesh *m)
{
    bool needs_doubles;
    return read_as(file, file->is_wide, &needs_doubles, m) || (needs_doubles && read_as(file, true, &needs_doubles, m));
}
