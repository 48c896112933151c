/* cells.c - draws cells that a mesh overlaps. */
#include "sweep_work.h"

#include <math.h>
#include <string.h>

#include "paper/random.h"

/* The cube over a mesh, and its division. */
typedef struct lattice {
    double lo[3], side;
    unsigned along;
} lattice;

static bool is_finite(const float t[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            if (!isfinite(t[j][a]))
                return false;
    return true;
}

static lattice lattice_over(const timing_job *job, unsigned along)
{
    lattice over = {.lo = {INFINITY, INFINITY, INFINITY}, .side = 0, .along = along};
    double hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < job->soup.count; i++)
        for (int j = 0; is_finite(job->triangles[i]) && j < 3; j++)
            for (int a = 0; a < 3; a++) {
                over.lo[a] = fmin(over.lo[a], (double)job->triangles[i][j][a]);
                hi[a] = fmax(hi[a], (double)job->triangles[i][j][a]);
            }
    for (int a = 0; a < 3; a++)
        over.side = fmax(over.side, hi[a] - over.lo[a]);
    return over;
}

/* Plane k on axis a: one number for the two cells that share it. */
static float plane_at(const lattice *over, int a, unsigned k) { return (float)(over->lo[a] + over->side * k / over->along); }

/* Uniform in a triangle: a point of a parallelogram, folded back over its diagonal. */
static tribox_box cell_of_random_point(const lattice *over, const float t[3][3], generator *g)
{
    double s = (double)random_between(g, 0, 1), r = (double)random_between(g, 0, 1);
    tribox_box cell;
    if (s + r > 1) {
        s = 1 - s;
        r = 1 - r;
    }
    for (int a = 0; a < 3; a++) {
        const double first = (double)t[0][a], point = first + s * ((double)t[1][a] - first) + r * ((double)t[2][a] - first);
        const double place = over->side > 0 ? floor((point - over->lo[a]) / over->side * over->along) : 0;
        const unsigned k = (unsigned)fmin(fmax(place, 0), over->along - 1.0);
        cell.lo[a] = plane_at(over, a, k);
        cell.hi[a] = plane_at(over, a, k + 1);
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

const char *cells_work(const tribox_soup *soup, unsigned along, size_t most, uint64_t seed, timing_work *work)
{
    generator g = {seed};
    if (!timing_work_make(work, most, timing_work_room(soup->count)))
        return "out of memory for its triangles";
    const timing_job job = timing_work_copy(work, soup, NULL, soup->count);
    const lattice over = lattice_over(&job, along);
    for (size_t tries = 0; work->count < most && tries < 64 * most;) {
        const float(*const t)[3] = job.triangles[random_below(&g, soup->count)];
        if (!is_finite(t))
            continue;
        const tribox_box cell = cell_of_random_point(&over, t, &g);
        if (is_new(work, &cell) && holds_triangle(&job.soup, &cell))
            timing_work_add(work, &job, &cell);
        tries++;
    }
    if (work->count)
        return NULL;
    timing_work_free(work);
    return "floats are too coarse there for cells as small as these; ask for fewer along a side";
}
