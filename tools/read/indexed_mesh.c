/* indexed_mesh.c - collects vertices and triangles, and cuts polygons into fans. */
#include "indexed_mesh.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "polygon_ears.h"

/* Corners of a polygon that are tried: with all of them a file could ask for years. */
enum { APEXES_MAX = 64, TRIANGLES_AT_FIRST = 1024 };

int indexed_mesh_reserve(const char *path, uint64_t vertices, unsigned position_bytes, indexed_mesh *m)
{
    if (vertices > UINT32_MAX)
        return message_failure("%s: %" PRIu64 " vertices, more than 4294967295; split the mesh", path, vertices);
    const size_t bytes = 3 * position_bytes;
    void *const positions = vertices < SIZE_MAX / bytes ? realloc(m->positions, (size_t)(vertices + 1) * bytes) : NULL;
    if (!positions)
        return message_failure("%s: out of memory for %" PRIu64 " vertices", path, vertices);
    m->positions = positions;
    m->position_bytes = position_bytes;
    m->vertices_max = (size_t)vertices;
    return EXIT_CODE_OK;
}

void indexed_mesh_add_vertex(const double position[3], indexed_mesh *m)
{
    memcpy((double *)m->positions + 3 * m->vertices++, position, sizeof(double[3]));
}

void indexed_mesh_add_floats(const float position[3], indexed_mesh *m)
{
    memcpy((float *)m->positions + 3 * m->vertices++, position, sizeof(float[3]));
}

/* In place: number i ends before number i + 1 begins. */
void indexed_mesh_narrow(indexed_mesh *m)
{
    unsigned char *const bytes = m->positions;
    if (m->position_bytes == sizeof(float) || m->fit == FLOAT_FIT_NONE)
        return;
    for (size_t i = 0; i < 3 * m->vertices; i++) {
        double number;
        memcpy(&number, bytes + i * sizeof number, sizeof number);
        const float nearest = (float)number;
        memcpy(bytes + i * sizeof nearest, &nearest, sizeof nearest);
    }
    m->position_bytes = sizeof(float);
}

int indexed_mesh_reserve_face(const char *path, uint64_t corners, indexed_mesh *m)
{
    if (corners <= m->face_max)
        return EXIT_CODE_OK;
    uint32_t *const face = corners <= SIZE_MAX / (2 * sizeof *face) ? realloc(m->face, 2 * (size_t)corners * sizeof *face) : NULL;
    if (!face)
        return message_failure("%s: out of memory for a face with %" PRIu64 " corners", path, corners);
    m->face = face;
    m->face_max = 2 * (size_t)corners;
    return EXIT_CODE_OK;
}

static int grow(const char *path, indexed_mesh *m)
{
    const size_t most = m->triangles_max ? 2 * m->triangles_max : TRIANGLES_AT_FIRST;
    uint32_t *const corners = most <= SIZE_MAX / sizeof(uint32_t[3]) ? realloc(m->corners, most * sizeof(uint32_t[3])) : NULL;
    if (!corners)
        return message_failure("%s: out of memory for more than %zu triangles", path, m->triangles);
    m->corners = corners;
    m->triangles_max = most;
    return EXIT_CODE_OK;
}

int indexed_mesh_add_triangle(const char *path, uint32_t a, uint32_t b, uint32_t c, indexed_mesh *m)
{
    const int code = m->triangles < m->triangles_max ? EXIT_CODE_OK : grow(path, m);
    if (!code)
        memcpy(m->corners + 3 * m->triangles++, (uint32_t[3]){a, b, c}, sizeof(uint32_t[3]));
    return code;
}

typedef struct vector {
    double x, y, z;
} vector;

void indexed_mesh_position(const indexed_mesh *m, uint32_t vertex, double position[3])
{
    const size_t first = 3 * (size_t)vertex;
    const bool is_float = m->position_bytes == sizeof(float);
    for (size_t a = 0; a < 3; a++)
        position[a] = is_float ? (double)((const float *)m->positions)[first + a] : ((const double *)m->positions)[first + a];
}

static vector difference(const indexed_mesh *m, uint32_t to, uint32_t from)
{
    double p[3], q[3];
    indexed_mesh_position(m, to, p);
    indexed_mesh_position(m, from, q);
    return (vector){p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

static double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* Triangle k of the fan around corner `first`: a normal as long as twice its area. */
static vector fan_normal(const indexed_mesh *m, size_t corners, size_t first, size_t k)
{
    const uint32_t *face = m->face, apex = face[first];
    const vector a = difference(m, face[(first + k + 1) % corners], apex), b = difference(m, face[(first + k + 2) % corners], apex);
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* A corner sees all of a polygon where no triangle of its fan is turned over, but for rounding. */
static bool sees_all(const indexed_mesh *m, size_t corners, size_t first, vector normal)
{
    for (size_t k = 0; k + 2 < corners; k++)
        if (dot(fan_normal(m, corners, first, k), normal) < -1e-6 * dot(normal, normal))
            return false;
    return true;
}

/* The sum of a fan's normals, whichever its corner. */
static vector face_normal(const indexed_mesh *m, size_t corners)
{
    vector normal = {0, 0, 0};
    for (size_t k = 0; k + 2 < corners; k++) {
        const vector part = fan_normal(m, corners, 0, k);
        normal = (vector){normal.x + part.x, normal.y + part.y, normal.z + part.z};
    }
    return normal;
}

static bool find_apex(const indexed_mesh *m, size_t corners, vector normal, size_t *apex)
{
    for (*apex = 0; *apex < corners && *apex < APEXES_MAX; ++*apex)
        if (sees_all(m, corners, *apex, normal))
            return true;
    *apex = 0;
    return false;
}

static int add_fan(const char *path, size_t corners, size_t apex, indexed_mesh *m)
{
    const uint32_t *const face = m->face;
    int code = EXIT_CODE_OK;
    for (size_t k = 0; !code && k + 2 < corners; k++)
        code = indexed_mesh_add_triangle(path, face[apex], face[(apex + k + 1) % corners], face[(apex + k + 2) % corners], m);
    return code;
}

static int add_polygon(const char *path, size_t corners, indexed_mesh *m)
{
    const vector n = face_normal(m, corners);
    size_t apex = 0;
    bool is_cut = find_apex(m, corners, n, &apex);
    if (is_cut)
        return add_fan(path, corners, apex, m);
    const int code = polygon_ears_cut(path, corners, (const double[3]){n.x, n.y, n.z}, m, &is_cut);
    if (code || is_cut)
        return code;
    m->miscut++;
    return add_fan(path, corners, 0, m);
}

int indexed_mesh_add_face(const char *path, size_t corners, indexed_mesh *m)
{
    m->left_out += corners == 1 || corners == 2;
    return corners > 3 ? add_polygon(path, corners, m) : add_fan(path, corners, 0, m);
}

void indexed_mesh_free(indexed_mesh *m)
{
    free(m->positions);
    free(m->corners);
    free(m->face);
    *m = (indexed_mesh){.positions = NULL};
}
