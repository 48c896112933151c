/* indexed_mesh.c - lists of vertices and faces; cuts polygons into fans, or ear by ear, by threads; and makes a mesh of all. */
#include "mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/system.h"
#include "mesh_file.h"

/* Corners that a polygon may have, and that are looked at for each of these: without an end a file could ask for years. */
enum { CORNERS_MAX = 4096, TESTS_MAX = 1000 };

typedef struct point {
    double x, y;
} point;

/* What is left of a polygon, seen along the axis that is closest to its normal, so that it turns to the left. */
typedef struct polygon {
    const indexed_mesh *mesh;
    const uint32_t *face;
    uint16_t left[CORNERS_MAX]; /* places in the face */
    size_t count;
    int axes[2];
    size_t tests; /* that may still be done */
} polygon;

static void position_of(const indexed_mesh *m, uint32_t vertex, double position[3])
{
    const size_t first = 3 * (size_t)vertex;
    const bool is_float = m->position_bytes == sizeof(float);
    for (size_t a = 0; a < 3; a++)
        position[a] = is_float ? (double)((const float *)m->positions.of)[first + a] : ((const double *)m->positions.of)[first + a];
}

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
    position_of(p->mesh, p->face[p->left[i % p->count]], position);
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

static uint32_t *put_ear(const polygon *p, size_t i, uint32_t *to)
{
    const size_t n = p->count;
    for (size_t v = 0; v < 3; v++)
        *to++ = p->face[p->left[(i + n - 1 + v) % n]];
    return to;
}

/*
 * Cuts ears off until a triangle is left, as it is of a polygon that does not cross itself. normal: of its plane, roughly. False
 * where that fails.
 */
static bool cut_ears(const indexed_mesh *m, const uint32_t *face, size_t corners, const double normal[3], uint32_t *to)
{
    polygon p = {.mesh = m, .face = face, .count = corners, .tests = TESTS_MAX * corners};
    size_t ear = 0;
    if (corners > CORNERS_MAX)
        return false;
    for (size_t i = 0; i < corners; i++)
        p.left[i] = (uint16_t)i;
    look_along(normal, &p);
    while (p.count > 3 && (ear = find_ear(&p, ear)) < p.count) {
        to = put_ear(&p, ear, to);
        p.count--;
        memmove(p.left + ear, p.left + ear + 1, (p.count - ear) * sizeof *p.left);
    }
    put_ear(&p, 1, to);
    return p.count == 3;
}

/* Corners of a polygon that are tried: with all of them a file could ask for years. */
enum { APEXES_MAX = 64 };

typedef struct vector {
    double x, y, z;
} vector;

static vector difference(const indexed_mesh *m, uint32_t to, uint32_t from)
{
    double p[3], q[3];
    position_of(m, to, p);
    position_of(m, from, q);
    return (vector){p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

static double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* Triangle k of the fan around corner `first`: a normal as long as twice its area. */
static vector fan_normal(const indexed_mesh *m, const uint32_t *face, size_t corners, size_t first, size_t k)
{
    const uint32_t apex = face[first];
    const vector a = difference(m, face[(first + k + 1) % corners], apex), b = difference(m, face[(first + k + 2) % corners], apex);
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* A corner sees all of a polygon where no triangle of its fan is turned over, but for rounding. */
static bool sees_all(const indexed_mesh *m, const uint32_t *face, size_t corners, size_t first, vector normal)
{
    for (size_t k = 0; k + 2 < corners; k++)
        if (dot(fan_normal(m, face, corners, first, k), normal) < -1e-6 * dot(normal, normal))
            return false;
    return true;
}

/* The sum of a fan's normals, whichever its corner. */
static vector face_normal(const indexed_mesh *m, const uint32_t *face, size_t corners)
{
    vector normal = {0, 0, 0};
    for (size_t k = 0; k + 2 < corners; k++) {
        const vector part = fan_normal(m, face, corners, 0, k);
        normal = (vector){normal.x + part.x, normal.y + part.y, normal.z + part.z};
    }
    return normal;
}

static bool find_apex(const indexed_mesh *m, const uint32_t *face, size_t corners, vector normal, size_t *apex)
{
    for (*apex = 0; *apex < corners && *apex < APEXES_MAX; ++*apex)
        if (sees_all(m, face, corners, *apex, normal))
            return true;
    *apex = 0;
    return false;
}

bool polygon_cut(const indexed_mesh *m, const uint32_t *face, size_t corners, uint32_t *triangles)
{
    size_t apex = 0;
    bool is_cut = corners <= 3;
    if (!is_cut) {
        const vector n = face_normal(m, face, corners);
        is_cut = find_apex(m, face, corners, n, &apex);
        if (!is_cut && cut_ears(m, face, corners, (const double[3]){n.x, n.y, n.z}, triangles))
            return true;
    }
    for (size_t k = 1; k + 1 < corners; k++, triangles += 3) {
        triangles[0] = face[apex];
        triangles[1] = face[(apex + k) % corners];
        triangles[2] = face[(apex + k + 1) % corners];
    }
    return is_cut;
}

void *page_list_add(size_t count, size_t each, page_list *list)
{
    const bool has_room = list->of && count <= list->room - list->count;
    void *const of = has_room ? list->of : memory_grow_pages(list->of, list->count + count, &list->room, each);
    if (!of)
        return NULL;
    list->of = of;
    list->count += count;
    return (char *)of + (list->count - count) * each;
}

/* Faces that follow each other, and how many corners and triangles come before them. */
typedef struct face_block {
    size_t first, count, corner, triangle, miscut;
} face_block;

typedef struct cutting {
    indexed_mesh *m;
    uint32_t *triangles;
    face_block next;
} cutting;

static size_t triangles_of(uint32_t size) { return size > 2 ? size - 2 : 0; }

static bool find_block(void *data, void *place, size_t n)
{
    enum { MOST = 2048 };
    cutting *const c = data;
    face_block *const b = &c->next;
    (void)n;
    const uint32_t *const sizes = c->m->sizes.of;
    b->first += b->count;
    const size_t left = c->m->sizes.count - b->first;
    b->count = left < MOST ? left : MOST;
    *(face_block *)place = *b;
    for (size_t i = b->first; i < b->first + b->count; i++) {
        b->corner += sizes[i];
        b->triangle += triangles_of(sizes[i]);
    }
    return b->count;
}

static int cut_block(void *data, void *place, size_t n)
{
    const cutting *const c = data;
    face_block *const b = place;
    const uint32_t *const sizes = (const uint32_t *)c->m->sizes.of + b->first,
                          *face = (const uint32_t *)c->m->corners.of + b->corner;
    uint32_t *to = c->triangles + 3 * b->triangle;
    (void)n;
    for (size_t i = 0; i < b->count; i++) {
        b->miscut += !polygon_cut(c->m, face, sizes[i], to);
        face += sizes[i];
        to += 3 * triangles_of(sizes[i]);
    }
    return 0;
}

static int tell_block(void *data, void *place, size_t n)
{
    (void)n;
    ((cutting *)data)->m->miscut += ((const face_block *)place)->miscut;
    return 0;
}

bool indexed_mesh_cut(unsigned threads, indexed_mesh *m)
{
    const uint32_t *const sizes = m->sizes.of;
    size_t triangles = 0, others = 0;
    for (size_t i = 0; i < m->sizes.count; i++) {
        triangles += triangles_of(sizes[i]);
        others += sizes[i] != 3;
        m->left_out += sizes[i] == 1 || sizes[i] == 2;
    }
    page_list cut = {.of = NULL};
    cutting c = {.m = m, .triangles = others ? page_list_add(3 * triangles, sizeof *c.triangles, &cut) : NULL};
    const crew_work work = {
        .threads = threads, .place_bytes = sizeof(face_block), .find = find_block, .step = cut_block, .tell = tell_block};
    if (!others)
        return true;
    const bool is_cut = c.triangles && !crew_do(&work, &c);
    pages_free(m->corners.of, m->corners.room * sizeof *c.triangles);
    m->corners = cut;
    return is_cut;
}

/* Lists of doubles go over to the mesh. */
static void take_doubles(indexed_mesh *from, size_t triangles, unsigned threads, mesh *m)
{
    mesh_set_doubles(from->positions.of, from->positions.count, from->is_soup ? NULL : from->corners.of, triangles, m);
    m->position_room = from->positions.room * sizeof(double[3]);
    from->positions = (page_list){.of = NULL};
    if (!from->is_soup) {
        m->corner_room = from->corners.room * sizeof(uint32_t);
        from->corners = (page_list){.of = NULL};
    }
    mesh_look_all(NULL, threads, m);
}

int mesh_take(const char *path, indexed_mesh *from, bool is_wide, unsigned threads, mesh *m)
{
    const bool are_doubles = from->position_bytes == sizeof(double) && (is_wide || from->fit == FLOAT_FIT_NONE);
    bool is_taken = from->is_soup || indexed_mesh_cut(threads, from);
    const tribox_mesh all = {.positions = from->positions.of,
                             .vertices = from->positions.count,
                             .indices = from->is_soup ? NULL : from->corners.of,
                             .index_bytes = sizeof(uint32_t),
                             .count = (from->is_soup ? from->positions.count : from->corners.count) / 3,
                             .position_bytes = from->position_bytes};
    m->left_out = from->left_out;
    m->miscut = from->miscut;
    if (is_taken && (!all.count || !are_doubles)) {
        const int code = mesh_make_room(path, all.count, m);
        if (code)
            return code;
        is_taken = mesh_look_all(&all, threads, m);
    } else if (is_taken) {
        take_doubles(from, all.count, threads, m);
    }
    return is_taken || !path ? !is_taken : message_failure("%s: out of memory for its triangles" MESH_TO_SORT, path);
}

void indexed_mesh_free(indexed_mesh *m)
{
    pages_free(m->positions.of, m->positions.room * 3 * m->position_bytes);
    pages_free(m->corners.of, m->corners.room * sizeof(uint32_t));
    pages_free(m->sizes.of, m->sizes.room * sizeof(uint32_t));
    *m = (indexed_mesh){.position_bytes = 0};
}
