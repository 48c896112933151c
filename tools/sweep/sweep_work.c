/* sweep_work.c - makes the soups and boxes that a sweep times. */
#include "sweep_work.h"

#include <stdio.h>

#include "console/message.h"

/* Enough for the clock and for the caches; more only takes longer. */
enum { PAIRS = 20000, CELLS_LEAST = 2, CELLS_MOST = 64 };

static int make_box(const char *path, const mesh *m, const tribox_box *box, timing_work *work)
{
    if (!timing_work_make(work, 1, timing_work_room(m->soup.count)))
        return message_failure("%s: out of memory for %zu triangles", path, m->soup.count);
    const timing_job job = timing_work_copy(work, &m->soup, NULL, m->soup.count);
    timing_work_add(work, &job, box);
    return EXIT_CODE_OK;
}

/* The whole mesh against a sample of the cells that hold a part of it. */
static int make_grid(const char *path, const mesh *m, unsigned along, timing_work *work)
{
    const size_t wanted = PAIRS / m->soup.count;
    const size_t cells = wanted < CELLS_LEAST ? CELLS_LEAST : wanted < CELLS_MOST ? wanted : CELLS_MOST;
    const char *const failure = cells_work(&m->soup, along, cells, along, work);
    return failure ? message_failure("%s: %s", path, failure) : EXIT_CODE_OK;
}

static int make_octree(const char *path, const mesh *m, unsigned depth, timing_work *work)
{
    const char *const failure = octree_work(&m->soup, depth, PAIRS, work);
    return failure ? message_failure("%s: %s", path, failure) : EXIT_CODE_OK;
}

int sweep_work_make(const char *path, const mesh *m, sweep_wish *wish, timing_work *work)
{
    if (m->not_finite == m->soup.count)
        return message_failure("%s: no triangle has finite coordinates: there is nothing to time", path);
    if (wish->kind == SWEEP_OCTREE && !wish->depth)
        wish->depth = octree_depth_for(m->soup.count);
    return wish->kind == SWEEP_BOX    ? make_box(path, m, &wish->box, work)
           : wish->kind == SWEEP_GRID ? make_grid(path, m, wish->along, work)
                                      : make_octree(path, m, wish->depth, work);
}

void sweep_work_describe(const sweep_wish *wish, const timing_work *work, char *text, size_t size)
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
