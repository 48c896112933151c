/* sweep_work.c - makes the soups and boxes that a sweep times. */
#include "sweep_work.h"

#include <math.h>
#include <stdio.h>

#include "console/message.h"
#include "order_octree.h"
#include "paper/random.h"

/* Enough for the clock and for the caches; more only takes longer. */
enum { PAIRS = 20000, CELLS_LEAST = 2, CELLS_MOST = 64 };

static bool copy_mesh(const mesh *m, size_t jobs, order_work *work, order_job *job)
{
    if (!order_work_make(work, jobs, order_work_room(m->soup.count)))
        return false;
    *job = order_work_copy(work, &m->soup, NULL, m->soup.count);
    return true;
}

static int make_box(const char *path, const mesh *m, const tribox_box *box, order_work *work)
{
    order_job job;
    if (!copy_mesh(m, 1, work, &job))
        return message_failure("%s: out of memory for %zu triangles", path, m->soup.count);
    job.box = *box;
    order_work_add(work, &job);
    return EXIT_CODE_OK;
}

/* The bounding cube of the finite triangles. */
typedef struct cube {
    double corner[3], size;
} cube;

static bool is_finite(const float t[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            if (!isfinite(t[j][a]))
                return false;
    return true;
}

static cube cube_of(const order_job *job)
{
    cube c = {.corner = {INFINITY, INFINITY, INFINITY}, .size = 0};
    double hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < job->soup.count; i++)
        for (int j = 0; is_finite(job->triangles[i]) && j < 3; j++)
            for (int a = 0; a < 3; a++) {
                c.corner[a] = fmin(c.corner[a], (double)job->triangles[i][j][a]);
                hi[a] = fmax(hi[a], (double)job->triangles[i][j][a]);
            }
    for (int a = 0; a < 3; a++)
        c.size = fmax(c.size, hi[a] - c.corner[a]);
    return c;
}

/* The cell of the grid that holds the middle of a triangle. */
static tribox_box cell_of(const cube *c, unsigned along, const float t[3][3])
{
    tribox_box cell;
    for (int a = 0; a < 3; a++) {
        const double middle = ((double)t[0][a] + (double)t[1][a] + (double)t[2][a]) / 3;
        const double place = c->size > 0 ? floor((middle - c->corner[a]) / c->size * along) : 0;
        const double k = fmin(fmax(place, 0), along - 1.0);
        cell.lo[a] = (float)(c->corner[a] + c->size * k / along);
        cell.hi[a] = (float)(c->corner[a] + c->size * (k + 1) / along);
    }
    return cell;
}

/* The whole mesh against a sample of the cells that hold a part of it. */
static int make_grid(const char *path, const mesh *m, unsigned along, order_work *work)
{
    const size_t wanted = PAIRS / m->soup.count;
    const size_t cells = wanted < CELLS_LEAST ? CELLS_LEAST : wanted < CELLS_MOST ? wanted : CELLS_MOST;
    generator g = {along};
    order_job job;
    if (!copy_mesh(m, cells, work, &job))
        return message_failure("%s: out of memory for %zu triangles", path, m->soup.count);
    const cube c = cube_of(&job);
    while (work->count < cells) {
        const float(*const t)[3] = job.triangles[random_below(&g, m->soup.count)];
        if (!is_finite(t))
            continue;
        job.box = cell_of(&c, along, t);
        order_work_add(work, &job);
    }
    return EXIT_CODE_OK;
}

static int make_octree(const char *path, const mesh *m, unsigned depth, order_work *work)
{
    const char *const failure = octree_work(&m->soup, depth, PAIRS, work);
    return failure ? message_failure("%s: %s", path, failure) : EXIT_CODE_OK;
}

int sweep_work_make(const char *path, const mesh *m, sweep_wish *wish, order_work *work)
{
    if (m->not_finite == m->soup.count)
        return message_failure("%s: no triangle has finite coordinates: there is nothing to time", path);
    if (wish->kind == SWEEP_OCTREE && !wish->depth)
        wish->depth = octree_depth_for(m->soup.count);
    return wish->kind == SWEEP_BOX    ? make_box(path, m, &wish->box, work)
           : wish->kind == SWEEP_GRID ? make_grid(path, m, wish->along, work)
                                      : make_octree(path, m, wish->depth, work);
}

void sweep_work_describe(const sweep_wish *wish, const order_work *work, char *text, size_t size)
{
    if (wish->kind == SWEEP_BOX)
        snprintf(text, size, "all triangles against one box");
    else if (wish->kind == SWEEP_GRID)
        snprintf(text, size, "all triangles against each of %zu cells of a grid, %u along the longest side", work->count,
                 wish->along);
    else
        snprintf(text, size, "%zu leaves of an octree of depth %u, each against the triangles of its parent", work->count,
                 wish->depth);
}
