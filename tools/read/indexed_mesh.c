/* indexed_mesh.c - collects vertices and triangles, and cuts polygons into fans, or ear by ear. */
#include "mesh.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/system.h"
#include "console/message.h"

/* Corners that a polygon may have, and that are looked at for each of these: without an end a file could ask for years. */
enum { CORNERS_MAX = 4096, TESTS_MAX = 1000 };

typedef struct point {
    double x, y;
} point;

/* What is left of a polygon, seen along the axis that is closest to its normal, so that it turns to the left. */
typedef struct polygon {
    const indexed_mesh *mesh;
    const uint32_t *face;
    uint32_t *left; /* places in the face */
    size_t count;
    int axes[2];
    size_t tests; /* that may still be done */
} polygon;

static void look_along(const double normal[3], polygon *p)
{
    int axis = 0;
    for (int a = 1; a < 3; a++)
        axis = fabs(normal[a]) > fabs(normal[axis]) ? a : axis;
    const bool is_behind = normal[axis] < 0;
    p->axes[is_behind] = (axis + 1) % 3;
    p->axes[!is_behind] = (axis + 2) % 3;
}

static point corner(const polygon *p, size_t i)
{
    double position[3];
    indexed_mesh_position(p->mesh, p->face[p->left[i % p->count]], position);
    return (point){position[p->axes[0]], position[p->axes[1]]};
}

static bool is_same(point a, point b) { return a.x == b.x && a.y == b.y; }

/* Twice the area of a triangle; positive where it turns to the left. */
static double turn(point a, point b, point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

static bool holds(const point u[3], point p)
{
    if (is_same(p, u[0]) || is_same(p, u[1]) || is_same(p, u[2]))
        return false;
    return turn(u[0], u[1], p) >= 0 && turn(u[1], u[2], p) >= 0 && turn(u[2], u[0], p) >= 0;
}

/* Whether the triangle of corner i and its neighbours is an ear; is_flat: one without area is. */
static bool is_ear(polygon *p, size_t i, bool is_flat)
{
    const size_t n = p->count;
    const point u[3] = {corner(p, i + n - 1), corner(p, i), corner(p, i + 1)};
    p->tests -= p->tests > 0;
    const double area = turn(u[0], u[1], u[2]);
    if (is_flat)
        return area == 0;
    if (!(area > 0))
        return false;
    for (size_t k = i + 2; k < i + n - 1; k++) {
        if (!p->tests)
            return false;
        p->tests--;
        if (holds(u, corner(p, k)))
            return false;
    }
    return true;
}

/* Looks on from where the last ear was. Returns p->count where there is none. */
static size_t find_ear(polygon *p, size_t from)
{
    for (int is_flat = 0; is_flat < 2; is_flat++)
        for (size_t k = 0; k < p->count && p->tests; k++)
            if (is_ear(p, (from + k) % p->count, is_flat))
                return (from + k) % p->count;
    return p->count;
}

static int add(const char *path, const polygon *p, size_t i, indexed_mesh *m)
{
    const size_t n = p->count;
    return indexed_mesh_add_triangle(path, p->face[p->left[(i + n - 1) % n]], p->face[p->left[i]], p->face[p->left[(i + 1) % n]],
                                     m);
}

/*
 * Adds the triangles of m->face, whose corners are vertices that there are, where ears can be cut off until a triangle is left: a
 * polygon that does not cross itself. normal: of its plane, roughly. *is_cut receives whether it did. Returns an exit_code.
 */
static int polygon_ears_cut(const char *path, size_t corners, const double normal[3], indexed_mesh *m, bool *is_cut)
{
    const size_t before = m->triangles;
    *is_cut = false;
    if (corners > CORNERS_MAX)
        return EXIT_CODE_OK;
    int code = indexed_mesh_reserve_face(path, 2 * (uint64_t)corners, m);
    if (code)
        return code;
    polygon p = {.mesh = m, .face = m->face, .left = m->face + corners, .count = corners, .tests = TESTS_MAX * corners};
    size_t ear = 0;
    for (size_t i = 0; i < corners; i++)
        p.left[i] = (uint32_t)i;
    look_along(normal, &p);
    while (!code && p.count > 3 && (ear = find_ear(&p, ear)) < p.count) {
        code = add(path, &p, ear, m);
        p.count--;
        memmove(p.left + ear, p.left + ear + 1, (p.count - ear) * sizeof *p.left);
    }
    *is_cut = p.count == 3;
    if (!code && *is_cut)
        code = add(path, &p, 1, m);
    else
        m->triangles = before;
    return code;
}

/* Corners of a polygon that are tried: with all of them a file could ask for years. */
enum { APEXES_MAX = 64 };

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
    const size_t first = 3 * m->vertices++;
    if (m->position_bytes == sizeof(double))
        memcpy((double *)m->positions + first, position, sizeof(double[3]));
    else
        for (size_t a = 0; a < 3; a++)
            ((float *)m->positions)[first + a] = (float)position[a];
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

int indexed_mesh_add_triangle(const char *path, uint32_t a, uint32_t b, uint32_t c, indexed_mesh *m)
{
    uint32_t *const corners = m->triangles < m->triangles_max
                                  ? m->corners
                                  : memory_grow(m->corners, m->triangles + 1, &m->triangles_max, sizeof(uint32_t[3]));
    if (!corners)
        return message_failure("%s: out of memory for more than %zu triangles", path, m->triangles);
    m->corners = corners;
    memcpy(corners + 3 * m->triangles++, (uint32_t[3]){a, b, c}, sizeof(uint32_t[3]));
    return EXIT_CODE_OK;
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
