#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/closed_meshes.h"
#include "common/soup_or_mesh.h"

void *memory_of(size_t count, size_t size)
{
    void *const memory = calloc(count ? count : 1, size);
    if (!memory) {
        fprintf(stderr, "no memory for %zu objects of %zu bytes; the cross-check takes up to half a gigabyte\n", count, size);
        exit(1);
    }
    return memory;
}

static void put(void *mesh, const double a[3], const double b[3], const double c[3])
{
    model *const m = mesh;
    const double *const corner[3] = {a, b, c};
    for (int k = 0; k < 9; k++)
        m->triangles[m->count].u[k / 3][k % 3] = (float)corner[k / 3][k % 3];
    m->count++;
}

static void draw_triangle(random_source *r, double size, model *m)
{
    double v[3][3];
    for (int a = 0; a < 3; a++) {
        const double least = random_double(r, -1, 1 - size);
        for (int j = 0; j < 3; j++)
            v[j][a] = least + random_double(r, 0, size);
    }
    put(m, v[0], v[1], v[2]);
}

model model_make(shape s, size_t count, double size, random_source *r)
{
    enum { LEVELS = 4, AROUND = 64, ACROSS = 32, STEPS = 8 };
    static const size_t counts[] = {[ICOSPHERE] = 20 << 2 * LEVELS, [TORUS] = 2 * AROUND * ACROSS, [CUBE] = 12 * STEPS * STEPS};
    model m = {.triangles = memory_of(s == SOUP ? count : counts[s], sizeof(triangle))};
    const closed_mesh_sink to = {put, &m};
    if (s == SOUP)
        while (m.count < count)
            draw_triangle(r, size, &m);
    else if (s == TORUS)
        closed_torus(&to, AROUND, ACROSS, size);
    else if (s == CUBE)
        closed_cube(&to, STEPS);
    else
        closed_icosphere(&to, LEVELS);
    return m;
}

void model_place(model *m, double scale, double shift)
{
    for (size_t k = 0; k < 9 * m->count; k++) {
        float *const x = &m->triangles[k / 9].u[k / 3 % 3][k % 3];
        *x = (float)(scale * (double)*x + shift);
    }
}

void model_snap(model *m)
{
    for (size_t k = 0; k < 9 * m->count; k++) {
        float *const x = &m->triangles[k / 9].u[k / 3 % 3][k % 3];
        *x = rintf(*x);
    }
}

float *model_soup(const model *m, tribox_soup *soup)
{
    float *const rows = memory_of(9 * m->count, sizeof *rows);
    for (size_t t = 0; t < m->count; t++)
        for (size_t k = 0; k < 9; k++)
            rows[k * m->count + t] = m->triangles[t].u[k % 3][k / 3];
    *soup = soup_of_rows(rows, m->count, m->count);
    return rows;
}

void planes_make(planes *p, const tribox_grid *grid)
{
    p->grid = *grid;
    for (int a = 0; a < 3; a++)
        for (uint32_t c = 0; c <= grid->size[a]; c++)
            p->at[a][c] = c * grid->cell[a] + grid->origin[a];
}

tribox_box planes_cell(const planes *p, const int cell[3])
{
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        box.lo[a] = p->at[a][cell[a]];
        box.hi[a] = p->at[a][cell[a] + 1];
    }
    return box;
}

size_t planes_bit(const planes *p, const int cell[3])
{
    const size_t row = (size_t)cell[2] * p->grid.size[1] + (size_t)cell[1];
    return 64 * (row * tribox_mask_words(p->grid.size[0])) + (size_t)cell[0];
}

/* How many planes of an axis lie below x, or at it if it is closed. */
static int planes_below(const planes *p, int axis, double x, bool is_closed)
{
    int below = 0, above = (int)p->grid.size[axis] + 1;
    while (below < above) {
        const int middle = (below + above) / 2;
        const double plane = p->at[axis][middle];
        if (plane < x || (is_closed && plane == x))
            below = middle + 1;
        else
            above = middle;
    }
    return below;
}

span planes_met(const planes *p, int axis, double least, double most)
{
    const int below = planes_below(p, axis, least, false), until = planes_below(p, axis, most, true);
    return (span){below > 0 ? below - 1 : 0, until <= (int)p->grid.size[axis] ? until - 1 : (int)p->grid.size[axis] - 1};
}

block planes_candidates(const planes *p, const triangle *t)
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

size_t block_number(const block *b, const int cell[3])
{
    size_t number = 0;
    for (int a = 2; a >= 0; a--) {
        if (cell[a] < b->first[a] || cell[a] >= b->first[a] + b->count[a])
            return block_cells(b);
        number = number * (size_t)b->count[a] + (size_t)(cell[a] - b->first[a]);
    }
    return number;
}

void block_cell(const block *b, size_t number, int cell[3])
{
    for (int a = 0; a < 3; number /= (size_t)b->count[a++])
        cell[a] = b->first[a] + (int)(number % (size_t)b->count[a]);
}

static double cross_part(const double p[3], const double q[3], int axis)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    return p[a] * q[b] - p[b] * q[a];
}

bool crossing_of(const triangle *t, int axis, const float from[3], double *at)
{
    double edge[2][3], v[3][3], n[3];
    for (int k = 0; k < 9; k++)
        v[k / 3][k % 3] = (double)t->u[k / 3][k % 3] - (double)from[k % 3];
    for (int k = 0; k < 6; k++)
        edge[k / 3][k % 3] = (double)t->u[k / 3 + 1][k % 3] - (double)t->u[k / 3][k % 3];
    for (int a = 0; a < 3; a++)
        n[a] = cross_part(edge[0], edge[1], a);
    if (n[axis] == 0)
        return false;
    *at = (n[0] * v[0][0] + n[1] * v[0][1] + n[2] * v[0][2]) / n[axis];
    for (int j = 0; j < 3; j++)
        if (cross_part(v[(j + 1) % 3], v[(j + 2) % 3], axis) / n[axis] < 0)
            return false;
    return true;
}
