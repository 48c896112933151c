/*
 * text.c - chunks are read with a little of what follows, for the lines that begin in each. What threads find there is put together
 * in the order of the file; when all is there polygons are cut, by threads again.
 */
#include "plain.h"

#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/system.h"
#include "console/message.h"
#include "files/files.h"
#include "mesh_file.h"

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

typedef struct text_run {
    text *t;
    size_t count; /* of the chunks */
    uint64_t lines;
    bool is_failed;
} text_run;

static void free_chunk(void *place)
{
    text_chunk *const chunk = place;
    free(chunk->positions);
    free(chunk->corners);
    free(chunk->sizes);
    free(chunk->relatives);
    free(chunk);
}

/* A vertex takes six bytes of text, "0 0 0" and a blank; a corner or a face two, a relative corner three, "-1". */
static void *make_chunk(void *data)
{
    const text_run *const r = data;
    const size_t bytes = 1 + r->t->file->chunk_bytes + TEXT_OVERLAP + TEXT_AHEAD;
    text_chunk *const chunk = malloc(sizeof *chunk + bytes + 1);
    if (!chunk)
        return NULL;
    *chunk = (text_chunk){.positions = malloc((bytes / 6 + 1) * sizeof(double[3])),
                          .corners = malloc((bytes / 2 + 1) * sizeof *chunk->corners),
                          .sizes = malloc((bytes / 2 + 1) * sizeof *chunk->sizes),
                          .relatives = malloc((bytes / 3 + 1) * sizeof *chunk->relatives)};
    if (chunk->positions && chunk->corners && chunk->sizes && chunk->relatives)
        return chunk;
    free_chunk(chunk);
    return NULL;
}

/* The chunk begins a byte early, which says whether a line does. */
static bool load_lines(const text_run *r, text_chunk *chunk)
{
    const plain_file *const file = r->t->file;
    const size_t early = chunk->number > 0, bytes = file->chunk_bytes;
    const uint64_t start = r->t->from + (uint64_t)chunk->number * bytes - early;
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
    text_run *const r = data;
    text_chunk *const chunk = place;
    if (n == r->count)
        return false;
    reading_tell((double)n / (double)r->count);
    chunk->number = n;
    chunk->vertices = chunk->corner_count = chunk->faces = chunk->relative_count = chunk->left_out = 0;
    chunk->fit = FLOAT_FIT_EXACT;
    chunk->highest = 0;
    chunk->facets_end = 0;
    r->is_failed = !load_lines(r, chunk);
    chunk->first_line = r->lines;
    if (!r->is_failed && r->t->are_counted)
        r->lines += count_lines(chunk->begin, chunk->limit);
    return !r->is_failed;
}

static int read_chunk(void *data, void *place, size_t n)
{
    const text_run *const r = data;
    text_chunk *const chunk = place;
    (void)n;
    return chunk->begin == chunk->limit || r->t->read(r->t, chunk) ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
}

/* False where there is no memory. */
static bool add(const void *from, size_t count, size_t each, text_list *to)
{
    void *const grown = memory_grow_pages(to->of, to->count + count, &to->room, each);
    if (!grown)
        return false;
    if (count)
        memcpy((char *)grown + to->count * each, from, count * each);
    to->of = grown;
    to->count += count;
    return true;
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
    text *const t = ((text_run *)data)->t;
    const text_chunk *const chunk = place;
    (void)n;
    for (size_t i = 0; i < chunk->faces; i++)
        t->has_polygons |= chunk->sizes[i] != 3;
    t->fit = chunk->fit > t->fit ? chunk->fit : t->fit;
    t->highest = chunk->highest > t->highest ? chunk->highest : t->highest;
    t->left_out += chunk->left_out;
    const bool is_joined = (!t->join || t->join(t, chunk)) && number_relatives(chunk, t->positions.count) &&
                           add(chunk->positions, chunk->vertices, sizeof(double[3]), &t->positions) &&
                           add(chunk->corners, chunk->corner_count, sizeof *chunk->corners, &t->corners) &&
                           add(chunk->sizes, chunk->faces, sizeof *chunk->sizes, &t->sizes);
    return is_joined && t->positions.count <= UINT32_MAX ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
}

bool text_read(text *t)
{
    const plain_file *const file = t->file;
    const uint64_t count = (file->size - t->from + file->chunk_bytes - 1) / file->chunk_bytes;
    text_run r = {.t = t, .count = count < SIZE_MAX ? (size_t)count : SIZE_MAX};
    const crew_work work = {.threads = file->threads < r.count ? file->threads : (unsigned)r.count,
                            .each = 2,
                            .is_told_in_order = true,
                            .begin = make_chunk,
                            .end = free_chunk,
                            .find = find_chunk,
                            .step = read_chunk,
                            .tell = join_chunk};
    reading_begin();
    const int code = crew_do(&work, &r);
    reading_end();
    return !code && !r.is_failed && (!t->corners.count || t->highest < t->positions.count);
}

/* Faces become triangles in blocks. */
typedef struct cutting {
    const text *t;
    size_t faces, corners; /* of the blocks before the next */
    text_list triangles;
    size_t left_out, miscut;
} cutting;

typedef struct face_block {
    size_t first, count, corner;
    indexed_mesh cut;
} face_block;

static void *make_block(void *data)
{
    (void)data;
    return calloc(1, sizeof(face_block));
}

/* The positions are not its own. */
static void free_block(void *place)
{
    face_block *const b = place;
    free(b->cut.corners);
    free(b->cut.face);
    free(b);
}

static bool find_block(void *data, void *place, size_t n)
{
    cutting *const c = data;
    face_block *const b = place;
    const uint32_t *const sizes = c->t->sizes.of;
    const size_t left = c->t->sizes.count - c->faces, most = 1 + c->t->file->chunk_bytes / 64;
    (void)n;
    b->first = c->faces;
    b->count = left < most ? left : most;
    b->corner = c->corners;
    for (size_t i = 0; i < b->count; i++)
        c->corners += sizes[c->faces++];
    return b->count;
}

/* Where their doubles are, before they are rounded. */
static int cut_block(void *data, void *place, size_t n)
{
    const text *const t = ((const cutting *)data)->t;
    face_block *const b = place;
    indexed_mesh *const cut = &b->cut;
    const uint32_t *corners = (const uint32_t *)t->corners.of + b->corner, *const sizes = (const uint32_t *)t->sizes.of + b->first;
    int code = EXIT_CODE_OK;
    (void)n;
    cut->positions = t->positions.of;
    cut->position_bytes = sizeof(double);
    cut->vertices = t->positions.count;
    cut->triangles = cut->left_out = cut->miscut = 0;
    for (size_t i = 0; !code && i < b->count; corners += sizes[i++]) {
        code = indexed_mesh_reserve_face(t->file->path, sizes[i], cut);
        if (!code && sizes[i]) /* without any corner there is no array */
            memcpy(cut->face, corners, sizes[i] * sizeof *corners);
        code = code ? code : indexed_mesh_add_face(t->file->path, sizes[i], cut);
    }
    return code;
}

static int keep_block(void *data, void *place, size_t n)
{
    cutting *const c = data;
    const indexed_mesh *const cut = &((const face_block *)place)->cut;
    (void)n;
    c->left_out += cut->left_out;
    c->miscut += cut->miscut;
    return add(cut->corners, 3 * cut->triangles, sizeof *cut->corners, &c->triangles) ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
}

static bool cut_polygons(text *t)
{
    cutting c = {.t = t};
    const crew_work work = {.threads = t->file->threads,
                            .each = 2,
                            .is_told_in_order = true,
                            .begin = make_block,
                            .end = free_block,
                            .find = find_block,
                            .step = cut_block,
                            .tell = keep_block};
    const int code = crew_do(&work, &c);
    pages_free(t->corners.of, t->corners.room * sizeof(uint32_t));
    t->corners = c.triangles;
    t->left_out += c.left_out;
    t->miscut = c.miscut;
    return !code;
}

/* For free(). */
static void *copy(const text_list *list, size_t each)
{
    void *const to = malloc(list->count * each);
    return to ? memcpy(to, list->of, list->count * each) : NULL;
}

bool text_make(text *t, mesh *m)
{
    if (t->has_polygons && !cut_polygons(t))
        return false;
    const bool are_doubles = t->file->is_wide || t->fit == FLOAT_FIT_NONE;
    indexed_mesh all = {.positions = are_doubles ? copy(&t->positions, sizeof(double[3])) : t->positions.of,
                        .position_bytes = sizeof(double),
                        .fit = t->fit,
                        .vertices = t->positions.count,
                        .corners = t->has_no_faces ? NULL
                                   : are_doubles   ? copy(&t->corners, sizeof(uint32_t))
                                                   : t->corners.of,
                        .triangles = (t->has_no_faces ? t->positions.count : t->corners.count) / 3,
                        .left_out = t->left_out,
                        .miscut = t->miscut};
    const bool is_made = all.triangles && all.positions && (all.corners || t->has_no_faces) &&
                         mesh_take(&all, t->file->is_wide, t->file->threads, m);
    if (are_doubles)
        indexed_mesh_free(&all);
    return is_made;
}

void text_free(text *t)
{
    pages_free(t->positions.of, t->positions.room * sizeof(double[3]));
    pages_free(t->corners.of, t->corners.room * sizeof(uint32_t));
    pages_free(t->sizes.of, t->sizes.room * sizeof(uint32_t));
}
