#include "witness.h"

#include <math.h>
#include <stdlib.h>

#include "embree.h"

/* The planes of a grid as a scene: a triangle each, so large that no ray within mesh and grid nears its border. */
typedef struct plane_scene {
    embree_scene *scene;
    int first[3]; /* the triangle that is plane 0 of an axis */
} plane_scene;

/* lo .. lo + extent holds mesh and grid. */
typedef struct bounds {
    float lo[3], extent[3];
} bounds;

static bounds bounds_of(const grid_planes *p, const model *s)
{
    bounds b;
    for (int a = 0; a < 3; a++) {
        float lo = (float)p->plane[a][0], hi = (float)p->plane[a][(int)p->grid.size[a]];
        for (size_t t = 0; t < s->count; t++)
            for (int j = 0; j < 3; j++) {
                lo = fminf(lo, s->triangles[t].u[j][a]);
                hi = fmaxf(hi, s->triangles[t].u[j][a]);
            }
        b.lo[a] = lo;
        b.extent[a] = hi - lo;
    }
    return b;
}

/* Corners (A, A), (B, A), (A, B) in the plane, A = lo - extent and B = lo + 4 extent. */
static triangle plane_triangle(const bounds *b, int axis, float plane)
{
    triangle t;
    for (int j = 0; j < 3; j++) {
        t.u[j][axis] = plane;
        for (int k = 1; k < 3; k++) {
            const int a = (axis + k) % 3;
            t.u[j][a] = b->lo[a] + (j == k ? 4 : -1) * b->extent[a];
        }
    }
    return t;
}

static plane_scene plane_scene_make(const grid_planes *p, const model *s)
{
    const bounds b = bounds_of(p, s);
    plane_scene d = {0};
    triangle *const triangles = memory_of(3 * (GRID_PLANES_CELLS + 1), sizeof *triangles);
    int count = 0;
    for (int a = 0; a < 3; a++) {
        d.first[a] = count;
        for (int i = 0; i <= (int)p->grid.size[a]; i++)
            triangles[count++] = plane_triangle(&b, a, (float)p->plane[a][i]);
    }
    d.scene = embree_scene_make(triangles, (size_t)count);
    free(triangles);
    return d;
}

static void plane_scene_free(plane_scene *d) { embree_scene_free(d->scene); }

static int plane_scene_axis(const plane_scene *d, unsigned number)
{
    return ((int)number >= d->first[1]) + ((int)number >= d->first[2]);
}

static int plane_scene_plane(const plane_scene *d, unsigned number) { return (int)number - d->first[plane_scene_axis(d, number)]; }

/* The cells of one axis that a point may lie in. */
typedef struct reach {
    int first, last;
    bool is_certain;
} reach;

/* A point that is on a plane of the grid by construction lies in the cells on both sides. */
static reach reach_of_plane(const grid_planes *p, int axis, int plane)
{
    return (reach){plane > 0 ? plane - 1 : 0, plane < (int)p->grid.size[axis] ? plane : (int)p->grid.size[axis] - 1, true};
}

static reach reach_of_number(const grid_planes *p, int axis, double x, double tolerance)
{
    const span met = planes_met(p, axis, x - tolerance, x + tolerance);
    const bool is_inside = met.first == met.last && (double)p->plane[axis][met.first] <= x - tolerance &&
                           x + tolerance <= (double)p->plane[axis][met.first + 1];
    return (reach){met.first, met.last, tolerance == 0 || is_inside};
}

static void mark(witness *w, size_t t, const reach at[3], bool is_witness)
{
    const block *const candidates = &w->candidates[t];
    const bool is_certain = is_witness && at[0].is_certain && at[1].is_certain && at[2].is_certain;
    int c[3];
    for (c[2] = at[2].first; c[2] <= at[2].last; c[2]++)
        for (c[1] = at[1].first; c[1] <= at[1].last; c[1]++)
            for (c[0] = at[0].first; c[0] <= at[0].last; c[0]++) {
                if (!block_has(candidates, c)) {
                    w->counts.strays += is_certain;
                    continue;
                }
                const size_t number = block_number(candidates, c), word = w->first_word[t] + number / 64;
                const uint64_t bit = UINT64_C(1) << number % 64;
                w->possible[word] |= bit;
                w->certain[word] |= is_certain ? bit : 0;
            }
}

static void mark_vertices(witness *w, size_t t)
{
    for (int j = 0; j < 3; j++) {
        reach at[3];
        bool is_in_grid = true;
        for (int a = 0; a < 3; a++) {
            at[a] = reach_of_number(w->planes, a, (double)w->model->triangles[t].u[j][a], 0);
            is_in_grid = is_in_grid && at[a].first <= at[a].last;
        }
        mark(w, t, at, true);
        w->counts.vertices += is_in_grid;
    }
}

/* Where edge p q crosses a plane of the grid. False beyond the ends of the edge. */
static bool edge_reach(const witness *w, const float p[3], const float q[3], int axis, int plane, reach at[3])
{
    const double rise = (double)q[axis] - (double)p[axis], part = (double)w->planes->plane[axis][plane] - (double)p[axis];
    if (rise == 0 || part / rise < 0 || part / rise > 1)
        return false;
    at[axis] = reach_of_plane(w->planes, axis, plane);
    for (int k = 1; k < 3; k++) {
        const int a = (axis + k) % 3;
        const double along = (double)q[a] - (double)p[a];
        const double tolerance = w->is_exact ? 0 : 1.6e-15 * (fabs((double)p[a]) + fabs(along));
        at[a] = along == 0 ? reach_of_number(w->planes, a, (double)p[a], 0)
                           : reach_of_number(w->planes, a, (double)p[a] + part * along / rise, tolerance);
    }
    return true;
}

static void cast_edge(witness *w, plane_scene *d, size_t t, int j)
{
    const float *const p = w->model->triangles[t].u[j], *const q = w->model->triangles[t].u[(j + 1) % 3];
    const float along[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    if (along[0] == 0 && along[1] == 0 && along[2] == 0)
        return;
    const embree_hit *hits;
    const size_t count = embree_cast(d->scene, p, along, 1 + 0x1p-20f, &hits);
    for (size_t k = 0; k < count; k++) {
        reach at[3];
        const int axis = plane_scene_axis(d, hits[k].triangle);
        const bool is_met = edge_reach(w, p, q, axis, plane_scene_plane(d, hits[k].triangle), at);
        if (is_met)
            mark(w, t, at, true);
        w->counts.edges += is_met;
        w->counts.left_out += !is_met;
    }
}

static void cast_edges(witness *w)
{
    plane_scene d = plane_scene_make(w->planes, w->model);
    for (size_t t = 0; t < w->model->count; t++)
        for (int j = 0; j < 3; j++)
            cast_edge(w, &d, t, j);
    plane_scene_free(&d);
}

/* Embree's own slack at the border of a triangle, as a barycentric coordinate. */
static const double softest = -1e-5;

static void count_lattice_hit(witness_counts *n, const crossing *c, float embree_t, double cell)
{
    n->soft += c->barycentric < 0;
    n->solid += c->barycentric >= 0;
    n->grazing += fabs((double)embree_t - c->t) > c->float_error || c->float_error > 0.05 * cell;
}

/* A lattice line along the axis, at[a] and at[b] being its planes on the two others. */
static void cast_lattice_line(witness *w, embree_scene *scene, int axis, reach at[3], const float from[3])
{
    const grid_planes *const p = w->planes;
    const float lowest = (float)p->plane[axis][0], highest = (float)p->plane[axis][(int)p->grid.size[axis]];
    const float cell = (float)p->grid.cell[axis];
    float along[3] = {0};
    along[axis] = 1;
    const embree_hit *hits;
    const size_t count = embree_cast(scene, from, along, highest - from[axis] + cell, &hits);
    for (size_t k = 0; k < count; k++) {
        crossing c;
        if (!crossing_make(&w->model->triangles[hits[k].triangle], axis, from, &c) || c.barycentric < softest) {
            w->counts.ghost++;
            continue;
        }
        const double scale = fabs((double)from[axis]) + fabs(c.t) + ((double)highest - (double)lowest);
        at[axis] = reach_of_number(p, axis, c.place, w->is_exact ? 0 : 1e-14 * scale / fabs(c.cosine));
        mark(w, hits[k].triangle, at, c.barycentric >= 0);
        count_lattice_hit(&w->counts, &c, hits[k].t, (double)cell);
    }
}

static void cast_lattice(witness *w)
{
    const grid_planes *const p = w->planes;
    embree_scene *const scene = embree_scene_make(w->model->triangles, w->model->count);
    for (int axis = 0; axis < 3; axis++) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (int i = 0; i <= (int)p->grid.size[a]; i++)
            for (int j = 0; j <= (int)p->grid.size[b]; j++) {
                reach at[3];
                at[a] = reach_of_plane(p, a, i);
                at[b] = reach_of_plane(p, b, j);
                float from[3];
                from[axis] = (float)(p->plane[axis][0] - p->grid.cell[axis]);
                from[a] = (float)p->plane[a][i];
                from[b] = (float)p->plane[b][j];
                cast_lattice_line(w, scene, axis, at, from);
            }
    }
    embree_scene_free(scene);
}

static void find_candidates(witness *w)
{
    const size_t count = w->model->count;
    w->candidates = memory_of(count, sizeof *w->candidates);
    w->first_word = memory_of(count + 1, sizeof *w->first_word);
    for (size_t t = 0; t < count; t++) {
        w->candidates[t] = planes_candidates(w->planes, &w->model->triangles[t]);
        w->first_word[t + 1] = w->first_word[t] + tribox_mask_words(block_cells(&w->candidates[t]));
    }
    w->certain = memory_of(w->first_word[count], sizeof *w->certain);
    w->possible = memory_of(w->first_word[count], sizeof *w->possible);
}

witness witness_make(const grid_planes *p, const model *s, bool is_exact)
{
    witness w = {.planes = p, .model = s, .is_exact = is_exact};
    find_candidates(&w);
    for (size_t t = 0; t < s->count; t++)
        mark_vertices(&w, t);
    cast_edges(&w);
    cast_lattice(&w);
    return w;
}

void witness_free(witness *w)
{
    free(w->candidates);
    free(w->first_word);
    free(w->certain);
    free(w->possible);
}
