/* sweep_work.c - makes the soups and boxes that a sweep times: one box, cells that a mesh overlaps, or the leaves of an octree. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "sweep.h"

/* Enough for the clock and for the caches; more only takes longer. */
enum { PAIRS = 20000, CELLS_LEAST = 2, CELLS_MOST = 64, CHILDREN = 8 };

static bool is_finite(const tribox_soup *soup, size_t i)
{
    for (int j = 0; j < 3; j++)
        if (!isfinite(soup->x[j][i]) || !isfinite(soup->y[j][i]) || !isfinite(soup->z[j][i]))
            return false;
    return true;
}

/* The cube about all finite triangles. */
static tribox_box cube_over(const tribox_soup *soup)
{
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    tribox_box all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    double side = 0;
    for (size_t i = 0; i < soup->count; i++)
        for (int k = 0; is_finite(soup, i) && k < 9; k++) {
            all.lo[k % 3] = fmin(all.lo[k % 3], (double)streams[k % 3][k / 3][i]);
            all.hi[k % 3] = fmax(all.hi[k % 3], (double)streams[k % 3][k / 3][i]);
        }
    for (int a = 0; a < 3; a++)
        side = fmax(side, all.hi[a] - all.lo[a]);
    for (int a = 0; a < 3; a++)
        all.hi[a] = all.lo[a] + side;
    return all;
}

/* ---- cells of a grid --------------------------------------------------------------------------------------------------------- */

/* Plane k on an axis, of `along` cells: one number for the two cells that share it. */
static float plane_at(const tribox_box *over, int a, unsigned along, unsigned k)
{
    return (float)(over->lo[a] + (over->hi[a] - over->lo[a]) * k / along);
}

/* Uniform in a triangle: a point of a parallelogram, folded back over its diagonal. */
static tribox_box cell_of_random_point(const tribox_box *over, unsigned along, const float t[3][3], generator *g)
{
    double s = (double)random_between(g, 0, 1), r = (double)random_between(g, 0, 1);
    tribox_box cell;
    if (s + r > 1) {
        s = 1 - s;
        r = 1 - r;
    }
    for (int a = 0; a < 3; a++) {
        const double first = (double)t[0][a], point = first + s * ((double)t[1][a] - first) + r * ((double)t[2][a] - first);
        const double side = over->hi[a] - over->lo[a], place = side > 0 ? floor((point - over->lo[a]) / side * along) : 0;
        const unsigned k = (unsigned)fmin(fmax(place, 0), along - 1.0);
        cell.lo[a] = plane_at(over, a, along, k);
        cell.hi[a] = plane_at(over, a, along, k + 1);
    }
    return cell;
}

static bool is_new(const timing_work *work, const tribox_box *cell)
{
    for (size_t c = 0; c < work->count; c++)
        if (!memcmp(&work->jobs[c].box, cell, sizeof *cell))
            return false;
    return true;
}

/* The point is rounded to a cell, which it may miss by that. */
static bool holds_triangle(const tribox_soup *soup, const tribox_box *cell)
{
    size_t first;
    return tribox_find(soup, cell, NULL, TRIBOX_FIRST_HIT, &first) == TRIBOX_OK && first < soup->count;
}

/*
 * Divides the cube into `along` cells on each axis, and makes a job of the whole soup for each of up to `most` different cells: a
 * random point of a random triangle picks the cell that holds it. The leaves of an octree of depth d are those of along = 2^d.
 */
static const char *make_cells(const tribox_soup *soup, unsigned along, timing_work *work)
{
    const size_t wanted = PAIRS / soup->count, most = wanted < CELLS_LEAST  ? CELLS_LEAST
                                                      : wanted < CELLS_MOST ? wanted
                                                                            : CELLS_MOST;
    const tribox_box over = cube_over(soup);
    generator g = {along};
    if (!timing_work_make(work, most, timing_work_room(soup->count)))
        return "out of memory for its triangles";
    const timing_job job = timing_work_copy(work, soup, NULL, soup->count);
    for (size_t tries = 0; work->count < most && tries < 64 * most;) {
        const size_t i = random_below(&g, soup->count);
        if (!is_finite(soup, i))
            continue;
        const tribox_box cell = cell_of_random_point(&over, along, job.triangles[i], &g);
        if (is_new(work, &cell) && holds_triangle(&job.soup, &cell))
            timing_work_add(work, &job, &cell);
        tries++;
    }
    if (work->count)
        return NULL;
    timing_work_free(work);
    return "floats are too coarse there for cells as small as these; ask for fewer along a side";
}

/* ---- leaves of an octree ----------------------------------------------------------------------------------------------------- */

/* The nodes that divide last, in three passes: `pairs` counts all, `room` that of each `step`-th, and these at last become jobs. */
typedef struct octree {
    const tribox_soup *soup;
    size_t pairs, step, nodes, room;
    timing_work *work; /* NULL before the last pass */
} octree;

/* The depth at which a leaf of a surface of that many triangles has about 16 of them. */
static unsigned depth_for(size_t triangles)
{
    unsigned depth = 1;
    for (size_t leaves = 4; depth < OCTREE_DEPTH_MOST && 16 * leaves < triangles; leaves *= 4)
        depth++;
    return depth;
}

/* A float, and the same for all nodes between the same planes: neighbours share their faces to the bit. */
static void middle_of(const tribox_box *box, double middle[3])
{
    for (int a = 0; a < 3; a++)
        middle[a] = (float)((box->lo[a] + box->hi[a]) / 2);
}

static tribox_box child_box(const tribox_box *box, size_t child)
{
    tribox_box own = *box;
    double middle[3];
    middle_of(box, middle);
    for (int a = 0; a < 3; a++)
        *(child >> a & 1 ? &own.lo[a] : &own.hi[a]) = middle[a];
    return own;
}

/* A job for each child of a node, of so many nodes that there are about PAIRS pairs. */
static void divide_last(octree *o, const tribox_box *box, const uint32_t *list, size_t count)
{
    o->pairs += CHILDREN * count;
    if (o->nodes++ % o->step)
        return;
    o->room += timing_work_room(count);
    if (!o->work)
        return;
    const timing_job job = timing_work_copy(o->work, o->soup, list, count);
    for (size_t child = 0; child < CHILDREN; child++) {
        const tribox_box part = child_box(box, child);
        timing_work_add(o->work, &job, &part);
    }
}

/* Goes to the children that have triangles, `depth` levels down. False where there is no memory. */
static bool descend(octree *o, const tribox_box *box, const uint32_t *list, size_t count, unsigned depth)
{
    double middle[3];
    if (!depth) {
        divide_last(o, box, list, count);
        return true;
    }
    middle_of(box, middle);
    uint8_t *const children = malloc(count);
    uint32_t *const own = malloc(count * sizeof *own);
    bool is_done = children && own && !tribox_split(o->soup, list, count, box, middle, NULL, children, NULL);
    for (size_t child = 0; is_done && child < CHILDREN; child++) {
        const tribox_box part = child_box(box, child);
        size_t found = 0;
        for (size_t i = 0; i < count; i++) {
            own[found] = list[i];
            found += children[i] >> child & 1;
        }
        is_done = !found || descend(o, &part, own, found, depth - 1);
    }
    free(children);
    free(own);
    return is_done;
}

/* Divides the cube `depth` times, each time keeping what overlaps. */
static const char *make_octree(const tribox_soup *soup, unsigned depth, timing_work *work)
{
    uint32_t *const list = malloc(soup->count * sizeof *list);
    tribox_box all = cube_over(soup);
    size_t count = 0;
    for (size_t i = 0; list && i < soup->count; i++)
        if (is_finite(soup, i))
            list[count++] = (uint32_t)i;
    for (int a = 0; a < 3; a++)
        all.hi[a] = (float)all.hi[a];
    octree o = {.soup = soup, .step = 1};
    bool is_done = list && descend(&o, &all, list, count, depth - 1);
    o = (octree){.soup = soup, .step = o.pairs / PAIRS + 1};
    is_done =
        is_done && descend(&o, &all, list, count, depth - 1) && timing_work_make(work, CHILDREN * (o.nodes / o.step + 1), o.room);
    o = (octree){.soup = soup, .step = o.step, .work = work};
    if (is_done && !descend(&o, &all, list, count, depth - 1)) {
        timing_work_free(work);
        is_done = false;
    }
    free(list);
    return is_done ? NULL : "out of memory for the octree";
}

/* ---- what is wished ---------------------------------------------------------------------------------------------------------- */

static const char *make_box(const tribox_soup *soup, const tribox_box *box, timing_work *work)
{
    if (!timing_work_make(work, 1, timing_work_room(soup->count)))
        return "out of memory for its triangles";
    const timing_job job = timing_work_copy(work, soup, NULL, soup->count);
    timing_work_add(work, &job, box);
    return NULL;
}

int sweep_work_make(const char *path, const mesh *m, sweep_wish *wish, timing_work *work)
{
    if (m->seen.not_finite == m->soup.count)
        return message_failure("%s: no triangle has finite coordinates: there is nothing to time", path);
    if (wish->kind == SWEEP_OCTREE && !wish->depth)
        wish->depth = depth_for(m->soup.count);
    const char *const failure = wish->kind == SWEEP_BOX    ? make_box(&m->soup, &wish->box, work)
                                : wish->kind == SWEEP_GRID ? make_cells(&m->soup, wish->along, work)
                                                           : make_octree(&m->soup, wish->depth, work);
    return failure ? message_failure("%s: %s", path, failure) : EXIT_CODE_OK;
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
