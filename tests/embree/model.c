#include "model.h"

#include <math.h>
#include <stdlib.h>

#include "common/closed_meshes.h"
#include "zeroed.h"

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
