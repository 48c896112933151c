/* voxel_scenes.c - makes and reads soups to voxelize. */
#include "voxel_scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/mesh_list.h"
#include "paper/random.h"
#include "read/mesh.h"

/* Room for the streams and the triangles; count 0 in `made` if there is none. */
static bool make_room(voxel_scene *made, size_t count)
{
    float *const storage = malloc(18 * count * sizeof *storage);
    made->storage = storage;
    made->soup.count = storage ? count : 0;
    made->triangles = (float(*)[3][3])(storage + 9 * count);
    for (int v = 0; storage && v < 3; v++) {
        made->soup.x[v] = storage + (size_t)(3 * v) * count;
        made->soup.y[v] = storage + (size_t)(3 * v + 1) * count;
        made->soup.z[v] = storage + (size_t)(3 * v + 2) * count;
    }
    if (!storage)
        fprintf(stderr, "voxels: out of memory for %zu triangles\n", count);
    return storage;
}

static void fill_streams(voxel_scene *made)
{
    float *const streams = made->storage;
    for (size_t i = 0; i < made->soup.count; i++)
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++)
                streams[(size_t)(3 * v + a) * made->soup.count + i] = made->triangles[i][v][a];
}

static void torus_vertex(float u[3], int along, int around, int longs, int arounds)
{
    const double turn = 6.283185307179586, s = turn * along / longs, t = turn * around / arounds, r = 1 + 0.4 * cos(t);
    u[0] = (float)(r * cos(s));
    u[1] = (float)(r * sin(s));
    u[2] = (float)(0.4 * sin(t));
}

static bool make_torus(voxel_scene *made)
{
    const int longs = 500, arounds = 200;
    if (!make_room(made, (size_t)(2 * longs * arounds)))
        return false;
    size_t at = 0;
    for (int s = 0; s < longs; s++)
        for (int t = 0; t < arounds; t++)
            for (int half = 0; half < 2; half++, at++) {
                torus_vertex(made->triangles[at][0], s, t + half, longs, arounds);
                torus_vertex(made->triangles[at][1], s + 1, t, longs, arounds);
                torus_vertex(made->triangles[at][2], s + half, t + 1, longs, arounds);
            }
    return true;
}

static bool make_random(voxel_scene *made, size_t count, float reach, uint64_t seed)
{
    generator g = {seed};
    if (!make_room(made, count))
        return false;
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            const float lo = random_between(&g, 0, 1 - reach);
            for (int v = 0; v < 3; v++)
                made->triangles[i][v][a] = random_between(&g, lo, lo + reach);
        }
    return true;
}

bool voxel_scene_make(int which, uint64_t seed, voxel_scene *made)
{
    static const char *const names[VOXEL_SCENES] = {"torus", "small", "huge"};
    snprintf(made->name, sizeof made->name, "%s", names[which]);
    const bool is_made = which == 0   ? make_torus(made)
                         : which == 1 ? make_random(made, 200000, 0.01f, seed)
                                      : make_random(made, 12, 1, seed);
    if (is_made)
        fill_streams(made);
    return is_made;
}

bool voxel_scene_read(const char *path, voxel_scene *made)
{
    mesh m;
    if (!mesh_list_read(path, &m))
        return false;
    snprintf(made->name, sizeof made->name, "%s", mesh_list_name(path));
    const bool is_made = make_room(made, m.soup.count - m.not_finite);
    for (size_t i = 0, to = 0; is_made && i < m.soup.count; i++) {
        float u[3][3], sum = 0;
        for (int v = 0; v < 3; v++) {
            u[v][0] = m.soup.x[v][i];
            u[v][1] = m.soup.y[v][i];
            u[v][2] = m.soup.z[v][i];
            for (int a = 0; a < 3; a++)
                sum += u[v][a] - u[v][a];
        }
        if (sum == 0) /* finite: the rivals know nothing else */
            memcpy(made->triangles[to++], u, sizeof u);
    }
    if (is_made)
        fill_streams(made);
    mesh_free(&m);
    return is_made;
}

void voxel_scene_free(voxel_scene *made) { free(made->storage); }

tribox_grid voxel_scene_grid(const voxel_scene *scene, uint32_t resolution)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY}, longest = 0;
    tribox_grid grid;
    for (size_t i = 0; i < scene->soup.count; i++)
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++) {
                lo[a] = fminf(lo[a], scene->triangles[i][v][a]);
                hi[a] = fmaxf(hi[a], scene->triangles[i][v][a]);
            }
    for (int a = 0; a < 3; a++)
        longest = fmaxf(longest, hi[a] - lo[a]);
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = (double)lo[a];
        grid.cell[a] = (double)(longest / (float)resolution * 1.0001f); /* what lies on the far side lies inside */
        grid.size[a] = (uint32_t)fmax(1, ceil((double)(hi[a] - lo[a]) / grid.cell[a]));
    }
    return grid;
}
