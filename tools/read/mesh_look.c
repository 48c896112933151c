/* mesh_look.c - looks at floats in lanes, eight triangles at once, and one by one only where some are not finite. */
#include "mesh.h"

#include <math.h>
#include <pthread.h>

#include "console/crew.h"

enum { LANES = 8, BLOCK = 4096 };

typedef struct lanes {
    float lo[LANES], hi[LANES], sound[LANES]; /* sound: 0, or NaN where something is not finite */
} lanes;

mesh_look mesh_look_none(void)
{
    return (mesh_look){.first = SIZE_MAX, .bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};
}

static void add_number(double number, int axis, tribox_box *bounds)
{
    bounds->lo[axis] = number < bounds->lo[axis] ? number : bounds->lo[axis];
    bounds->hi[axis] = number > bounds->hi[axis] ? number : bounds->hi[axis];
}

static bool is_finite_nine(const double u[9])
{
    bool is_finite = true;
    for (int c = 0; c < 9; c++)
        is_finite &= isfinite(u[c]) != 0;
    return is_finite;
}

static void look_at_each(const mesh *m, size_t first, size_t count, mesh_look *look)
{
    for (size_t t = first; t < first + count; t++) {
        double u[9];
        mesh_triangle(m, t, u);
        if (!is_finite_nine(u)) {
            look->not_finite++;
            look->first = t < look->first ? t : look->first;
            continue;
        }
        for (int c = 0; c < 9; c++)
            add_number(u[c], c % 3, &look->bounds);
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
static bool look_in_lanes(const mesh *m, size_t first, size_t count, mesh_look *look)
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
            add_number((double)axes[a].lo[k], a, &look->bounds);
            add_number((double)axes[a].hi[k], a, &look->bounds);
        }
    return sound == 0;
}

void mesh_look_at(const mesh *m, size_t first, size_t count, mesh_look *look)
{
    const size_t whole = m->is_double ? 0 : count / LANES * LANES;
    const size_t done = whole && look_in_lanes(m, first, whole, look) ? whole : 0;
    look_at_each(m, first + done, count - done, look);
}

void mesh_look_add(const mesh *m, size_t first, size_t count, mesh_look *all)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of `all`, whichever it is */
    mesh_look own = mesh_look_none();
    mesh_look_at(m, first, count, &own);
    pthread_mutex_lock(&lock);
    all->not_finite += own.not_finite;
    all->first = own.first < all->first ? own.first : all->first;
    for (int a = 0; a < 3 && own.bounds.lo[0] <= own.bounds.hi[0]; a++) {
        add_number(own.bounds.lo[a], a, &all->bounds);
        add_number(own.bounds.hi[a], a, &all->bounds);
    }
    pthread_mutex_unlock(&lock);
}

bool mesh_look_put(const tribox_mesh *from, size_t begin, size_t count, size_t first, mesh *m, mesh_look *all)
{
    float *to[9];
    mesh_streams(m, first, to);
    if (tribox_mesh_to_soup(from, NULL, begin, count, NULL, to, to + 3, to + 6))
        return false;
    mesh_look_add(m, first, count, all);
    return true;
}

/* 0 and -0 are equal, and which of them comes first in the mesh is what counts, whichever thread met it. */
static double first_zero(const mesh *m, int axis)
{
    for (size_t t = 0; t < m->triangles; t++) {
        double u[9];
        mesh_triangle(m, t, u);
        for (int c = axis; c < 9; c += 3)
            if (u[c] == 0 && is_finite_nine(u))
                return u[c];
    }
    return 0;
}

void mesh_look_keep(const mesh_look *all, mesh *m)
{
    m->not_finite = all->not_finite;
    m->first_not_finite = all->not_finite ? all->first : m->triangles;
    m->bounds = all->bounds;
    for (int a = 0; a < 3; a++) {
        if (m->bounds.lo[a] == 0)
            m->bounds.lo[a] = first_zero(m, a);
        if (m->bounds.hi[a] == 0)
            m->bounds.hi[a] = first_zero(m, a);
    }
}

typedef struct looking {
    const tribox_mesh *from; /* that the streams are filled with; NULL: they are as they will be */
    mesh *m;
    mesh_look all;
} looking;

static int look_at_block(void *data, void *place, size_t n)
{
    looking *const l = data;
    const size_t first = n * BLOCK, left = l->m->triangles - first, count = left < BLOCK ? left : BLOCK;
    (void)place;
    if (l->from)
        return !mesh_look_put(l->from, first, count, first, l->m, &l->all);
    mesh_look_add(l->m, first, count, &l->all);
    return 0;
}

static bool look_by_threads(const tribox_mesh *from, unsigned threads, mesh *m)
{
    looking l = {.from = from, .m = m, .all = mesh_look_none()};
    const crew_work work = {.threads = threads, .count = (m->triangles + BLOCK - 1) / BLOCK, .step = look_at_block};
    const bool is_done = !crew_do(&work, &l);
    mesh_look_keep(&l.all, m);
    return is_done;
}

void mesh_look_all(unsigned threads, mesh *m) { look_by_threads(NULL, threads, m); }

bool mesh_fill(const tribox_mesh *from, unsigned threads, mesh *m)
{
    m->triangles = m->soup.count = from->count;
    return look_by_threads(from, threads, m);
}

bool mesh_take(indexed_mesh *from, bool is_wide, unsigned threads, mesh *m)
{
    const tribox_mesh all = {.positions = from->positions,
                             .vertices = from->vertices,
                             .indices = from->corners,
                             .index_bytes = sizeof *from->corners,
                             .count = from->triangles,
                             .position_bytes = from->position_bytes};
    m->left_out = from->left_out;
    m->miscut = from->miscut;
    if (from->position_bytes == sizeof(float) || (!is_wide && from->fit != FLOAT_FIT_NONE))
        return mesh_take_room(from->triangles, m) && mesh_fill(&all, threads, m);
    mesh_set_doubles(from->positions, from->vertices, from->corners, from->triangles, m);
    from->positions = from->corners = NULL;
    mesh_look_all(threads, m);
    return true;
}
