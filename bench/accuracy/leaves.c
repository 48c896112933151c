#include "leaves.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
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

static void copy_triangles(const tribox_soup *soup, float (*triangles)[3][3])
{
    for (size_t i = 0; i < soup->count; i++)
        for (int j = 0; j < 3; j++) {
            triangles[i][j][0] = soup->x[j][i];
            triangles[i][j][1] = soup->y[j][i];
            triangles[i][j][2] = soup->z[j][i];
        }
}

static lattice lattice_over(const float (*triangles)[3][3], size_t count, unsigned along)
{
    lattice over = {.lo = {INFINITY, INFINITY, INFINITY}, .side = 0, .along = along};
    double hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        for (int j = 0; is_finite(triangles[i]) && j < 3; j++)
            for (int a = 0; a < 3; a++) {
                over.lo[a] = fmin(over.lo[a], triangles[i][j][a]);
                hi[a] = fmax(hi[a], triangles[i][j][a]);
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
    double s = random_between(g, 0, 1), r = random_between(g, 0, 1);
    tribox_box cell;
    if (s + r > 1) {
        s = 1 - s;
        r = 1 - r;
    }
    for (int a = 0; a < 3; a++) {
        const double point = t[0][a] + s * ((double)t[1][a] - t[0][a]) + r * ((double)t[2][a] - t[0][a]);
        const double place = floor((point - over->lo[a]) / over->side * over->along);
        const unsigned k = (unsigned)fmin(fmax(place, 0), over->along - 1);
        cell.lo[a] = plane_at(over, a, k);
        cell.hi[a] = plane_at(over, a, k + 1);
    }
    return cell;
}

static bool has_volume(const tribox_box *cell)
{
    return cell->lo[0] < cell->hi[0] && cell->lo[1] < cell->hi[1] && cell->lo[2] < cell->hi[2];
}

static bool is_new(const cells *made, const tribox_box *cell)
{
    for (size_t c = 0; c < made->count; c++)
        if (!memcmp(&made->at[c].box, cell, sizeof *cell))
            return false;
    return true;
}

static bool holds_triangle(const tribox_soup *soup, const tribox_box *cell)
{
    tribox_report report;
    return tribox_overlap(soup, cell, NULL, NULL, &report) == TRIBOX_OK && report.overlapping > 0;
}

static void add_cell(cells *made, const scene *like, const tribox_box *cell)
{
    scene *const at = &made->at[made->count++];
    *at = *like;
    at->box = *cell;
    for (int a = 0; a < 3; a++) {
        at->center[a] = cell->lo[a] / 2 + cell->hi[a] / 2;
        at->half[a] = (cell->hi[a] - cell->lo[a]) / 2;
    }
}

static void draw_cells(cells *made, const scene *like, const lattice *over, size_t most, generator *g)
{
    for (size_t tries = 0; tries < 64 * most && made->count < most; tries++) {
        const float(*const t)[3] = like->triangles[random_below(g, like->soup.count)];
        if (!is_finite(t))
            continue;
        const tribox_box cell = cell_of_random_point(over, t, g);
        if (has_volume(&cell) && is_new(made, &cell) && holds_triangle(&like->soup, &cell))
            add_cell(made, like, &cell);
    }
}

bool cells_make(const char *name, const char *what, const tribox_soup *soup, unsigned along, size_t most, uint64_t seed,
                cells *made)
{
    *made = (cells){.at = malloc(most * sizeof(scene)), .triangles = malloc(soup->count * sizeof *made->triangles)};
    if (!made->at || !made->triangles) {
        fprintf(stderr, "bench: out of memory for %zu triangles of %s\n", soup->count, name);
        cells_free(made);
        return false;
    }
    copy_triangles(soup, made->triangles);
    const scene like = {.name = name, .what = what, .soup = *soup, .triangles = (const float(*)[3][3])made->triangles};
    const lattice over = lattice_over(like.triangles, soup->count, along);
    if (over.side > 0)
        draw_cells(made, &like, &over, most, &(generator){seed});
    if (!made->count) {
        fprintf(stderr, "bench: %s is too small for %u cells along a side: floats are too coarse there; give fewer\n", name, along);
        cells_free(made);
        return false;
    }
    return true;
}

void cells_free(cells *made)
{
    free(made->at);
    free(made->triangles);
    *made = (cells){.count = 0};
}
