/*
 * mesh_look.c - the forms of a mesh, floats on large pages or doubles; looks at them in lanes, eight triangles at once, and one by
 * one only where some are not finite; and says what a user should know of it.
 */
#include "mesh.h"

#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/system.h"

enum { TRIANGLE_BYTES = 9 * sizeof(float) };

void mesh_streams(const mesh *m, size_t first, float *to[9])
{
    for (size_t k = 0; k < 9; k++)
        to[k] = m->coordinates + k * m->capacity + first;
}

int mesh_make_room(const char *path, uint64_t count, mesh *m)
{
    if (!count)
        return path ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
    float *const coordinates = count <= SIZE_MAX / TRIANGLE_BYTES ? pages_take((size_t)count * TRIANGLE_BYTES) : NULL;
    if (!coordinates)
        return !path ? EXIT_CODE_FAILURE : message_failure("%s: out of memory for %" PRIu64 " triangles" MESH_TO_SORT, path, count);
    m->coordinates = coordinates;
    m->capacity = (size_t)count;
    m->soup = soup_of_streams(coordinates, m->capacity, m->soup.count);
    return EXIT_CODE_OK;
}

void mesh_drop_floats(mesh *m)
{
    pages_free(m->coordinates, m->capacity * TRIANGLE_BYTES);
    m->coordinates = NULL;
    m->capacity = 0;
    m->soup = (tribox_soup){.count = 0};
}

static void give_back(void *of, size_t room)
{
    if (room)
        pages_free(of, room);
    else
        free(of);
}

void mesh_drop_corners(mesh *m)
{
    give_back(m->corners, m->corner_room);
    m->corners = NULL;
    m->corner_room = 0;
}

void mesh_drop_doubles(mesh *m)
{
    mesh_drop_corners(m);
    give_back(m->positions, m->position_room);
    m->positions = NULL;
    m->position_room = 0;
    m->is_double = false;
}

void mesh_free(mesh *m)
{
    mesh_drop_floats(m);
    mesh_drop_doubles(m);
    free(m->opened);
    *m = (mesh){.coordinates = NULL};
}

void mesh_set_doubles(double *positions, size_t vertices, uint32_t *corners, size_t triangles, mesh *m)
{
    mesh_drop_floats(m);
    m->positions = positions;
    m->corners = corners;
    m->is_double = true;
    m->triangles = triangles;
    m->doubles = (tribox_mesh){.positions = positions,
                               .vertices = vertices,
                               .indices = corners,
                               .index_bytes = sizeof *corners,
                               .count = triangles,
                               .position_bytes = sizeof *positions};
}

void mesh_warn_not_finite(const char *path, uint64_t not_finite, uint64_t count, uint64_t first)
{
    if (not_finite)
        message_say("warning: %s: %" PRIu64 " of %" PRIu64
                    " triangles have NaN or infinite coordinates and overlap nothing; the first is number %" PRIu64,
                    path, not_finite, count, first);
}

void mesh_warn_rounded(const char *path, const mesh *m)
{
    if (m->rounded)
        message_say("warning: %s: rounding to float moved coordinates of %zu vert%s by up to %.2g", path, m->rounded,
                    m->rounded == 1 ? "ex" : "ices", m->moved);
}

void mesh_warn(const char *path, const mesh *m)
{
    mesh_warn_not_finite(path, m->seen.not_finite, m->triangles, m->seen.first_not_finite);
    mesh_warn_rounded(path, m);
    if (m->uncut)
        message_say("warning: %s: %zu of %zu triangles are missing: libassimp cannot cut polygons that cross themselves", path,
                    m->uncut, m->triangles + m->uncut);
    if (m->miscut)
        message_say("warning: %s: %zu polygon%s cannot be cut well, so the triangles cover too much; triangulate the mesh first",
                    path, m->miscut, m->miscut == 1 ? "" : "s");
}

enum { LANES = 8, BLOCK = 4096 };

typedef struct lanes {
    float lo[LANES], hi[LANES], sound[LANES]; /* sound: 0, or NaN where something is not finite */
} lanes;

const triangles_seen no_triangles_seen = {.first_not_finite = UINT64_MAX,
                                          .bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};

void triangles_seen_add(const triangles_seen *from, triangles_seen *to)
{
    to->not_finite += from->not_finite;
    to->first_not_finite = from->first_not_finite < to->first_not_finite ? from->first_not_finite : to->first_not_finite;
    for (int a = 0; a < 3; a++) {
        to->bounds.lo[a] = least_number(to->bounds.lo[a], from->bounds.lo[a]);
        to->bounds.hi[a] = most_number(to->bounds.hi[a], from->bounds.hi[a]);
    }
}

void mesh_look_begin(mesh *m) { m->seen = no_triangles_seen; }

static void look_at_each(const mesh *m, size_t first, size_t count, triangles_seen *look)
{
    for (size_t t = first; t < first + count; t++) {
        double u[9];
        mesh_triangle(m, t, u);
        triangles_see(t, u, look);
    }
}

static void look_at_stream(const float *numbers, size_t count, lanes *found)
{
    lanes l = *found;
    for (size_t i = 0; i + LANES <= count; i += LANES)
        for (int k = 0; k < LANES; k++) {
            const float number = numbers[i + (size_t)k];
            l.lo[k] = number < l.lo[k] ? number : l.lo[k];
            l.hi[k] = number > l.hi[k] ? number : l.hi[k];
            l.sound[k] += number * 0;
        }
    *found = l;
}

/* Returns false, with nothing added, where something is not finite. count: a multiple of LANES. */
static bool look_in_lanes(const mesh *m, size_t first, size_t count, triangles_seen *look)
{
    const float *const *const streams[3] = {m->soup.x, m->soup.y, m->soup.z};
    lanes axes[3];
    float sound = 0;
    for (int a = 0; a < 3; a++) {
        for (int k = 0; k < LANES; k++) {
            axes[a].lo[k] = INFINITY;
            axes[a].hi[k] = -INFINITY;
            axes[a].sound[k] = 0;
        }
        for (int v = 0; v < 3; v++)
            look_at_stream(streams[a][v] + first, count, &axes[a]);
        for (int k = 0; k < LANES; k++)
            sound += axes[a].sound[k];
    }
    for (int a = 0; sound == 0 && a < 3; a++)
        for (int k = 0; k < LANES; k++) {
            look->bounds.lo[a] = least_number(look->bounds.lo[a], (double)axes[a].lo[k]);
            look->bounds.hi[a] = most_number(look->bounds.hi[a], (double)axes[a].hi[k]);
        }
    return sound == 0;
}

void mesh_look_add(size_t first, size_t count, mesh *m)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of what meshes have, whichever it is */
    const size_t whole = m->is_double ? 0 : count / LANES * LANES;
    triangles_seen own = no_triangles_seen;
    const size_t done = whole && look_in_lanes(m, first, whole, &own) ? whole : 0;
    look_at_each(m, first + done, count - done, &own);
    pthread_mutex_lock(&lock);
    triangles_seen_add(&own, &m->seen);
    pthread_mutex_unlock(&lock);
}

bool mesh_look_put(const tribox_mesh *from, size_t begin, size_t count, size_t first, mesh *m)
{
    float *to[9];
    mesh_streams(m, first, to);
    if (tribox_mesh_to_soup(from, NULL, begin, count, NULL, to, to + 3, to + 6))
        return false;
    mesh_look_add(first, count, m);
    return true;
}

/* 0 and -0 are equal, and which of them comes first in the mesh is what counts, whichever thread met it. */
static double first_zero(const mesh *m, int axis)
{
    for (size_t t = 0; t < m->triangles; t++) {
        double u[9];
        mesh_triangle(m, t, u);
        for (int c = axis; c < 9; c += 3)
            if (u[c] == 0 && triangle_is_finite(u))
                return u[c];
    }
    return 0;
}

void mesh_look_end(mesh *m)
{
    m->seen.first_not_finite = m->seen.not_finite ? m->seen.first_not_finite : m->triangles;
    for (int a = 0; a < 3; a++) {
        if (m->seen.bounds.lo[a] == 0)
            m->seen.bounds.lo[a] = first_zero(m, a);
        if (m->seen.bounds.hi[a] == 0)
            m->seen.bounds.hi[a] = first_zero(m, a);
    }
}

typedef struct looking {
    const tribox_mesh *from; /* that the streams are filled with; NULL: they are as they will be */
    mesh *m;
} looking;

static int look_at_block(void *data, void *place, size_t n)
{
    const looking *const l = data;
    const size_t first = n * BLOCK, left = l->m->triangles - first, count = left < BLOCK ? left : BLOCK;
    (void)place;
    if (l->from)
        return !mesh_look_put(l->from, first, count, first, l->m);
    mesh_look_add(first, count, l->m);
    return 0;
}

bool mesh_look_all(const tribox_mesh *from, unsigned threads, mesh *m)
{
    m->triangles = from ? from->count : m->triangles;
    m->soup.count = from ? from->count : m->soup.count;
    const crew_work work = {.threads = threads, .count = (m->triangles + BLOCK - 1) / BLOCK, .step = look_at_block};
    mesh_look_begin(m);
    const bool is_done = !crew_do(&work, &(looking){from, m});
    mesh_look_end(m);
    return is_done;
}
