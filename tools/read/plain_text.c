/*
 * plain_text.c - OBJ: lines "v X Y Z" and "f A B C ...", with A, A/T, A//N or A/T/N, whose T and N are passed over unread, and
 * others, which count for nothing. PLY: a line for each vertex, then for each face, which begins with the list of its corners. STL
 * in lower case: chunks begin at a facet.
 *
 * Chunks are read with a little of what follows, for the lines that begin in each. What threads find there is put together in the
 * order of the file.
 */
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/digits.h"
#include "console/message.h"
#include "console/system.h"
#include "files/files.h"
#include "plain.h"

/* A corner whose vertex is counted from the chunk's first: a place in `corners`, and the vertex, which may be before that. */
typedef struct text_relative {
    size_t corner;
    int64_t vertex;
} text_relative;

/*
 * The lines that begin between two places of the file: chunk 0 begins where the text does. After the file's last line, which a line
 * end is put to, come zeros: TEXT_AHEAD bytes may be looked at from anywhere before `end`.
 */
typedef struct text_chunk {
    size_t number;
    const char *begin, *limit; /* of the lines; begin == limit where none begins here */
    const char *end;           /* of what is there of the next chunks' lines */
    bool is_last;              /* the file ends at `end` */
    uint64_t offset;           /* of begin in the file */
    uint64_t first_line;       /* counted from 0, where they are counted */

    /* What is found there, in lists with room for all that a chunk may have. */
    double *positions;
    uint32_t *corners; /* of all faces, one after another */
    uint32_t *sizes;   /* how many each face has */
    text_relative *relatives;
    size_t vertices, corner_count, faces, relative_count;
    float_fit fit;
    uint32_t highest; /* of the corners that are not relative; 0 without one */
    size_t left_out;
    uint64_t facets_begin, facets_end; /* of STL: where in the file they do; 0: none begins here */
    bool is_inside;                    /* of STL: a solid, where they end */
    char *bytes;
} text_chunk;

enum { TEXT_AHEAD = 64, TEXT_OVERLAP = 8192 /* bytes of the chunks after it that a chunk has, so that no line may be longer */ };

typedef struct text {
    const plain_file *file;
    uint64_t from;                                         /* where its lines begin */
    bool are_counted;                                      /* the lines */
    bool (*read)(const struct text *t, text_chunk *chunk); /* of threads at once; false: not plain */
    bool (*join)(struct text *t, const text_chunk *chunk); /* of the chunks in their order; may be NULL */
    bool (*is_whole)(const struct text *t);                /* whether nothing lacks at the end; may be NULL */
    const ply_element *of_vertices, *of_faces;             /* of PLY */
    uint64_t facets_end;                                   /* of STL, of the chunks that are joined, as theirs */
    bool is_inside;
    indexed_mesh all;
    uint32_t highest; /* as theirs */
    size_t chunks;
    uint64_t lines; /* before the next chunk */
    bool is_failed;
} text;

/* Adds a face of the last `size` corners. */
static inline void text_add_face(uint32_t size, text_chunk *chunk) { chunk->sizes[chunk->faces++] = size; }

static inline bool text_is_blank(char c) { return c == ' ' || c == '\t'; }

static inline bool text_ends_word(char c) { return text_is_blank(c) || c == '\r' || c == '\n'; }

static inline const char *text_skip_blanks(const char *c)
{
    while (text_is_blank(*c))
        c++;
    return c;
}

/* What follows a line's last word: its end, which a '\r' may precede; NULL where there is something else. */
static inline const char *text_end_line(const char *c)
{
    c = text_skip_blanks(c);
    c += *c == '\r';
    return *c == '\n' ? c + 1 : NULL;
}

static const char *after_line(const char *from, const char *end)
{
    const char *const found = from < end ? memchr(from, '\n', (size_t)(end - from)) : NULL;
    return found ? found + 1 : NULL;
}

static uint64_t count_lines(const char *c, const char *end)
{
    enum { AT_ONCE = 255 /* that a byte counts */ };
    uint64_t lines = 0;
    while (c < end) {
        const size_t left = (size_t)(end - c), count = left < AT_ONCE ? left : AT_ONCE;
        unsigned char here = 0;
        for (size_t i = 0; i < count; i++)
            here = (unsigned char)(here + (c[i] == '\n'));
        lines += here;
        c += count;
    }
    return lines;
}

/* A vertex takes six bytes of text, "0 0 0" and a blank; a corner or a face two, a relative corner three, "-1". */
static bool begin_chunk(void *data, void *place)
{
    const text *const t = data;
    text_chunk *const chunk = place;
    const size_t bytes = 1 + t->file->chunk_bytes + TEXT_OVERLAP + TEXT_AHEAD;
    const size_t positions = (bytes / 6 + 1) * sizeof(double[3]), relatives = (bytes / 3 + 1) * sizeof(text_relative);
    const size_t corners = (bytes / 2 + 1) * sizeof(uint32_t);
    char *const room = malloc(positions + relatives + 2 * corners + bytes + 1);
    if (room) {
        chunk->positions = (void *)room;
        chunk->relatives = (void *)(room + positions);
        chunk->corners = (void *)((char *)chunk->relatives + relatives);
        chunk->sizes = (void *)((char *)chunk->corners + corners);
        chunk->bytes = (char *)chunk->sizes + corners;
    }
    return room;
}

static void end_chunk(void *place) { free(((text_chunk *)place)->positions); }

/* The chunk begins a byte early, which says whether a line does. */
static bool load_lines(const text *t, text_chunk *chunk)
{
    const plain_file *const file = t->file;
    const size_t early = chunk->number > 0, bytes = file->chunk_bytes;
    const uint64_t start = t->from + (uint64_t)chunk->number * bytes - early;
    char *const room = chunk->bytes;
    size_t got;
    if (!named_file_read_at(file->stream, start, room, early + bytes + TEXT_OVERLAP, &got) || got < early)
        return false;
    chunk->is_last = start + got >= file->size;
    const char *const own_end = room + (got < bytes + early ? got : bytes + early), *begin = room;
    room[got] = '\n';
    chunk->end = room + got + (chunk->is_last && got && room[got - 1] != '\n');
    memset(room + got + 1, 0, TEXT_AHEAD);
    if (early)
        begin = after_line(room, own_end - 1);
    chunk->limit = after_line(own_end - 1, room + got);
    if (!chunk->limit && chunk->is_last)
        chunk->limit = chunk->end;
    chunk->begin = begin ? begin : chunk->limit;
    chunk->offset = chunk->begin ? start + (uint64_t)(chunk->begin - room) : 0;
    return chunk->limit || !begin;
}

static bool find_chunk(void *data, void *place, size_t n)
{
    text *const t = data;
    text_chunk *const chunk = place;
    if (n == t->chunks)
        return false;
    reading_tell((double)n / (double)t->chunks);
    chunk->number = n;
    chunk->vertices = chunk->corner_count = chunk->faces = chunk->relative_count = chunk->left_out = 0;
    chunk->fit = FLOAT_FIT_EXACT;
    chunk->highest = 0;
    chunk->facets_end = 0;
    t->is_failed = !load_lines(t, chunk);
    chunk->first_line = t->lines;
    if (!t->is_failed && t->are_counted)
        t->lines += count_lines(chunk->begin, chunk->limit);
    return !t->is_failed;
}

static int read_chunk(void *data, void *place, size_t n)
{
    const text *const t = data;
    text_chunk *const chunk = place;
    (void)n;
    return chunk->begin == chunk->limit || t->read(t, chunk) ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
}

/* False where there is no memory. */
static bool add(const void *from, size_t count, size_t each, page_list *list)
{
    void *const to = page_list_add(count, each, list);
    if (to && count)
        memcpy(to, from, count * each);
    return to;
}

/* Those that are counted from the vertices before them get their numbers. */
static bool number_relatives(const text_chunk *chunk, uint64_t vertices_before)
{
    bool is_sound = true;
    for (size_t i = 0; i < chunk->relative_count; i++) {
        const int64_t vertex = (int64_t)vertices_before + chunk->relatives[i].vertex;
        is_sound &= vertex >= 0;
        chunk->corners[chunk->relatives[i].corner] = (uint32_t)vertex;
    }
    return is_sound;
}

static int join_chunk(void *data, void *place, size_t n)
{
    text *const t = data;
    indexed_mesh *const to = &t->all;
    const text_chunk *const chunk = place;
    (void)n;
    to->fit = chunk->fit > to->fit ? chunk->fit : to->fit;
    to->left_out += chunk->left_out;
    t->highest = chunk->highest > t->highest ? chunk->highest : t->highest;
    const bool is_joined = (!t->join || t->join(t, chunk)) && number_relatives(chunk, to->positions.count) &&
                           add(chunk->positions, chunk->vertices, sizeof(double[3]), &to->positions) &&
                           add(chunk->corners, chunk->corner_count, sizeof *chunk->corners, &to->corners) &&
                           add(chunk->sizes, chunk->faces, sizeof *chunk->sizes, &to->sizes);
    return is_joined && to->positions.count <= UINT32_MAX ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
}

static bool read_all(text *t)
{
    const plain_file *const file = t->file;
    const uint64_t count = (file->size - t->from + file->chunk_bytes - 1) / file->chunk_bytes;
    t->chunks = count < SIZE_MAX ? (size_t)count : SIZE_MAX;
    const crew_work work = {.threads = file->threads < t->chunks ? file->threads : (unsigned)t->chunks,
                            .each = 2,
                            .is_told_in_order = true,
                            .place_bytes = sizeof(text_chunk),
                            .begin = begin_chunk,
                            .end = end_chunk,
                            .find = find_chunk,
                            .step = read_chunk,
                            .tell = join_chunk};
    reading_begin();
    const int code = crew_do(&work, t);
    reading_end();
    return !code && !t->is_failed;
}

/* Reads a text, and makes a mesh of it. False where it is not plain. */
static bool text_read(text *t, mesh *m)
{
    t->all.position_bytes = sizeof(double);
    const bool is_read = read_all(t) && (!t->all.corners.count || t->highest < t->all.positions.count) &&
                         (!t->is_whole || t->is_whole(t)) && !mesh_take(NULL, &t->all, t->file->is_wide, t->file->threads, m);
    indexed_mesh_free(&t->all);
    return is_read;
}

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

/* The end of a line, where no '\r' ends one before that; *last: what it ends with before that. */
static const char *find_line_end(const char *c, const char *limit, char *last)
{
    const char *const end = memchr(c, '\n', (size_t)(limit - c));
    if (!end)
        return NULL;
    const char *const text_end = end > c && end[-1] == '\r' ? end - 1 : end;
    *last = text_end > c ? text_end[-1] : '\n';
    return memchr(c, '\r', (size_t)(text_end - c)) ? NULL : end;
}

/* Where no backslash joins it with the next. */
static const char *skip_line(const char *c, const char *limit)
{
    char last;
    const char *const end = find_line_end(c, limit, &last);
    const bool is_joined = end && last == '\\';
    return !end || is_joined ? NULL : end + 1;
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
static const char *skip_name(const char *c, const char *limit)
{
    char last;
    const char *const end = find_line_end(c, limit, &last);
    return end && !memchr(c, '\0', (size_t)(end - c)) ? end : NULL;
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
