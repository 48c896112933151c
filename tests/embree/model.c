#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/closed_meshes.h"

void *memory_of(size_t count, size_t size)
{
    void *const memory = calloc(count ? count : 1, size);
    if (!memory) {
        fprintf(stderr, "no memory for %zu objects of %zu bytes; the cross-check takes up to half a gigabyte\n", count, size);
        exit(1);
    }
    return memory;
}

static model empty(size_t capacity) { return (model){.triangles = memory_of(capacity, sizeof(triangle))}; }

static void put(void *mesh, const double a[3], const double b[3], const double c[3])
{
    model *const s = mesh;
    const double *const corner[3] = {a, b, c};
    for (int j = 0; j < 3; j++)
        for (int k = 0; k < 3; k++)
            s->triangles[s->count].u[j][k] = (float)corner[j][k];
    s->count++;
}

model model_soup(random_source *r, size_t count, double size)
{
    model s = empty(count);
    while (s.count < count) {
        double v[3][3];
        for (int a = 0; a < 3; a++) {
            const double least = random_double(r, -1, 1 - size);
            for (int j = 0; j < 3; j++)
                v[j][a] = least + random_double(r, 0, size);
        }
        put(&s, v[0], v[1], v[2]);
    }
    return s;
}

/* For a mesh with room for that many triangles. */
static closed_mesh_sink sink_of(model *s, size_t triangles)
{
    *s = empty(triangles);
    return (closed_mesh_sink){put, s};
}

model model_icosphere(int levels)
{
    model s;
    const closed_mesh_sink to = sink_of(&s, (size_t)20 << 2 * levels);
    closed_icosphere(&to, levels);
    return s;
}

model model_torus(int around, int across, double tube)
{
    model s;
    const closed_mesh_sink to = sink_of(&s, 2 * (size_t)around * (size_t)across);
    closed_torus(&to, around, across, tube);
    return s;
}

model model_cube(int steps)
{
    model s;
    const closed_mesh_sink to = sink_of(&s, 12 * (size_t)steps * (size_t)steps);
    closed_cube(&to, steps);
    return s;
}

void model_place(model *s, const double scale[3], const double shift[3])
{
    for (size_t t = 0; t < s->count; t++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                s->triangles[t].u[j][a] = (float)(scale[a] * (double)s->triangles[t].u[j][a] + shift[a]);
}

void model_snap(model *s)
{
    for (size_t t = 0; t < s->count; t++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                s->triangles[t].u[j][a] = rintf(s->triangles[t].u[j][a]);
}

void model_shake(model *s, random_source *r)
{
    for (size_t t = 0; t < s->count; t++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++) {
                float *const x = &s->triangles[t].u[j][a];
                *x = nextafterf(*x, *x + (float)random_int_between(r, -1, 1));
            }
}

void model_free(model *s)
{
    free(s->triangles);
    *s = (model){0};
}

streams streams_make(const model *s)
{
    streams made = {.soup.count = s->count, .memory = memory_of(9 * s->count, sizeof(float))};
    for (int j = 0; j < 3; j++) {
        float *const stream[3] = {made.memory + (size_t)(3 * j) * s->count, made.memory + (size_t)(3 * j + 1) * s->count,
                                  made.memory + (size_t)(3 * j + 2) * s->count};
        for (size_t t = 0; t < s->count; t++)
            for (int a = 0; a < 3; a++)
                stream[a][t] = s->triangles[t].u[j][a];
        made.soup.x[j] = stream[0];
        made.soup.y[j] = stream[1];
        made.soup.z[j] = stream[2];
    }
    return made;
}

void streams_free(streams *s) { free(s->memory); }

bool planes_make(grid_planes *p, const tribox_grid *grid)
{
    if (!grid_planes_make(p, grid))
        return false;
    for (int a = 0; a < 3; a++)
        for (uint32_t c = 0; c < grid->size[a]; c++) {
            const tribox_box cell = tribox_grid_cell(grid, a == 0 ? c : 0, a == 1 ? c : 0, a == 2 ? c : 0);
            if (cell.lo[a] != p->plane[a][c] || cell.hi[a] != p->plane[a][c + 1] || cell.hi[a] != (double)(float)cell.hi[a])
                return false;
        }
    return true;
}

/* How many planes of an axis lie below x, or at it if it is closed. */
static int planes_below(const grid_planes *p, int axis, double x, bool is_closed)
{
    int below = 0, above = (int)p->grid.size[axis] + 1;
    while (below < above) {
        const int middle = (below + above) / 2;
        const double plane = p->plane[axis][middle];
        if (plane < x || (is_closed && plane == x))
            below = middle + 1;
        else
            above = middle;
    }
    return below;
}

span planes_met(const grid_planes *p, int axis, double least, double most)
{
    const int below = planes_below(p, axis, least, false), until = planes_below(p, axis, most, true);
    return (span){below > 0 ? below - 1 : 0, until <= (int)p->grid.size[axis] ? until - 1 : (int)p->grid.size[axis] - 1};
}

block planes_candidates(const grid_planes *p, const triangle *t)
{
    block b;
    for (int a = 0; a < 3; a++) {
        const float least = fminf(fminf(t->u[0][a], t->u[1][a]), t->u[2][a]);
        const float most = fmaxf(fmaxf(t->u[0][a], t->u[1][a]), t->u[2][a]);
        const span met = planes_met(p, a, (double)least, (double)most);
        b.first[a] = met.first > 0 ? met.first - 1 : 0;
        const int last = met.last + 1 < (int)p->grid.size[a] ? met.last + 1 : (int)p->grid.size[a] - 1;
        b.count[a] = last >= b.first[a] ? last - b.first[a] + 1 : 0;
    }
    return b;
}

bool block_has(const block *b, const int cell[3])
{
    bool is_in = true;
    for (int a = 0; a < 3; a++)
        is_in = is_in && cell[a] >= b->first[a] && cell[a] < b->first[a] + b->count[a];
    return is_in;
}

size_t block_number(const block *b, const int cell[3])
{
    const int i = cell[0] - b->first[0], j = cell[1] - b->first[1], k = cell[2] - b->first[2];
    return ((size_t)k * (size_t)b->count[1] + (size_t)j) * (size_t)b->count[0] + (size_t)i;
}

void block_cell(const block *b, size_t number, int cell[3])
{
    const size_t row = number / (size_t)b->count[0];
    cell[0] = b->first[0] + (int)(number % (size_t)b->count[0]);
    cell[1] = b->first[1] + (int)(row % (size_t)b->count[1]);
    cell[2] = b->first[2] + (int)(row / (size_t)b->count[1]);
}

size_t planes_bit(const grid_planes *p, const int cell[3])
{
    return 64 * grid_planes_word(p, cell[0], cell[1], cell[2]) + (size_t)cell[0] % 64;
}

static void subtract(const float p[3], const float q[3], double difference[3])
{
    for (int a = 0; a < 3; a++)
        difference[a] = (double)p[a] - (double)q[a];
}

static double cross_part(const double p[3], const double q[3], int axis)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    return p[a] * q[b] - p[b] * q[a];
}

static double largest(const double v[3]) { return fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2])); }

/* The forward bound of the float quotient n . (v0 - from) / n[axis], of which n is a product of edges. */
static double float_error_of(double t, double edge, double reach, double distance, double n)
{
    const double u = 0x1p-24;
    return u * (distance + t) * (6 * edge * edge + 8 * reach * edge) / fabs(n) + 4 * u * t;
}

bool crossing_make(const triangle *t, int axis, const float from[3], crossing *c)
{
    double edge[2][3], v[3][3], n[3];
    for (int j = 0; j < 3; j++)
        subtract(t->u[j], from, v[j]);
    for (int j = 0; j < 2; j++)
        subtract(t->u[j + 1], t->u[j], edge[j]);
    for (int a = 0; a < 3; a++)
        n[a] = cross_part(edge[0], edge[1], a);
    if (n[axis] == 0)
        return false;
    c->t = (n[0] * v[0][0] + n[1] * v[0][1] + n[2] * v[0][2]) / n[axis];
    c->place = (double)from[axis] + c->t;
    c->cosine = n[axis] / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    c->barycentric = INFINITY;
    for (int j = 0; j < 3; j++)
        c->barycentric = fmin(c->barycentric, cross_part(v[(j + 1) % 3], v[(j + 2) % 3], axis) / n[axis]);
    double third[3];
    subtract(t->u[0], t->u[2], third);
    const double e = fmax(fmax(largest(edge[0]), largest(edge[1])), largest(third));
    const double reach = fmax(fmax(largest(v[0]), largest(v[1])), largest(v[2]));
    c->float_error = float_error_of(c->t, e, reach, fabs(v[0][0]) + fabs(v[0][1]) + fabs(v[0][2]), n[axis]);
    return true;
}
