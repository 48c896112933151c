/* mesh.c - finds the reader of a file, and turns what it reads into streams. */
#define _POSIX_C_SOURCE 200809L
#include "mesh.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "console/message.h"
#include "double_triangles.h"
#include "mesh_doubles.h"
#include "readers.h"
#include "words.h"

typedef int reader(const char *path, const whole_file *file, indexed_mesh *m);

static const struct {
    const char *word, *ending;
    reader *read;
} formats[] = {{"ply", ".ply", read_ply}, {"off", ".off", read_off}, {"solid", ".stl", read_stl_text}, {"", ".obj", read_obj}};
enum { FORMATS = sizeof formats / sizeof formats[0] };

static bool has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), size = strlen(ending);
    return length >= size && !strcasecmp(path + length - size, ending);
}

/* What a file says of itself counts for more than its name. NULL: libassimp may know it. */
static reader *find_reader(const char *path, const whole_file *file)
{
    words first = words_of(path, file, '#');
    words_next(&first);
    for (int i = 0; i < FORMATS; i++)
        if (first.length && words_is(&first, formats[i].word))
            return formats[i].read;
    for (int i = 0; i < FORMATS; i++)
        if (has_ending(path, formats[i].ending))
            return formats[i].read;
    return NULL;
}

static void point_streams(mesh *m)
{
    for (size_t v = 0; v < 3; v++) {
        m->soup.x[v] = m->coordinates + v * m->capacity;
        m->soup.y[v] = m->coordinates + (3 + v) * m->capacity;
        m->soup.z[v] = m->coordinates + (6 + v) * m->capacity;
    }
}

static int refuse_none(const char *path)
{
    return message_failure("%s: contains no triangles (points or lines at most); give a mesh with faces", path);
}

int mesh_make_room(const char *path, uint64_t count, mesh *m)
{
    if (!count)
        return refuse_none(path);
    m->coordinates = count <= SIZE_MAX / (9 * sizeof(float)) ? malloc(9 * (size_t)count * sizeof(float)) : NULL;
    if (!m->coordinates)
        return message_failure("%s: out of memory for %" PRIu64 " triangles", path, count);
    m->capacity = (size_t)count;
    point_streams(m);
    return EXIT_CODE_OK;
}

/* Where the next triangles go: x of the three vertices, then y, then z. */
static void find_streams(const mesh *m, float *to[9])
{
    for (size_t k = 0; k < 9; k++)
        to[k] = m->coordinates + k * m->capacity + m->soup.count;
}

static int take_floats(const char *path, const tribox_mesh *all, mesh *m)
{
    float *to[9];
    const int code = mesh_make_room(path, all->count, m);
    if (code)
        return code;
    find_streams(m, to);
    const tribox_status status = tribox_mesh_to_soup(all, NULL, 0, all->count, NULL, to, to + 3, to + 6);
    m->soup.count = all->count;
    return status ? message_failure("%s: %s", path, tribox_status_text(status)) : EXIT_CODE_OK;
}

static int take_doubles(const char *path, indexed_mesh *from, mesh *m)
{
    if (!from->triangles)
        return refuse_none(path);
    mesh_set_doubles(from->positions, from->vertices, from->corners, from->triangles, m);
    from->positions = NULL;
    from->corners = NULL;
    return EXIT_CODE_OK;
}

static int take_indexed(const char *path, bool is_wide, indexed_mesh *from, mesh *m)
{
    if (!is_wide)
        indexed_mesh_narrow(from);
    m->left_out = from->left_out;
    m->miscut = from->miscut;
    if (from->position_bytes == sizeof(double))
        return take_doubles(path, from, m);
    const tribox_mesh all = {.positions = from->positions,
                             .vertices = from->vertices,
                             .indices = from->corners,
                             .index_bytes = sizeof *from->corners,
                             .count = from->triangles};
    return take_floats(path, &all, m);
}

int mesh_to_floats(const char *path, const double origin[3], mesh *m)
{
    if (!m->is_double)
        return EXIT_CODE_OK;
    tribox_mesh all = m->doubles;
    mesh_round(origin, m);
    all.position_bytes = sizeof(float);
    all.stride = 0;
    const int code = take_floats(path, &all, m);
    free(m->positions);
    free(m->corners);
    m->positions = m->corners = NULL;
    m->is_double = false;
    m->not_finite = tribox_soup_not_finite(&m->soup, &m->first_not_finite);
    return code;
}

static int read_whole(const char *path, bool is_wide, mesh *m)
{
    whole_file file;
    indexed_mesh indexed = {.positions = NULL};
    int code = whole_file_read(path, &file);
    reader *const read = code ? NULL : find_reader(path, &file);
    if (read)
        code = read(path, &file, &indexed);
    whole_file_free(&file);
    if (!code)
        code = read ? take_indexed(path, is_wide, &indexed, m) : read_by_assimp(path, m);
    indexed_mesh_free(&indexed);
    return code;
}

/* Doubles the room for a stream of unknown length. What its header promises is not believed. */
static int make_more_room(const char *name, mesh *m)
{
    enum { TRIANGLE_BYTES = 9 * sizeof(float) };
    uint64_t capacity;
    const int code = triangles_more_room(name, m->soup.count, m->capacity, TRIANGLE_BYTES, &capacity);
    if (code)
        return code;
    float *const grown = realloc(m->coordinates, (size_t)capacity * TRIANGLE_BYTES);
    if (!grown)
        return message_failure("%s: out of memory after %zu triangles", name, m->soup.count);
    for (size_t k = 8; k > 0; k--)
        memmove(grown + k * capacity, grown + k * m->capacity, m->soup.count * sizeof *grown);
    m->coordinates = grown;
    m->capacity = (size_t)capacity;
    point_streams(m);
    return EXIT_CODE_OK;
}

static int read_float_triangles(triangle_file *file, mesh *m)
{
    int code = file->is_sized ? mesh_make_room(file->name, file->promised, m) : EXIT_CODE_OK;
    size_t count = 1;
    while (!code && count) {
        float *to[9];
        if (!file->is_sized && m->capacity - m->soup.count < TRIANGLE_BLOCK)
            code = make_more_room(file->name, m);
        if (code)
            break;
        find_streams(m, to);
        code = triangle_file_next(file, to, &count);
        m->soup.count += count;
    }
    return code || m->soup.count ? code : message_failure("%s: contains no triangles", file->name);
}

static int read_triangles(triangle_file *file, mesh *m)
{
    double_triangles found;
    if (file->format != TRIANGLES_F64)
        return read_float_triangles(file, m);
    const int code = double_triangles_read(file, &found);
    if (!code)
        mesh_set_doubles(found.positions, 3 * found.count, NULL, found.count, m);
    return code;
}

static int read_mesh(const char *path, triangle_format format, bool is_wide, mesh *m)
{
    triangle_file file;
    *m = (mesh){.coordinates = NULL};
    int code = triangle_file_open(path, format, &file);
    if (!code)
        code = file.stream ? read_triangles(&file, m) : read_whole(path, is_wide, m);
    triangle_file_close(&file);
    if (code) {
        mesh_free(m);
        return code;
    }
    m->triangles = m->is_double ? m->doubles.count : m->soup.count;
    m->not_finite =
        m->is_double ? mesh_doubles_not_finite(m, &m->first_not_finite) : tribox_soup_not_finite(&m->soup, &m->first_not_finite);
    return EXIT_CODE_OK;
}

int mesh_read_as(const char *path, triangle_format format, mesh *m) { return read_mesh(path, format, false, m); }

int mesh_read_wide(const char *path, triangle_format format, mesh *m) { return read_mesh(path, format, true, m); }

int mesh_read(const char *path, mesh *m)
{
    int code = mesh_read_as(path, TRIANGLES_OTHER, m);
    if (code)
        return code;
    code = mesh_to_floats(path, (const double[3]){0, 0, 0}, m);
    if (code)
        mesh_free(m);
    return code;
}

void mesh_free(mesh *m)
{
    free(m->coordinates);
    free(m->positions);
    free(m->corners);
    *m = (mesh){.coordinates = NULL};
}
