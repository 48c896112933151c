/* text_pieces.c - the lists of a part grow in room for the most that it may have, and are kept in as much as they take. */
#include "text_pieces.h"

#include <stdlib.h>
#include <string.h>

#include "text_parts.h"

bool text_pieces_make(const plain_file *file, size_t count, text_pieces *p)
{
    *p = (text_pieces){.file = file, .count = count};
    p->pieces = calloc(count + 1, sizeof *p->pieces);
    p->scratches = calloc(file->threads, sizeof *p->scratches);
    return p->pieces && p->scratches;
}

static void free_piece(const text_piece *piece)
{
    free(piece->positions);
    free(piece->corners);
    free(piece->sizes);
    free(piece->relatives);
}

void text_pieces_free(text_pieces *p)
{
    for (size_t i = 0; p->pieces && i < p->count; i++)
        free_piece(&p->pieces[i]);
    for (unsigned t = 0; p->scratches && t < p->file->threads; t++)
        free_piece(&p->scratches[t]);
    free(p->pieces);
    free(p->scratches);
}

/* A vertex takes six bytes of text, "0 0 0" and a blank; a corner or a face two, a relative corner three, "-1". */
text_piece *text_pieces_begin(const text_pieces *p, unsigned thread)
{
    text_piece *const s = &p->scratches[thread];
    const size_t bytes = p->file->part_bytes + TEXT_OVERLAP + TEXT_AHEAD;
    if (!s->positions) {
        s->positions = malloc((bytes / 6 + 1) * sizeof(double[3]));
        s->corners = malloc((bytes / 2 + 1) * sizeof *s->corners);
        s->sizes = malloc((bytes / 2 + 1) * sizeof *s->sizes);
        s->relatives = malloc((bytes / 3 + 1) * sizeof *s->relatives);
    }
    if (!s->positions || !s->corners || !s->sizes || !s->relatives)
        return NULL;
    *s = (text_piece){.positions = s->positions, .corners = s->corners, .sizes = s->sizes, .relatives = s->relatives};
    return s;
}

/* NULL without an entry, or without memory. */
static void *copy(const void *from, size_t count, size_t each)
{
    void *const to = count ? malloc(count * each) : NULL;
    return to ? memcpy(to, from, count * each) : NULL;
}

bool text_pieces_keep(const text_pieces *p, size_t part, const text_piece *s)
{
    text_piece *const kept = &p->pieces[part];
    bool are_triangles = true;
    for (size_t i = 0; i < s->faces; i++)
        are_triangles &= s->sizes[i] == 3;
    *kept = *s;
    kept->positions = copy(s->positions, s->vertices, sizeof(double[3]));
    kept->corners = copy(s->corners, s->corner_count, sizeof *s->corners);
    kept->sizes = are_triangles ? NULL : copy(s->sizes, s->faces, sizeof *s->sizes);
    kept->relatives = copy(s->relatives, s->relative_count, sizeof *s->relatives);
    kept->triangles = s->faces;
    return (!s->vertices || kept->positions) && (!s->corner_count || kept->corners) && (are_triangles || kept->sizes) &&
           (!s->relative_count || kept->relatives);
}
