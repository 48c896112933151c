/* text_join.c - joins pieces: their vertices get their numbers, their faces become triangles, all by threads. */
#include "text_pieces.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "mesh_look.h"
#include "turns.h"

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
    pthread_mutex_t lock;
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
    return j->positions && turns_run(j->p->file->threads, j->p->count, place_positions, j);
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
    float *to[9];
    mesh_look own = mesh_look_none();
    (void)thread;
    if (!piece->triangles)
        return true;
    mesh_streams(j->m, piece->first_triangle, to);
    if (tribox_mesh_to_soup(&all, NULL, 0, piece->triangles, NULL, to, to + 3, to + 6))
        return false;
    mesh_look_at(j->m, piece->first_triangle, piece->triangles, &own);
    pthread_mutex_lock(&j->lock);
    mesh_look_join(&own, &j->look);
    pthread_mutex_unlock(&j->lock);
    return true;
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
    turns_run(threads, j->p->count, place_corners, j);
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
    if (!turns_run(j->p->file->threads, j->p->count, fill_piece, j))
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
    if (j->has_polygons && !turns_run(threads, j->p->count, cut_piece, j))
        return false;
    return number_triangles(j) && (are_doubles ? make_doubles(j) : make_floats(j));
}

bool text_pieces_join(const text_pieces *p, mesh *m)
{
    joining j = {.p = p, .m = m, .look = mesh_look_none()};
    pthread_mutex_init(&j.lock, NULL);
    const bool is_joined = join(&j);
    pthread_mutex_destroy(&j.lock);
    free(j.positions);
    m->left_out = j.left_out;
    m->miscut = j.miscut;
    return is_joined;
}
