/*
 * text_pieces.c - the lists of a part grow in room for the most that it may have, and are kept in as much as they take. When all
 * are there, their vertices get their numbers, and their faces become triangles, all by threads.
 */
#include "text_pieces.h"

#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "mesh_look.h"
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

/* The mesh on its way. */
typedef struct joining {
    const text_pieces *p;
    mesh *m;
    void *positions;
    bool are_floats;
    size_t vertices, triangles, left_out, miscut;
    float_fit fit;
    bool has_polygons;
    uint32_t *corners; /* of a mesh of doubles */
    mesh_look look;
} joining;

static bool is_relative_sound(const joining *j, const text_piece *piece, const text_relative *r)
{
    const int64_t vertex = (int64_t)piece->first_vertex + r->vertex;
    return vertex >= 0 && vertex < (int64_t)j->vertices;
}

static bool number_vertices(joining *j)
{
    bool is_sound = true;
    for (size_t i = 0; i < j->p->count; i++) {
        text_piece *const piece = &j->p->pieces[i];
        piece->first_vertex = j->vertices;
        j->vertices += piece->vertices;
        j->fit = piece->fit > j->fit ? piece->fit : j->fit;
        j->has_polygons |= piece->sizes != NULL;
    }
    for (size_t i = 0; i < j->p->count && j->vertices <= UINT32_MAX; i++) {
        const text_piece *const piece = &j->p->pieces[i];
        is_sound &= !piece->corner_count || piece->relative_count == piece->corner_count || piece->highest < j->vertices;
        for (size_t k = 0; is_sound && k < piece->relative_count; k++) {
            const text_relative *const r = &piece->relatives[k];
            is_sound = is_relative_sound(j, piece, r);
            piece->corners[r->corner] = (uint32_t)((int64_t)piece->first_vertex + r->vertex);
        }
    }
    return is_sound && j->vertices <= UINT32_MAX;
}

static bool place_positions(void *data, unsigned thread, size_t turn)
{
    const joining *const j = data;
    const text_piece *const piece = &j->p->pieces[turn];
    const size_t first = 3 * piece->first_vertex, count = 3 * piece->vertices;
    (void)thread;
    if (j->are_floats)
        for (size_t i = 0; i < count; i++)
            ((float *)j->positions)[first + i] = (float)piece->positions[i];
    else if (count)
        memcpy((double *)j->positions + first, piece->positions, count * sizeof(double));
    return true;
}

static bool place_all(joining *j, bool are_floats)
{
    j->are_floats = are_floats;
    free(j->positions);
    j->positions = malloc((j->vertices + 1) * 3 * (are_floats ? sizeof(float) : sizeof(double)));
    return j->positions && crew_turns(j->p->file->threads, j->p->count, place_positions, j);
}

static bool cut_faces(const char *path, const text_piece *piece, indexed_mesh *cut)
{
    int code = EXIT_CODE_OK;
    for (size_t i = 0, before = 0; !code && i < piece->faces; before += piece->sizes[i++]) {
        code = indexed_mesh_reserve_face(path, piece->sizes[i], cut);
        if (!code && piece->sizes[i]) /* without any corner there is no array */
            memcpy(cut->face, piece->corners + before, piece->sizes[i] * sizeof *cut->face);
        code = code ? code : indexed_mesh_add_face(path, piece->sizes[i], cut);
    }
    return !code;
}

/* Polygons are cut where their doubles are, before they are rounded. */
static bool cut_piece(void *data, unsigned thread, size_t turn)
{
    const joining *const j = data;
    text_piece *const piece = &j->p->pieces[turn];
    (void)thread;
    if (!piece->sizes)
        return true;
    indexed_mesh cut = {.positions = j->positions, .position_bytes = sizeof(double), .vertices = j->vertices};
    const bool is_cut = cut_faces(j->p->file->path, piece, &cut);
    free(piece->corners);
    piece->corners = cut.corners;
    piece->triangles = cut.triangles;
    piece->left_out += cut.left_out;
    piece->miscut += cut.miscut;
    free(cut.face);
    return is_cut;
}

static bool number_triangles(joining *j)
{
    for (size_t i = 0; i < j->p->count; i++) {
        text_piece *const piece = &j->p->pieces[i];
        piece->first_triangle = j->triangles;
        j->triangles += piece->triangles;
        j->left_out += piece->left_out;
        j->miscut += piece->miscut;
    }
    return j->triangles;
}

static bool fill_piece(void *data, unsigned thread, size_t turn)
{
    joining *const j = data;
    const text_piece *const piece = &j->p->pieces[turn];
    const tribox_mesh all = {.positions = j->positions,
                             .vertices = j->vertices,
                             .indices = piece->corners,
                             .index_bytes = sizeof *piece->corners,
                             .count = piece->triangles};
    (void)thread;
    return !piece->triangles || mesh_look_put(&all, piece->first_triangle, j->m, &j->look);
}

static bool place_corners(void *data, unsigned thread, size_t turn)
{
    const joining *const j = data;
    const text_piece *const piece = &j->p->pieces[turn];
    (void)thread;
    if (piece->triangles)
        memcpy(j->corners + 3 * piece->first_triangle, piece->corners, piece->triangles * sizeof(uint32_t[3]));
    return true;
}

static bool make_doubles(joining *j)
{
    const unsigned threads = j->p->file->threads;
    j->corners = j->triangles <= SIZE_MAX / sizeof(uint32_t[3]) ? malloc(j->triangles * sizeof(uint32_t[3])) : NULL;
    if (!j->corners)
        return false;
    crew_turns(threads, j->p->count, place_corners, j);
    mesh_set_doubles(j->positions, j->vertices, j->corners, j->triangles, j->m);
    j->positions = NULL;
    mesh_look_all(threads, j->m);
    return true;
}

static bool make_floats(joining *j)
{
    if (!mesh_take_room(j->triangles, j->m) || (!j->are_floats && !place_all(j, true)))
        return false;
    j->m->triangles = j->m->soup.count = j->triangles;
    if (!crew_turns(j->p->file->threads, j->p->count, fill_piece, j))
        return false;
    mesh_look_keep(&j->look, j->m);
    return true;
}

static bool join(joining *j)
{
    const unsigned threads = j->p->file->threads;
    if (!number_vertices(j))
        return false;
    const bool are_doubles = j->p->file->is_wide || j->fit == FLOAT_FIT_NONE;
    if (!place_all(j, !are_doubles && !j->has_polygons))
        return false;
    if (j->has_polygons && !crew_turns(threads, j->p->count, cut_piece, j))
        return false;
    return number_triangles(j) && (are_doubles ? make_doubles(j) : make_floats(j));
}

bool text_pieces_join(const text_pieces *p, mesh *m)
{
    joining j = {.p = p, .m = m, .look = mesh_look_none()};
    const bool is_joined = join(&j);
    free(j.positions);
    m->left_out = j.left_out;
    m->miscut = j.miscut;
    return is_joined;
}
