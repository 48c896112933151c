/* polygon_ears.c - ears are corners whose triangle holds no other corner; those that are left stay in their order. */
#include "polygon_ears.h"

#include <math.h>
#include <string.h>

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

int polygon_ears_cut(const char *path, size_t corners, const double normal[3], indexed_mesh *m, bool *is_cut)
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
