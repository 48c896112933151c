/*
 * text.c - chunks are read with a little of what follows, for the lines that begin in each. What threads find there is put together
 * in the order of the file.
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
    text *const t = ((text_run *)data)->t;
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
    return !code && !r.is_failed;
}

bool text_read(text *t, mesh *m)
{
    t->all.position_bytes = sizeof(double);
    const bool is_read = read_all(t) && (!t->all.corners.count || t->highest < t->all.positions.count) &&
                         (!t->is_whole || t->is_whole(t)) && !mesh_take(NULL, &t->all, t->file->is_wide, t->file->threads, m);
    indexed_mesh_free(&t->all);
    return is_read;
}
